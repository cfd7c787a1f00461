"""`birdcage motors`: what it says first, what it prints, and how it ends."""

from __future__ import annotations

import re
import signal
import time

import pytest
from birdcage.base.paths import Paths
from birdcage.diagnostics.motor_test_records import read_motor_tests


@pytest.fixture(autouse=True)
def _quick_line(monkeypatch):
    monkeypatch.setenv("BIRDCAGE_LINK_DELAY_S", "0.3")


def test_measured_beside_nominal(run):
    result = run("motors", "--axis", "elevation", "--yes")
    assert result.exit_code == 0, result.stderr
    head, up, down = result.stdout.splitlines()
    assert head.split()[:2] == ["AXIS", "WAY"]
    for line, way in ((up, "up"), (down, "down")):
        axis, told_way, way_deg, speed, _sigma, nominal, acceleration, *_rest = line.split()
        assert (axis, told_way, way_deg) == ("elevation", way, "46.0°")
        assert float(speed) == pytest.approx(45.0, rel=0.05)
        assert nominal == "45.0"
        assert float(acceleration) == pytest.approx(400.0, rel=0.2)
    assert "no stall seen over 46°." in result.stderr
    (kept,) = read_motor_tests(Paths.default().journal, "Carryout G2 (demo)")
    assert kept.axis == "elevation"
    assert kept.speed[0] == pytest.approx(45.0, rel=0.05)


def test_what_is_not_kept_is_told(run):
    journal = Paths.default().journal
    journal.parent.mkdir(parents=True, exist_ok=True)
    journal.write_text("no database, but a text of some length: more than a header has")
    result = run("motors", "--axis", "elevation", "--yes")
    assert result.exit_code == 0, result.stderr
    assert "Motor tests are not being kept: " in result.stderr


def test_a_test_that_takes_too_long_is_not_finished(run, monkeypatch):
    monkeypatch.setattr("birdcage.cli.commands.motors.TAKES_S", 1.0)
    result = run("motors", "--axis", "elevation", "--yes")
    assert result.exit_code == 1
    assert "Not finished within 1 s." in result.stderr


def test_as_json(run, as_json):
    told = as_json(run("motors", "--axis", "azimuth", "--yes", "--json", port="sim:g2?az=-180"))
    assert told["azimuth"]["speed"] == pytest.approx(65.0, rel=0.05)
    assert told["azimuth"]["speed_nominal"] == pytest.approx(65.0, abs=0.1)
    assert told["health"] == {"driver.azimuth": "OK", "driver.elevation": "OK"}
    assert (told["complete"], told["demo"]) == (True, True)


def test_nobody_who_was_not_asked_has_a_dish_that_turns(run, pty_dish):
    result = run("motors", port=pty_dish.path)
    assert result.exit_code == 2
    assert "up to 60° to and fro, three times, at full speed" in result.stderr
    assert "Keep the whole swing of the dish clear." in result.stderr
    assert pty_dish.lines() == []


@pytest.mark.parametrize("words", [("--axis", "skew"), ("more",)])
def test_what_makes_no_sense_is_refused(run, words):
    assert run("motors", "--yes", *words).exit_code == 2


def test_a_travler_is_refused_before_anything_is_asked(run):
    result = run("motors", firmware="hal205", port="sim:hal205")
    assert result.exit_code == 4
    assert "The Trav'ler moves in silence: any byte would stop it." in result.stderr
    assert "swing" not in result.stderr


def test_ctrl_c_stops_the_dish_first(start, pty_dish):
    process = start("motors", "--yes", "--axis", "azimuth", "--port", pty_dish.path, "--firmware", "g2")
    pty_dish.wait_for(lambda truth: truth.moving)
    called = time.monotonic()
    process.send_signal(signal.SIGINT)
    out, _err = process.communicate(timeout=60)
    assert process.returncode == 130
    assert out == ""
    assert not pty_dish.device.truth().moving
    stopped = [line for line in pty_dish.moves(called) if line != "a"]
    assert stopped


def test_a_stall_ends_it_with_the_angle_and_what_to_do(start, pty_dish):
    process = start("motors", "--yes", "--axis", "elevation", "--port", pty_dish.path, "--firmware", "g2")
    pty_dish.wait_for(lambda truth: truth.moving and truth.el_deg < 30)
    pty_dish.wait_for(lambda truth: truth.moving and truth.el_deg > 30)
    pty_dish.device.stall(1)
    stood = pty_dish.device.truth().el_deg
    _out, err = process.communicate(timeout=60)
    assert process.returncode == 1
    assert "The elevation is stalled" in err
    assert "Elevation was last read at " in err
    assert "Something blocks it, or its motor lost steps. Look at the dish first." in err
    seen = re.search(r"The dish was last seen at AZ [\d.]+° EL ([\d.]+)°", err)
    assert float(seen[1]) == pytest.approx(stood, abs=0.05)


def test_a_dish_that_is_not_homed_is_not_turned(run):
    result = run("motors", "--yes", port="sim:g2?unhomed=1")
    assert result.exit_code == 4
    assert "Nothing was measured. The dish is not homed" in result.stderr


def test_a_carryout_is_refused_by_what_it_tells(run):
    result = run("motors", "--yes", port="sim:carryout", firmware="carryout")
    assert result.exit_code == 4
    assert "tells where it is only on its way" in result.stderr
