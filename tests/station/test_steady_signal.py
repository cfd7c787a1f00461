"""The signal watched steadily: the tuner's menu is home while the dish rests, and the position is the excursion."""

from __future__ import annotations

from itertools import pairwise

import pytest
from birdcage.station.events import StopConfirmed
from birdcage.station.requests import Goto, Jog, Unwatch, Watch
from birdcage.station.state import Activity, LinkPhase

from .conftest import Bench

POSITION_S = 1.0


@pytest.fixture
def steady():
    """A bench that has been watched steadily for a while, with position."""
    bench = Bench("g2?seed=1").connect(6.0)
    watch(bench)
    bench.step(10)
    return bench


def watch(bench, *more, rate_hz=10.0):
    bench.station.submit(Watch("tuner monitor", frozenset({"rssi"}), rate_hz, steady=True))
    bench.watch("position", *more, rate_hz=1.0)


def lines_of(bench, seconds):
    """Return what was sent in the next seconds, with its times."""
    start = bench.clock.monotonic()
    bench.step(seconds)
    return [(at, line) for at, line in bench.received() if at > start]


def test_it_is_read_nearly_as_often_as_asked_with_a_position_a_second(steady):
    sent = lines_of(steady, 20)
    reads = [at for at, line in sent if line.startswith("rssi")]
    looks = [at for at, line in sent if line == "a"]
    assert len(reads) > 20 * 6
    assert 18 <= len(looks) <= 21
    assert max(later - earlier for earlier, later in pairwise(looks)) < POSITION_S + 0.4


def test_it_is_read_no_oftener_than_asked():
    bench = Bench("g2?seed=1").connect(6.0)
    watch(bench, rate_hz=2.0)
    bench.step(5)
    reads = [at for at, line in lines_of(bench, 20) if line.startswith("rssi")]
    assert 38 <= len(reads) <= 41


def test_only_the_menus_of_motors_and_tuner_are_visited(steady):
    assert {line for _at, line in lines_of(steady, 10)} <= {"", "q", "mot", "dvb", "a", "rssi 10"}


def test_what_else_is_watched_is_read_meanwhile_and_takes_little_of_it(steady):
    steady.watch("position", "lock", "raw_rssi", rate_hz=5.0)
    sent = lines_of(steady, 30)
    assert len([1 for _at, line in sent if line.startswith("rssi ")]) > 30 * 6
    assert 4 <= len([1 for _at, line in sent if line == "ls"]) <= 7
    assert 3 <= len([1 for _at, line in sent if line == "adc"]) <= 7
    assert {"lock", "raw_rssi", "rssi"} <= steady.state.readings.keys()


def test_all_that_is_watched_has_its_turn(steady):
    panel = {"lock", "snr", "network", "rf_agc", "raw_rssi", "frequency", "transponder", "lnb_supply", "tuner_chip"}
    steady.watch("position", *panel)
    start = steady.clock.monotonic()
    steady.step(20)
    assert panel <= steady.state.readings.keys()
    steady.step(60)
    ages = {each: steady.clock.monotonic() - steady.state.readings[each].at for each in panel - {"tuner_chip"}}
    assert max(ages.values()) < 20.0, ages
    sent = [line for at, line in steady.received() if at > start]
    assert sent.count("config") == 1, "the chip stays what it is"


def test_both_polarisations_are_heard_only_where_somebody_has_agreed(steady):
    both = frozenset({"even_level", "odd_level"})
    steady.station.submit(Watch("page", both))
    assert "rssits" not in [line for _at, line in lines_of(steady, 20)]
    steady.station.submit(Watch("page", both, agreed=True))
    sent = lines_of(steady, 40)
    toggled = [at for at, line in sent if line == "rssits"]
    assert 6 <= len(toggled) <= 8
    assert min(later - earlier for earlier, later in pairwise(toggled)) > 5.0
    assert len([1 for _at, line in sent if line.startswith("rssi ")]) > 40 * 5, "and the signal is read on"
    steady.station.submit(Unwatch("page"))
    assert "rssits" not in [line for _at, line in lines_of(steady, 20)]


def test_a_step_by_hand_goes_out_at_once_and_it_is_read_again_where_the_dish_has_come_to_rest(steady):
    before = steady.clock.monotonic()
    az_deg = steady.state.position.az_deg
    steady.do(Jog(0.5, 0.0, "you"))
    assert steady.clock.monotonic() - before < 1.5
    reads = [line for _at, line in lines_of(steady, 5) if line.startswith("rssi")]
    assert len(reads) > 20
    assert steady.state.position.az_deg == pytest.approx(az_deg + 0.5, abs=0.1)


def test_nothing_but_the_position_is_asked_while_the_dish_moves():
    bench = Bench("g2?seed=1&az_speed=2").connect(6.0)
    watch(bench)
    bench.step(5)
    bench.station.submit(Goto(200.0, 40.0, "you"))
    bench.step(1)
    assert bench.state.activity is Activity.SLEWING
    assert {line for _at, line in lines_of(bench, 5)} == {"a"}


def test_stop_at_rest_sends_no_target_and_it_is_read_on_while_held(steady):
    start = steady.clock.monotonic()
    steady.station.stop("you")
    steady.step(5)
    sent = [line for at, line in steady.received() if at >= start]
    assert not [line for line in sent if line.startswith("a ")]
    assert [event for event in steady.events if isinstance(event, StopConfirmed)]
    assert steady.state.held is not None
    assert len([1 for _at, line in lines_of(steady, 5) if line.startswith("rssi")]) > 20


def test_when_nobody_watches_steadily_any_more_the_budget_of_a_dish_at_rest_holds(steady):
    steady.station.submit(Unwatch("tuner monitor"))
    steady.station.submit(Watch("strip", frozenset({"rssi"})))
    steady.step(1)
    times = [at for at, _line in lines_of(steady, 40)]
    for first in times:
        assert sum(first <= at < first + 10 for at in times) <= 30
    assert len(times) > 60


def test_readings_are_stamped_at_the_middle_of_their_dwell(steady):
    line_at = next(at for at, line in lines_of(steady, 3) if line.startswith("rssi"))
    told = [event.at for event in steady.events if getattr(event, "feature", "") == "rssi" and event.at > line_at]
    assert told[0] - line_at == pytest.approx(0.05, abs=0.03)  # ten reads of 10 ms, and half of the latency


def test_a_damaged_answer_is_asked_for_again_after_a_second(steady):
    """Not after the half minute for which a feature is left alone that makes no sense."""
    sim, damaged = steady.sim, []
    read = sim.read

    def reading(*args):
        data = read(*args)
        if b"RSSI[" in data and len(damaged) < 2:
            damaged.append(data)
            data = data.replace(b"RSSI[", b"RS?I[")
        return data

    sim.read = reading
    start = steady.clock.monotonic()
    steady.step(6)
    assert damaged
    told = [event.at for event in steady.events if getattr(event, "feature", "") == "rssi" and event.at > start]
    assert len(told) > 15
    assert max(later - earlier for earlier, later in pairwise([start, *told])) < 3.5
    assert steady.state.fault is None


def test_on_a_line_with_noise_it_goes_on(steady):
    """With one byte in 2000 damaged."""
    steady.device.wire.to_host.garble = 0.0005
    start = steady.clock.monotonic()
    steady.step(60)
    told = [event.at for event in steady.events if getattr(event, "feature", "") == "rssi" and event.at > start]
    assert len(told) > 150
    steady.device.wire.to_host.garble = 0.0
    steady.step(10)
    assert steady.state.link.state is LinkPhase.UP
    assert steady.state.fault is None
    assert len([1 for _at, line in lines_of(steady, 5) if line.startswith("rssi")]) > 30
