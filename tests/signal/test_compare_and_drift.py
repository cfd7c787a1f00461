"""On-off and drift scans against a planted source, heard by a receiver on a virtual clock."""

from __future__ import annotations

import math

import pytest
from birdcage.base.errors import CommandRefused
from birdcage.signal.drift_task import PASSED_BY
from birdcage.signal.source_path import SourcePath, seen_path
from birdcage.sky.observer import Observer
from birdcage.sky.targets import Resolver
from birdcage.station.requests import BeginTask

from tests.signal.test_peak_by_source import FLOOR_DB, WIDTH_DEG, made, run

SUN_DEG_S = 15.0 / 3600.0


def moving(bench, *, az_deg, el_deg, rate_deg_s, length_s, ahead_s=20.0):
    """Return the path of a source that is in a direction in the middle of its time, and goes to the right."""
    now_s = bench.clock.utc().timestamp() + ahead_s
    cos = math.cos(math.radians(el_deg))
    rows = []
    for index in range(61):
        way_s = length_s * (index / 60 - 0.5)
        rows.append((now_s + length_s / 2 + way_s, az_deg + rate_deg_s * way_s / cos, el_deg))
    return tuple(rows)


class Follows:
    """Moves what is planted along a path, with what the dish looks off by."""

    def __init__(self, bench, source, rows, right_deg=0.0):
        self._bench, self._source, self._path, self._right = bench, source, SourcePath.of(rows), right_deg

    def tick(self, bench):
        az_deg, el_deg = self._path.at(bench.clock.utc().timestamp())
        # A beam that looks right of the dish's direction sees the source where it is less far right.
        self._source.to = (az_deg - self._right / math.cos(math.radians(el_deg)), el_deg)
        self._source.tick(bench)


def ask(bench, kind, **values):
    return bench.do(BeginTask(kind, values, "you"))


def test_the_difference_is_that_of_powers_with_an_error_that_holds_it():
    bench, source = made("g2", (180.0, 45.0))
    ask(bench, "on-off", path=((0.0, 180.0, 45.0),), away_deg=12.0, cycles=3)
    ended = run(bench, source)
    assert ended.is_done, ended.why
    assert (ended.done, ended.of, ended.found["unit"], ended.found["cycles"]) == (12, 12, "dB", 3)
    assert ended.found["difference"] == pytest.approx(10 * math.log10(31.0), abs=0.1)
    assert ended.found["off"] == pytest.approx(FLOOR_DB, abs=0.1)
    assert 0.0 <= ended.found["sigma"] < 0.1
    assert ended.why.startswith("+14.9")
    assert bench.state.position.az_deg == pytest.approx(180.0, abs=0.1)


@pytest.mark.parametrize(("axis", "sides"), [("el", ((180, 50), (180, 60))), ("az", ((169, 55), (191, 55)))])
def test_it_listens_on_the_source_and_on_either_side_in_turn(axis, sides):
    bench, source = made("g2", (180.0, 55.0))
    away_deg = 5.0 if axis == "el" else 11.0 * math.cos(math.radians(55.0))
    ask(bench, "on-off", path=((0.0, 180.0, 55.0),), away_deg=away_deg, axis=axis, cycles=2)
    heard, on = [], (180, 55)
    while bench.state.tasks:
        source.tick(bench)
        bench.step(0.05)
        where = round(bench.state.position.az_deg), round(bench.state.position.el_deg)
        if bench.state.motion is None and (not heard or heard[-1] != where):
            heard.append(where)
    assert [each for each in heard if each in (on, *sides)] == [on, *sides, on, *sides, on]


def test_a_source_beyond_the_limits_is_compared_with_nothing():
    bench, source = made("g2", (180.0, 10.0))
    at = bench.clock.monotonic()
    ask(bench, "on-off", path=((0.0, 180.0, 10.0),), away_deg=12.0, axis="el", cycles=2)
    ended = run(bench, source)
    assert not ended.is_done
    assert "below the floor of 18.00°" in ended.why
    assert bench.moves_since(at) == []


def test_a_side_beyond_the_limits_is_left_out_and_the_other_counts():
    bench, source = made("g2", (180.0, 25.0))
    ask(bench, "on-off", path=((0.0, 180.0, 25.0),), away_deg=12.0, axis="el", cycles=2)
    ended = run(bench, source)
    assert ended.is_done, ended.why
    assert ended.found["difference"] == pytest.approx(10 * math.log10(31.0), abs=0.1)


def test_an_on_off_follows_a_source_that_moves():
    bench, source = made("g2", (180.0, 45.0))
    rows = moving(bench, az_deg=180.0, el_deg=45.0, rate_deg_s=0.2, length_s=200.0, ahead_s=0.0)
    follows = Follows(bench, source, rows)
    ask(bench, "on-off", path=rows, away_deg=15.0, cycles=2)
    ended = run(bench, follows)
    assert ended.found["difference"] == pytest.approx(10 * math.log10(31.0), abs=0.6)
    # It ends where the source was as it went back, a second ago, and not where it was heard last.
    behind_deg = SourcePath.of(rows).at(bench.clock.utc().timestamp())[0] - bench.state.position.az_deg
    assert 0.0 <= behind_deg < 0.3


@pytest.mark.parametrize("right_deg", [0.0, 0.6, -0.4])
def test_a_drift_scan_tells_how_far_off_the_beam_looks(right_deg):
    bench, source = made("g2", (180.0, 40.0))
    rows = moving(bench, az_deg=180.0, el_deg=40.0, rate_deg_s=SUN_DEG_S, length_s=3 * WIDTH_DEG / SUN_DEG_S)
    at = bench.clock.monotonic()
    ask(bench, "drift", path=rows, width_deg=WIDTH_DEG)
    ended = run(bench, Follows(bench, source, rows, right_deg), seconds=4000.0, step_s=0.2)
    assert ended.is_done, ended.why
    assert ended.found["along_deg"] == pytest.approx(right_deg, abs=0.05)
    assert ended.found["late_s"] == pytest.approx(right_deg / SUN_DEG_S, abs=12.0)
    assert ended.found["width_deg"] == pytest.approx(WIDTH_DEG, abs=0.2)
    assert ended.found["rise"] == pytest.approx(10 * math.log10(31.0), abs=0.5)
    assert len(ended.found["line"]) == 120
    assert len(bench.moves_since(at)) <= 2, "it rests while the sky passes"


def test_of_a_scan_that_begins_late_the_rest_is_heard():
    bench, source = made("g2", (180.0, 40.0))
    rows = moving(bench, az_deg=180.0, el_deg=40.0, rate_deg_s=0.1, length_s=120.0, ahead_s=-60.0)
    ask(bench, "drift", path=rows, width_deg=WIDTH_DEG)
    ended = run(bench, Follows(bench, source, rows))
    first = ended.found["line"][0]
    assert 30 < len(ended.found["line"]) < 62
    assert first[0] > -0.5, "what had passed was not heard"


def test_where_nothing_passes_it_says_so():
    bench, source = made("g2", (90.0, 40.0))
    rows = moving(bench, az_deg=180.0, el_deg=40.0, rate_deg_s=0.1, length_s=120.0)
    ask(bench, "drift", path=rows, width_deg=WIDTH_DEG)
    ended = run(bench, source)
    assert (ended.is_done, ended.why) == (True, PASSED_BY)
    assert "rise" not in ended.found


def test_stop_ends_a_drift_scan_and_lets_go_of_the_receiver():
    bench, source = made("g2", (180.0, 40.0))
    rows = moving(bench, az_deg=180.0, el_deg=40.0, rate_deg_s=0.1, length_s=120.0)
    ask(bench, "drift", path=rows, width_deg=WIDTH_DEG)
    for _ in range(900):
        source.tick(bench)
        bench.step(0.05)
    assert source.watchers == {"task"}
    bench.station.stop("you")
    bench.step(2.0)
    assert not bench.state.tasks
    assert source.watchers == set()


@pytest.mark.parametrize(("kind", "values"), [
    ("on-off", {"path": (), "away_deg": 10.0}),
    ("on-off", {"path": ((0.0, 180.0, 45.0),), "away_deg": 0.0}),
    ("on-off", {"path": ((0.0, 180.0, 45.0),), "away_deg": 10.0, "cycles": 1}),
    ("on-off", {"path": ((0.0, 180.0, 45.0),), "away_deg": 10.0, "axis": "skew"}),
    ("on-off", {"path": ((0.0, 180.0),), "away_deg": 10.0}),
    ("drift", {"path": ((0.0, 180.0, 45.0),)}),
    ("drift", {"path": ((0.0, 180.0, 45.0), (100.0, 180.0, 45.0))}),
    ("drift", {"path": ((100.0, 180.0, 45.0), (0.0, 190.0, 45.0))}),
    ("drift", {"path": ((0.0, math.nan, 45.0), (100.0, 190.0, 45.0))}),
])  # fmt: skip
def test_values_that_make_no_sense_are_refused(kind, values):
    bench, _source = made("g2", (180.0, 45.0))
    with pytest.raises(CommandRefused):
        ask(bench, kind, **values)
    assert not bench.state.tasks


def test_a_path_through_north_goes_the_short_way():
    path = SourcePath.of(((0.0, 359.0, 40.0), (100.0, 3.0, 42.0)))
    assert path.at(25.0) == (pytest.approx(0.0, abs=1e-9), pytest.approx(40.5))
    assert path.at(-5.0) == (359.0, 40.0)
    assert path.at(500.0) == (3.0, 42.0)


def test_the_path_of_the_sun_moves_and_that_of_a_slot_stands_still():
    observer = Observer(43.6, -116.2)
    resolver = Resolver()
    sun = seen_path(resolver.resolve("sun").target, observer, "none", 1_763_748_000.0, 1800.0)
    assert len(sun.rows) == 61
    assert sun.moves_deg_s(sun.begin_s + 900.0) == pytest.approx(SUN_DEG_S, rel=0.1)
    slot = seen_path(resolver.resolve("119W").target, observer, "none", 1_763_748_000.0, 1800.0)
    assert len(slot.rows) == 1
