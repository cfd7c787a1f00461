"""The watch of the sky, on a virtual clock without its thread, and once with it."""

from __future__ import annotations

import threading
from dataclasses import replace
from datetime import UTC, datetime, timedelta

import pytest
from birdcage.base.clock import RealClock, VirtualClock
from birdcage.sky.catalogue import Catalogue
from birdcage.sky.demo_orbits import demo_orbits
from birdcage.sky.observer import Observer
from birdcage.sky.passes.search import search
from birdcage.sky.propagate import Fleet
from birdcage.sky.reach_limits import ReachLimits
from birdcage.sky.watch import SkyWatch

HERE = Observer(50.0, 10.0, 300.0, "here")
THERE = Observer(-35.0, 149.0)
BEGIN = datetime(2026, 11, 21, 12, tzinfo=UTC)


class Bench:
    """A watch over a catalogue of demo orbits, and all that it published."""

    def __init__(self, path, observer=HERE, limits=None):
        self.path = path
        self.clock = VirtualClock(BEGIN)
        self.published = []
        self.watch = SkyWatch(path, self.published.append, self.clock, observer=observer, limits=limits)

    @property
    def now(self):
        return self.published[-1]

    def settle(self):
        """Step until there is nothing to do; return how many bites that took."""
        bites = 1
        while self.watch.step() <= self.clock.monotonic():
            bites += 1
            assert bites < 5000
        return bites

    def wait(self, seconds):
        self.clock.advance(seconds)
        self.settle()


@pytest.fixture
def path(tmp_path):
    path = tmp_path / "catalogue.sqlite"
    with Catalogue(path) as catalogue:
        catalogue.add(demo_orbits(BEGIN, HERE))
    return path


@pytest.fixture
def bench(path):
    bench = Bench(path)
    bench.settle()
    return bench


def names(rows):
    return [row.passing.name for row in rows]


def test_an_empty_catalogue_shows_what_ships_and_says_so(tmp_path):
    bench = Bench(tmp_path / "none.sqlite")
    bench.settle()
    assert bench.now.satellites >= 10
    assert "ship with birdcage" in bench.now.note
    assert not (tmp_path / "none.sqlite").exists()


def test_without_a_place_nothing_is_up_and_nothing_is_searched(path):
    bench = Bench(path, observer=None)
    bench.settle()
    assert (bench.now.up, bench.now.passes, bench.now.searching, bench.now.observer) == ((), (), None, None)
    bench.watch.set_observer(HERE)
    bench.settle()
    assert bench.now.up
    assert bench.now.observer == HERE


def test_what_is_up_is_what_the_propagator_says_highest_first(bench):
    elements = demo_orbits(BEGIN, HERE)
    looks = Fleet(elements).look(HERE, bench.now.utc)
    expected = {one.name: el for one, el in zip(elements, looks.el_deg.tolist(), strict=True) if el > 0.0}
    assert {one.name: pytest.approx(one.el_deg, abs=1e-6) for one in bench.now.up} == expected
    heights = [one.el_deg for one in bench.now.up]
    assert heights == sorted(heights, reverse=True)


def test_it_looks_once_a_second(bench):
    before = len(bench.published)
    first = bench.now.up
    bench.wait(0.4)
    assert len(bench.published) == before
    bench.wait(0.6)
    assert len(bench.published) == before + 1
    moved = {one.name: one.az_deg for one in bench.now.up}
    assert any(moved.get(one.name, one.az_deg) != one.az_deg for one in first)


def test_the_list_holds_every_pass_of_the_day_in_order(bench):
    elements = demo_orbits(BEGIN, HERE)
    table = search(Fleet(elements), HERE, BEGIN, 20.0)
    expected = sorted((one.name, one.aos) for one in table if not one.already_up)
    until = BEGIN + timedelta(hours=20)
    shown = [row.passing for row in bench.now.passes if BEGIN < row.passing.aos < until]
    found = sorted((one.name, one.aos) for one in shown)
    assert [name for name, _ in found] == [name for name, _ in expected]
    for (_, aos), (_, wanted) in zip(found, expected, strict=True):
        assert abs((aos - wanted).total_seconds()) < 0.02
    starts = [row.passing.aos for row in bench.now.passes]
    assert starts == sorted(starts)
    assert bench.now.searching is None


def test_passes_appear_while_the_search_goes_on(tmp_path):
    path = tmp_path / "catalogue.sqlite"
    orbits = demo_orbits(BEGIN, HERE)
    with Catalogue(path) as catalogue:
        catalogue.add(
            replace(orbits[index % len(orbits)], name=f"SAT {index}", norad_id=50_000 + index) for index in range(200)
        )
    bench = Bench(path)
    while not bench.now.passes if bench.published else True:
        bench.watch.step()
        bench.clock.advance(0.05)
    assert bench.now.searching is not None
    assert 0.0 < bench.now.searching < 1.0
    early = len(bench.now.passes)
    bench.settle()
    bench.wait(1.0)
    assert len(bench.now.passes) > early
    assert bench.now.searching is None


def test_a_changed_place_gives_up_the_old_search(bench):
    assert bench.now.passes
    bench.watch.set_observer(THERE)
    bench.watch.step()
    assert (bench.now.observer, bench.now.passes) == (THERE, ())
    bench.settle()
    bench.wait(1.0)
    elements = {one.name: one for one in demo_orbits(BEGIN, HERE)}
    for row in bench.now.passes[:5]:
        looks = Fleet([elements[row.passing.name]]).look(THERE, row.passing.tca)
        assert looks.el_deg[0] == pytest.approx(row.passing.max_elevation_deg, abs=0.01)


def test_other_limits_change_the_reach_and_not_the_passes(bench):
    before = bench.now.passes
    bench.watch.set_limits(ReachLimits(el_floor_deg=30.0))
    bench.settle()
    bench.wait(1.0)
    assert names(bench.now.passes) == names(before)
    low = [row for row in bench.now.passes if row.passing.max_elevation_deg < 30.0]
    assert low
    assert all(row.reach.total_s == 0.0 and row.reach.reasons == ("floor",) for row in low)


def test_a_favourite_is_marked_once_it_is_one_and_searched_two_days_ahead(bench):
    chosen = bench.now.passes[0].passing
    assert not any(row.favourite for row in bench.now.passes)
    with Catalogue(bench.path) as catalogue:
        catalogue.set_favourite(chosen.norad_id)
    bench.wait(6.0)  # the file is looked at every 5 s
    bench.wait(1.0)
    marked = {row.passing.name for row in bench.now.passes if row.favourite}
    assert marked == {chosen.name}
    assert {one.name for one in bench.now.up if one.favourite} <= marked
    horizon = max(row.passing.aos for row in bench.now.passes if row.favourite)
    others = max(row.passing.aos for row in bench.now.passes if not row.favourite)
    assert horizon > others > BEGIN


def test_the_list_stands_while_the_catalogue_is_read_anew(bench):
    before = len(bench.now.passes)
    begun = len(bench.published)
    bench.watch.refresh()
    bench.settle()
    assert all(len(each.passes) == before for each in bench.published[begun:])


def test_the_time_machine_changes_what_is_shown_and_not_the_clock(bench):
    later = BEGIN + timedelta(days=3)
    bench.watch.set_view_time(later, rate=60.0)
    bench.settle()
    assert (bench.now.live, abs(bench.now.utc - later) < timedelta(seconds=1)) == (False, True)
    bench.wait(10.0)
    assert abs(bench.now.utc - later - timedelta(minutes=10)) < timedelta(minutes=2)
    assert all(row.passing.los >= bench.now.utc - timedelta(minutes=2) for row in bench.now.passes)
    assert bench.now.passes[0].passing.aos > BEGIN + timedelta(days=2)
    assert bench.clock.utc() < BEGIN + timedelta(minutes=1)
    bench.watch.set_view_time(None)
    bench.settle()
    assert bench.now.live
    assert bench.now.utc == bench.clock.utc()


def test_passes_that_are_over_go_and_the_search_is_renewed(bench):
    first = bench.now.passes[0].passing
    bench.wait(86_400.0)
    bench.wait(1.0)
    assert all(row.passing.los > first.los for row in bench.now.passes)
    assert max(row.passing.aos for row in bench.now.passes) > BEGIN + timedelta(hours=40)


def test_a_time_offset_moves_satellite_and_pass_the_way_the_catalogue_means_it(bench):
    chosen = next(row.passing for row in bench.now.passes if not row.passing.already_up)
    with Catalogue(bench.path) as catalogue:
        catalogue.set_time_offset(chosen.norad_id, 30.0)  # it comes half a minute later than its elements say
    bench.wait(6.0)
    bench.wait(1.0)
    shifted = min(
        (row.passing for row in bench.now.passes if row.passing.norad_id == chosen.norad_id),
        key=lambda one: abs(one.aos - chosen.aos),
    )
    assert (shifted.aos - chosen.aos).total_seconds() == pytest.approx(30.0, abs=1.0)


def test_a_damaged_catalogue_is_told_and_what_ships_is_shown(tmp_path):
    path = tmp_path / "catalogue.sqlite"
    path.write_bytes(b"not a database" * 100)
    bench = Bench(path)
    bench.settle()
    assert str(path) in bench.now.note
    assert "ship with birdcage" in bench.now.note


def test_a_catalogue_that_is_damaged_meanwhile_leaves_what_was_read(bench):
    before = names(bench.now.passes)
    bench.path.write_bytes(b"not a database" * 100)
    bench.wait(6.0)
    bench.wait(1.0)
    assert "the elements read before" in bench.now.note
    assert names(bench.now.passes)[-20:] == before[-20:]


def test_its_thread_publishes_and_ends_when_told(path):
    seen = threading.Event()
    passes = []

    def publish(sky):
        passes.append(sky)
        if sky.passes:
            seen.set()

    watch = SkyWatch(path, publish, RealClock(), observer=HERE)
    watch.start()
    assert seen.wait(30)
    watch.close(10.0)
    assert not any(thread.name == "sky" for thread in threading.enumerate())
    assert watch.crash is None
    assert passes[-1].note == ""


def test_a_fault_of_the_watch_is_told_and_ends_nothing_else(path, monkeypatch):
    told = []
    watch = SkyWatch(path, told.append, RealClock(), observer=HERE)
    monkeypatch.setattr(watch, "step", lambda: 1 / 0)
    watch.start()
    watch.close(5.0)
    if watch.crash is None:  # closed before its first step
        pytest.skip("the thread never ran")
    assert isinstance(watch.crash, ZeroDivisionError)
    assert "division by zero" in told[-1].note


def test_a_watch_that_is_closed_as_it_starts_ends_in_order(tmp_path, begin_slowly):
    watch = SkyWatch(tmp_path / "none.sqlite", lambda _now: None, RealClock(), observer=HERE)
    assert begin_slowly(watch.start, lambda: watch.close(5.0)) == []
    assert not any(thread.name == "sky" for thread in threading.enumerate())
