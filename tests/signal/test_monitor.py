"""Which source is read while somebody looks, and the dish's own tuner as a source of its own."""

from __future__ import annotations

import pytest
from birdcage.base.config.feeds import FeedProfile
from birdcage.signal.listeners import Listeners
from birdcage.signal.monitor import SignalMonitor
from birdcage.signal.source import MONITOR, SignalFacts
from birdcage.signal.tuner import TunerSource

from tests.station.conftest import Bench
from tests.station.pursuit_bench import Phase, at, g2, plan_of


class Meter:
    """A source of somebody else."""

    trouble = ""

    def __init__(self, name):
        self.facts = SignalFacts(name, name, "V", None, 5.0, 1.0, None, 0.1, 2, 1.0, 0.0, of_dish=False, demo=False)
        self.log = []
        self.readings = Listeners()

    def subscribe(self, hear):
        return self.readings.add(hear)

    def watch(self, watcher, *, steady=False):
        self.log.append(f"watch {watcher}{' steadily' * steady}")

    def unwatch(self, watcher):
        self.log.append(f"unwatch {watcher}")


def test_only_the_source_of_the_feed_is_read_and_only_while_somebody_looks():
    one, other, heard = Meter("one"), Meter("other"), []
    monitor = SignalMonitor([one, other], "one", heard.append)
    assert (one.log, other.log) == ([], [])
    monitor.watch(on=True)
    monitor.watch(on=True)
    monitor.choose("other")
    assert (one.log, other.log) == ([f"watch {MONITOR}", f"unwatch {MONITOR}"], [f"watch {MONITOR}"])
    one.readings.tell("read for a pass")
    assert heard == ["read for a pass"]
    monitor.close()
    one.readings.tell("late")
    assert heard == ["read for a pass"]
    assert other.log[-1] == f"unwatch {MONITOR}"
    assert monitor.facts_of("one").unit == "V"


def test_it_is_read_steadily_while_the_signal_alone_counts_and_as_before_afterwards():
    one, other = Meter("one"), Meter("other")
    monitor = SignalMonitor([one, other], "one", lambda _reading: None)
    monitor.watch(on=True)
    monitor.watch(on=True, steady=True)
    monitor.watch(on=True, steady=True)
    monitor.choose("other")
    monitor.watch(on=True)
    monitor.watch(on=False)
    assert one.log == [f"watch {MONITOR}", f"watch {MONITOR} steadily", f"unwatch {MONITOR}"]
    assert other.log == [f"watch {MONITOR} steadily", f"watch {MONITOR}", f"unwatch {MONITOR}"]


@pytest.fixture
def bench():
    return Bench().connect()


def test_the_tuner_keeps_to_the_stations_budget(bench):
    """The same lines as for a watcher of `rssi`: four reads, every 5.2 s."""
    other = Bench().connect()
    source, heard = TunerSource(bench.station), []
    source.subscribe(heard.append)
    bench.watch("position", rate_hz=1.0)
    other.watch("position", "rssi", rate_hz=1.0)
    source.watch(MONITOR)
    for each in (bench, other):
        each.step(60.0)
    assert bench.lines() == other.lines()
    assert 40 <= len(heard) <= 48
    assert (heard[0].unit, heard[0].source) == ("counts", "tuner")
    assert bench.state.signal_owners == {"tuner": MONITOR}
    source.unwatch(MONITOR)
    told = len(heard)
    bench.step(20.0)
    assert len(heard) <= told + 1
    assert bench.state.signal_owners == {}


def test_a_reading_of_the_tuner_is_of_the_middle_of_its_exchange_without_the_change_of_menu(bench):
    source, heard = TunerSource(bench.station), []
    source.subscribe(lambda reading: heard.append((reading, bench.clock.monotonic())))
    source.watch(MONITOR)
    bench.step(20.0)
    asked = [when for when, line in bench.received() if line.startswith("rssi")]
    assert len(heard) >= 8
    for sent, (reading, answered) in zip(asked, heard, strict=False):
        assert sent < reading.at < answered
        assert reading.at == pytest.approx((sent + answered) / 2.0, abs=0.01)


def test_a_target_that_is_followed_owns_the_tuner_from_its_first_reading_on():
    bench = g2()
    source = TunerSource(bench.station)
    source.watch(MONITOR)
    bench.step(2.0)
    assert bench.state.signal_owners == {"tuner": MONITOR}
    bench.pursue(plan_of(at(bench), lasts_s=60.0, az_rate=0.0, low=40.0, high=40.0, name="slot"))
    bench.until(Phase.FOLLOWING).step(15.0)
    assert bench.state.signal_owners == {"tuner": "slot"}
    bench.until(Phase.OVER)
    assert bench.state.signal_owners == {"tuner": MONITOR}


def test_a_target_for_which_it_is_never_read_does_not_own_it():
    bench = g2()
    TunerSource(bench.station)
    bench.pursue(plan_of(at(bench), lasts_s=300.0))
    bench.until(Phase.FOLLOWING).step(20.0)
    assert bench.state.signal_owners == {}


def test_a_dish_without_a_tuner_says_so():
    source = TunerSource(Bench("hal205?seed=1", firmware="hal205").station)
    assert "has no tuner to read" in source.trouble
    source.watch(MONITOR)


@pytest.mark.parametrize(("signal", "reads"), [("tuner", True), ("rigctl", False)])
def test_what_a_receiver_hears_is_not_asked_of_the_tuner_in_a_pursuit(signal, reads):
    from birdcage.station.signal_excursion import SignalExcursion
    from birdcage.tracking.steps import Hear

    bench = Bench(options={"feed": FeedProfile(signal=signal)}).connect()
    bench.watch("position")
    bench.step(5.0)
    station = bench.station
    hearing = SignalExcursion(station._store, station._antenna, station._reader, station._watches)
    now_s = bench.clock.utc().timestamp()
    over = hearing.carry_out(Hear(now_s + 60.0, 9.0), now_s, at_once=False)
    assert over is not reads
