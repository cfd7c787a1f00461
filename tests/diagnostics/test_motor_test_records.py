"""Motor tests that are kept in the journal, and read again."""

from __future__ import annotations

import sqlite3
from datetime import UTC, datetime, timedelta

import pytest
from birdcage.base.errors import StoreError
from birdcage.base.journal import Journal, JournalEntry, read_journal
from birdcage.diagnostics.motor_test_records import MotorTest, MotorTestBook, read_motor_tests

from .motor_bench import MotorBench

UTC_THEN = datetime(2026, 3, 1, 12, 0, tzinfo=UTC)
DISH = "Carryout G2 (demo)"


def test_what_was_measured_is_read_again_newest_first_and_by_dish(tmp_path):
    path = tmp_path / "journal.sqlite"
    book = MotorTestBook(path)
    one = MotorTest(UTC_THEN, "azimuth", 60.0, 65.0, 0.1, 64.0, 0.2, 65.0, acceleration_up=400.0, readings=99)
    other = MotorTest(UTC_THEN + timedelta(days=1), "elevation", 46.0, stalled_at_deg=31.5)
    book.add("A", one)
    book.add("A", other)
    book.add("B", one)
    book.close()
    assert book.problem is None
    assert read_motor_tests(path, "A") == [other, one]
    assert read_motor_tests(path, "A", 1) == [other]
    assert read_motor_tests(path, "C") == []
    assert read_motor_tests(tmp_path / "none.sqlite", "A") == []


def test_both_directions_count_by_their_sigmas():
    test = MotorTest(UTC_THEN, "azimuth", 60.0, 60.0, 1.0, 70.0, 1.0)
    assert test.speed == pytest.approx((65.0, 0.5**0.5))
    assert MotorTest(UTC_THEN, "azimuth", 60.0, 60.0, 1.0, 70.0, 100.0).speed[0] == pytest.approx(60.0, abs=0.01)
    assert MotorTest(UTC_THEN, "azimuth", 60.0).acceleration is None


def test_faults_of_before_are_in_the_same_file_still(tmp_path):
    path = tmp_path / "journal.sqlite"
    journal = Journal(path)
    journal.append(JournalEntry(UTC_THEN, "stall", "stall", "It stalled."))
    journal.close()
    book = MotorTestBook(path)
    book.add("A", MotorTest(UTC_THEN, "azimuth", 60.0))
    book.close()
    assert [each.sentence for each in read_journal(path)] == ["It stalled."]
    assert len(read_motor_tests(path, "A")) == 1


def test_a_file_that_cannot_be_written_is_told(tmp_path):
    path = tmp_path / "journal.sqlite"
    path.write_text("no database, but long enough to be looked at as one" * 50)
    book = MotorTestBook(path)
    book.add("A", MotorTest(UTC_THEN, "azimuth", 60.0))
    assert book.flush()
    assert book.problem.startswith("Motor tests are not being kept: ")
    book.close()
    with pytest.raises(StoreError):
        read_motor_tests(path, "A")


def test_each_axis_of_a_test_is_kept_under_the_dish(tmp_path):
    path = tmp_path / "journal.sqlite"
    bench = MotorBench("az=-180", path)
    bench.begin()
    found = bench.end().found
    bench.tests.book.close()
    elevation, azimuth = kept_of(path)
    assert (azimuth.axis, elevation.axis) == ("azimuth", "elevation")
    assert azimuth.speed_up == pytest.approx(found["azimuth.speed_up"])
    assert azimuth.speed == pytest.approx((found["azimuth.speed"], found["azimuth.speed_sigma"]))
    assert azimuth.speed_nominal == pytest.approx(65.0, abs=0.1)
    assert azimuth.stalled_at_deg is None
    assert (bench.clock.utc() - azimuth.utc) < timedelta(minutes=2)


def kept_of(path):
    """Return what is kept, under whatever name the dish of a test has."""
    with sqlite3.connect(path) as connection:
        dishes = {dish for (dish,) in connection.execute("SELECT dish FROM motor_test")}
    assert len(dishes) == 1
    return read_motor_tests(path, dishes.pop())


def test_a_stall_is_kept_with_its_angle(tmp_path):
    path = tmp_path / "journal.sqlite"
    bench = MotorBench("az=-180", path)
    bench.begin(axis="azimuth")
    bench.turn_until(lambda truth: truth.moving and truth.cable_deg < -185.0)
    bench.turn_until(lambda truth: truth.moving and truth.cable_deg > -175.0)
    bench.device.stall(0)
    bench.end(10.0)
    bench.tests.book.close()
    (kept,) = kept_of(path)
    assert kept.stalled_at_deg == pytest.approx(bench.device.truth().az_deg, abs=8.0)
    assert kept.speed is None
    assert kept.way_deg == pytest.approx(60.0)


def test_what_stop_cuts_short_keeps_nothing(tmp_path):
    path = tmp_path / "journal.sqlite"
    bench = MotorBench("az=-180", path)
    bench.begin(axis="azimuth")
    bench.step(2.0)
    bench.station.stop("you")
    bench.step(3.0)
    bench.tests.book.close()
    assert read_motor_tests(path, DISH) == []
    assert not path.exists()
