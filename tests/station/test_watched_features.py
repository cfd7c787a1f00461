"""`Watch`: any feature of the machine, at what each costs, and `health`."""

from __future__ import annotations

import random
from dataclasses import replace
from itertools import pairwise

import pytest
from birdcage.base.errors import CommandRefused, NoReply
from birdcage.base.reason import Reason
from birdcage.protocol.g2.drivers import Drivers
from birdcage.protocol.g2.model import CARRYOUT_G2
from birdcage.rotator.feature import Cost, HealthMark
from birdcage.rotator.verdict import Grade
from birdcage.station.events import PositionRead, ReadingRead
from birdcage.station.requests import (
    AcquireLease,
    Goto,
    Jog,
    Raw,
    Read,
    Release,
    ReleaseLease,
    Unwatch,
    Watch,
)
from birdcage.station.state import Activity, LinkPhase
from birdcage.station.watches import MOST_LINES

from .conftest import Bench, RunningClock

HEALTH = {"lnb_supply", "driver.azimuth", "driver.elevation"}
MENUS = {"dvb", "a3981", "step", "os", "nvs"}


def times_of(bench, feature):
    return [each.at for each in bench.events if isinstance(each, ReadingRead) and each.feature == feature]


def received_since(bench, start):
    return [(at, line) for at, line in bench.received() if at > start]


def busiest(times, seconds=10.0):
    return max((sum(first <= at < first + seconds for at in times) for first in times), default=0)


def with_features(address="g2?seed=1", **features):
    """Return a G2 whose table has these rows otherwise."""
    bench = Bench(address)
    rotator = bench.station._antenna.rotator
    rotator.facts = replace(rotator.facts, features={**rotator.facts.features, **features})
    bench.station._store.change(dish=rotator.facts)
    return bench


@pytest.fixture
def bench():
    bench = Bench()
    bench.watch("position")
    bench.connect(12.0)
    assert bench.state.surveyed
    return bench


def test_health_is_all_that_the_machine_marks_as_such_each_at_its_own_interval(bench):
    assert {name for name, each in CARRYOUT_G2.features.items() if each.health is not None} == HEALTH
    bench.watch("position", "health", rate_hz=2.0)
    since = len(bench.lines())
    bench.step(130)
    for name in HEALTH:
        told = times_of(bench, name)
        assert 4 <= len(told) <= 5
        assert min(later - before for before, later in pairwise(told)) >= 30.0
        assert name in bench.state.readings
    sent = bench.lines()[since:]
    assert sent.count("diag") == len(times_of(bench, "driver.azimuth")), "one line tells of both drivers"
    assert not {"rssi 10", "snr", "id"} & set(sent)
    assert bench.state.menu == "mot"


def test_by_a_clock_that_runs_on_all_is_read_and_the_station_rests_in_between():
    bench = Bench(clock=RunningClock())
    bench.watch("position", "health", "rssi")
    bench.connect(30.0)
    assert HEALTH | {"rssi"} <= bench.state.readings.keys()
    looks = bench.clock.looks
    bench.step(10.0)
    assert bench.clock.looks - looks < 5_000


def test_any_feature_is_watched_at_its_own_rate_and_not_before_it_may_be_read_again(bench):
    bench.station.submit(Watch("slow", frozenset({"version"}), 0.05))
    bench.station.submit(Watch("fast", frozenset({"snr"}), 10.0))
    bench.step(100)
    versions, snr = times_of(bench, "version"), times_of(bench, "snr")
    assert 4 <= len(versions) <= 6
    assert min(later - before for before, later in pairwise(versions)) >= 20.0
    assert len(snr) >= 12
    assert min(later - before for before, later in pairwise(snr)) >= CARRYOUT_G2.features["snr"].cost.min_interval_s


def test_what_a_face_has_just_read_is_not_asked_for_again(bench):
    first = bench.do(Read(("lnb_supply",)))["lnb_supply"]
    bench.watch("position", "lnb_supply")
    bench.step(4.5)
    assert bench.state.readings["lnb_supply"] == first
    bench.step(3.0)
    assert bench.state.readings["lnb_supply"].at > first.at


def test_what_a_survey_has_told_is_a_reading_of_its_features_and_not_asked_for_again(bench):
    told = bench.state.readings
    assert (told["version"].value, told["antenna_id"].value) == (bench.state.firmware_version, "12-IN G2")
    assert (told["floor"].value, told["ceiling"].unit, told["tv_search"].value) == (18.0, "deg", False)
    start = bench.clock.monotonic()
    bench.station.submit(Watch("slow", frozenset({"version", "floor"}), 1.0 / 60.0))
    bench.step(30.0)
    assert {line for _at, line in received_since(bench, start)} == {"a"}
    bench.step(30.0)
    assert bench.state.readings["version"].at > start


def test_what_the_machine_lacks_is_not_read(bench):
    start = bench.clock.monotonic()
    bench.watch("position", "rainfall", "end_tv_search")
    bench.step(30)
    assert {line for _at, line in received_since(bench, start)} == {"a"}


def test_a_machine_that_tells_nothing_of_its_health_is_asked_for_nothing():
    bench = Bench("hal205?seed=1&search_finds=0", firmware="hal205")
    bench.watch("position", "health", rate_hz=2.0)
    bench.connect(30.0)
    other = Bench("hal205?seed=1&search_finds=0", firmware="hal205")
    other.watch("position", rate_hz=2.0)
    other.connect(30.0)
    assert bench.received() == other.received()


def test_nobody_looks_nothing_is_read(bench):
    bench.watch("health")
    bench.step(20)
    bench.station.submit(Unwatch("test"))
    bench.step(1)
    before = bench.received()
    bench.step(60)
    assert bench.received() == before


FAILURES = {
    "refused": CommandRefused("Unknown command.", reason=Reason.UNKNOWN_COMMAND),
    "damaged": NoReply("The dish answered `diag` with 'AZ D', which makes no sense.", reason=Reason.GARBAGE),
}


@pytest.mark.parametrize("how", FAILURES)
def test_a_feature_that_fails_ends_no_other_and_is_left_alone_for_its_interval(bench, how, monkeypatch):
    asked = []

    def fail(_drivers):
        asked.append(bench.clock.monotonic())
        raise FAILURES[how]

    monkeypatch.setattr(Drivers, "faults", fail)
    bench.watch("position", "rssi", "health")
    bench.station.submit(Watch("other", frozenset({"driver.azimuth"}), 10.0))
    start = bench.clock.monotonic()
    bench.step(130)
    assert bench.state.link.state is LinkPhase.UP
    assert "LinkChanged" not in [type(each).__name__ for each in bench.events if each.at > start]
    by_feature = sorted(asked)[::2], sorted(asked)[1::2]
    assert 4 <= len(asked) <= 10
    assert all(later - before >= 5.0 for each in by_feature for before, later in pairwise(each))
    assert len(times_of(bench, "lnb_supply")) >= 4
    assert len(times_of(bench, "rssi")) > 50
    assert bench.state.readings.keys() & HEALTH == {"lnb_supply"}


def test_a_signal_that_is_refused_leaves_the_link_and_the_others_alone(bench, monkeypatch):
    def refuse(*_):
        raise CommandRefused("Tuner not available.", reason=Reason.UNKNOWN)

    monkeypatch.setattr(type(bench.station._antenna.rotator.protocol), "get_rssi", refuse)
    bench.watch("position", "rssi", "health")
    bench.step(60)
    assert bench.state.link.state is LinkPhase.UP
    assert len(times_of(bench, "lnb_supply")) >= 2


def test_a_machine_that_stays_silent_is_silent_whatever_was_asked(bench):
    bench.watch("position", "rssi", "health")
    while bench.state.menu == "mot":
        bench.step(0.02)
    bench.device.unplug()
    bench.step(5)
    assert bench.state.link.state is LinkPhase.LOST
    bench.device.plug()
    bench.step(40)
    assert bench.state.link.state is LinkPhase.UP
    assert bench.state.readings.keys() >= HEALTH


def test_after_another_survey_what_was_forgotten_is_read_again(bench):
    bench.watch("position", "health")
    bench.step(20)
    again = bench.clock.monotonic()
    bench.station._reader.forget_survey()
    bench.step(20)
    assert bench.state.surveyed
    assert all(bench.state.readings[name].at > again for name in HEALTH)


def test_an_excursion_that_stop_cuts_short_is_not_taken_up_again(bench):
    bench.watch("position", "rssi", "health")
    while bench.state.menu != "dvb":
        bench.step(0.02)
    begun = bench.clock.monotonic()
    bench.station.stop("you")
    bench.step(4)
    assert bench.state.last_stop.confirmed
    assert "dvb" not in [line for _at, line in received_since(bench, begun)]
    bench.step(10)
    assert "dvb" in [line for _at, line in received_since(bench, begun)]


def test_while_the_dish_moves_only_what_may_be_read_then_is_read():
    supply = replace(CARRYOUT_G2.features["lnb_supply"], cost=Cost(2, "dvb", 5.0, while_moving=True))
    bench = with_features("g2?seed=1&az_speed=5", lnb_supply=supply)
    bench.watch("position", "rssi", "lnb_supply", "version")
    bench.connect(12.0)
    start = bench.clock.monotonic()
    future = bench.station.submit(Goto(180.0, 45.0, "you"))
    bench.step(0.3)
    moving = bench.clock.monotonic()
    bench.step(20.0)
    assert bench.state.activity is Activity.SLEWING
    sent = received_since(bench, moving)
    assert [line for _at, line in sent].count("lnbv") >= 3
    assert not {"rssi 10", "id"} & {line for _at, line in sent}
    visits = [at for at, line in sent if line == "dvb"]
    assert all(later - earlier >= 5.0 for earlier, later in pairwise(visits))
    assert bench.state.menu == "mot"
    while not future.done():
        bench.step(0.5)
        assert bench.clock.monotonic() < start + 60.0
    assert future.result(0) is not None


def test_stop_comes_first_in_a_reading_while_the_dish_moves():
    supply = replace(CARRYOUT_G2.features["lnb_supply"], cost=Cost(2, "dvb", 5.0, while_moving=True))
    bench = with_features("g2?seed=1&az_speed=5", lnb_supply=supply)
    bench.watch("position", "lnb_supply")
    bench.connect(12.0)
    bench.station.submit(Goto(180.0, 45.0, "you"))
    asked = []
    for after_s in (3.0, 6.2, 7.05):
        bench.later(after_s, lambda: (asked.append(bench.clock.monotonic()), bench.station.stop("you")))
        bench.step(16.0)
        stop = bench.state.last_stop
        assert stop.confirmed, stop
        assert stop.at == pytest.approx(asked[-1], abs=0.01)
        bench.do(Release("you"))
        bench.station.submit(Goto(bench.state.position.az_deg + 170.0, 45.0, "you"))


def test_a_feature_that_takes_too_many_lines_is_left_to_a_person():
    bench = with_features(settings=replace(CARRYOUT_G2.features["settings"], cost=Cost(14, "nvs")))
    bench.watch("position", "settings", "floor")
    bench.connect(40.0)
    assert "floor" in bench.state.readings
    assert "settings" not in bench.state.readings
    assert "settings" in bench.do(Read(("settings",)))


def test_a_costly_feature_is_read_alone_and_keeps_the_budget():
    many = replace(CARRYOUT_G2.features["settings"], cost=Cost(12, "nvs"), health=HealthMark("settings", 5.0))
    bench = with_features(settings=many)
    bench.watch("position", "rssi", "health")
    bench.connect(12.0)
    start = bench.clock.monotonic()
    bench.step(60)
    assert len(times_of(bench, "settings")) >= 2
    assert busiest([at for at, _line in received_since(bench, start)]) <= 30


# All at once, for ten minutes, with everything else that happens in between.


@pytest.mark.parametrize("seed", range(6))
def test_all_features_watched_by_three_keep_the_budget_whatever_happens(seed):
    rng, bench = random.Random(seed), Bench(f"g2?seed={seed}")
    features = [*CARRYOUT_G2.features, "position", "health"]
    for watcher, rate_hz in (("one", 10.0), ("two", 1.0), ("three", 0.1)):
        bench.station.submit(Watch(watcher, frozenset(features), rate_hz))
    bench.connect(30.0)
    calm: list[tuple[float, float]] = []
    end = bench.clock.monotonic() + 900.0
    while bench.clock.monotonic() < end:
        deed = rng.choice(["go", "stop", "talk", "unplug", "jog", "read"])
        begun = bench.clock.monotonic()
        if deed == "go":
            bench.do(Goto(rng.uniform(0, 359), rng.uniform(20, 60), "you"))
        elif deed == "jog":
            bench.do(Jog(rng.uniform(-2, 2), 0.0, "you"))
        elif deed == "read":
            bench.do(Read(("version",)))
        elif deed == "stop":
            bench.station.submit(Goto(rng.uniform(0, 359), rng.uniform(20, 60), "you"))
            bench.step(rng.uniform(0.0, 2.0))
            asked = bench.clock.monotonic()
            bench.station.stop("you")
            bench.step(6.0)
            assert bench.state.last_stop.confirmed, bench.state.last_stop
            assert bench.state.last_stop.at == pytest.approx(asked, abs=0.01)
            bench.do(Release("you"))
        elif deed == "talk":
            bench.do(AcquireLease("console"))
            bench.do(Raw("a", "console", Grade.HARMLESS))
            quiet = bench.clock.monotonic()
            bench.step(8.0)
            assert not received_since(bench, quiet), "a person has the console"
            bench.do(ReleaseLease("console"))
        else:
            bench.step(rng.uniform(0.0, 6.0))
            bench.device.unplug()
            bench.step(rng.uniform(0.5, 5.0))
            bench.device.plug()
        bench.do(ReleaseLease("you"))
        while not (
            bench.state.link.state is LinkPhase.UP and bench.state.surveyed and bench.state.activity is Activity.IDLE
        ):
            bench.step(0.1)
            assert bench.clock.monotonic() - begun < 120.0, (deed, bench.state.link, bench.state.activity)
        bench.step(1.0)
        begin = bench.clock.monotonic()
        bench.step(rng.uniform(12.0, 40.0))
        assert bench.state.link.state is LinkPhase.UP
        assert bench.state.fault is None
        calm.append((begin, bench.clock.monotonic()))
    for begin, until in calm:
        lines = [(at, line) for at, line in bench.received() if begin < at < until]
        assert busiest([at for at, _line in lines]) <= 30
        visits = [at for at, line in lines if line in MENUS]
        assert all(later - earlier >= 5.0 for earlier, later in pairwise(visits))
        read = [each.at for each in bench.events if isinstance(each, PositionRead) and begin < each.at < until]
        assert max(later - earlier for earlier, later in pairwise(read)) < 4.0
    told = {each.feature for each in bench.events if isinstance(each, ReadingRead)}
    watched = {
        name for name, each in CARRYOUT_G2.features.items()
        if each.is_readable and not each.read_hazard and each.cost.lines <= MOST_LINES
    }  # fmt: skip
    assert CARRYOUT_G2.features.keys() - watched >= {"eeprom", "transponders"}
    assert told >= watched
    assert "eeprom" not in told, "it takes 16 lines"
    assert not told & {"even_level", "odd_level"}, "nobody has agreed to that"
