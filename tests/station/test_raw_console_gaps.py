"""What random stories around the console brought to light, one by one."""

from __future__ import annotations

import pytest
from birdcage.base.clock import RealClock
from birdcage.base.config import Settings
from birdcage.base.errors import BirdcageError, CommandRefused, Held, LeaseDenied
from birdcage.rotator.facts import CableTurn
from birdcage.station.inhibitor import SleepInhibitor
from birdcage.station.raw import CONSOLE, Grade
from birdcage.station.requests import (
    ApplySettings,
    Connect,
    Engage,
    Home,
    ProbePort,
    Raw,
    ReleaseLease,
    ReleaseMotors,
    SetSpeed,
)
from birdcage.station.state import Activity

from .raw_console_bench import TalkBench, lines_since


@pytest.fixture
def bench():
    return TalkBench()


def test_the_same_port_chosen_anew_does_not_make_a_released_dish_believed():
    bench = TalkBench("g2?seed=1&release_forgets=0")
    bench.type("r", confirmed=Grade.RUINS)
    bench.do(ReleaseLease(CONSOLE))
    bench.step(2)
    bench.do(Connect("sim:test", None))
    bench.step(5)
    assert bench.state.position_lost == "released"
    assert bench.state.position is None


def test_another_port_has_another_dish():
    bench = TalkBench("g2?seed=1&release_forgets=0")
    bench.type("r", confirmed=Grade.RUINS)
    bench.do(ReleaseLease(CONSOLE))
    bench.step(2)
    bench.do(Connect("sim:other", None))
    bench.step(5)
    assert bench.state.position is not None


def test_stop_in_the_middle_of_an_idle_reading_goes_on_until_the_dish_was_seen(bench):
    write, done = bench.sim.write, []

    def writing(data):
        write(data)
        if data == b"a\r" and not done:
            done.append(data)
            bench.station.stop("you")

    bench.sim.write = writing
    while not done:
        bench.step(0.01)
    while bench.state.last_stop is None or bench.state.last_stop.confirmed is None:
        assert bench.state.last_stop is None or bench.state.activity is Activity.STOPPING
        if bench.state.last_stop is not None:
            with pytest.raises(CommandRefused, match="birdcage is moving the dish"):
                bench.do(Raw("a", CONSOLE))
            break
        bench.step(0.001)
    bench.step(2)
    assert bench.state.last_stop.confirmed is True


def test_a_restart_in_the_middle_of_a_typed_line_is_noticed(bench):
    bench.do(Home("you"))
    bench.do(ReleaseLease("you"))
    assert bench.state.turn is CableTurn.COUNTED
    bench.type("q")
    bench.type("dvb")
    stream = bench.begin("agc")
    bench.step(2)
    bench.device.reboot()
    bench.step(60)
    assert stream.done()
    assert bench.state.fault.reason == "reboot"
    assert bench.state.turn is CableTurn.UNKNOWN
    assert bench.state.homed is not True


def test_while_a_raw_line_may_have_moved_the_dish_nothing_relies_on_its_rest(bench):
    bench.in_raw_motion("a 0 170", seconds=0.1)
    for request in (ApplySettings(Settings(), "you"), ProbePort(), Connect("sim:test", None), Engage(CONSOLE)):
        with pytest.raises(BirdcageError) as refused:
            bench.do(request)
        assert refused.value.reason == "moving"
    assert "e" not in bench.lines()
    bench.do(ReleaseLease(CONSOLE))
    bench.step(12)
    bench.do(ApplySettings(Settings(), "you"))


@pytest.mark.parametrize("request_", [ReleaseMotors("Gpredict"), SetSpeed(0, 5.0, "Gpredict")])
def test_who_has_no_control_ends_no_stream(bench, request_):
    bench.type("q")
    bench.type("dvb")
    stream = bench.begin("agc")
    bench.step(2)
    with pytest.raises(LeaseDenied):
        bench.do(request_)
    bench.step(2)
    assert not stream.done()


def test_a_mistyped_line_that_the_dish_refuses_costs_nothing(bench):
    bench.counted()
    bench.type("mto", confirmed=Grade.RUINS)
    assert bench.state.position_lost is None
    bench.do(ReleaseLease(CONSOLE))
    bench.step(3)
    assert bench.state.turn is CableTurn.COUNTED


def test_an_unwritten_line_that_the_dish_takes_makes_the_station_look_anew(bench):
    bench.counted()
    bench.device.shell._menus["mot"].commands["zz"] = lambda _args: iter(["done\n"])
    bench.type("zz", confirmed=Grade.RUINS)
    assert bench.state.position_lost == "raw command"
    assert bench.state.turn is CableTurn.UNKNOWN
    surveys = bench.lines().count("d 102")
    bench.do(ReleaseLease(CONSOLE))
    bench.step(8)
    assert bench.state.position_lost is None
    assert bench.lines().count("d 102") == surveys + 1


def test_current_is_not_put_on_by_hand_while_held(bench):
    bench.station.stop("you")
    bench.step(2)
    since = bench.clock.monotonic()
    for line in ("e", "stow", "mto;a 0 100", "motorb"):
        with pytest.raises(Held):
            bench.type(line, confirmed=Grade.RUINS)
    assert not {"e", "stow"} & set(lines_since(bench, since))


def test_no_line_is_longer_than_any_command_needs(bench):
    since = bench.clock.monotonic()
    with pytest.raises(CommandRefused, match="120 characters at most"):
        bench.type("a" * 121, confirmed=Grade.RUINS)
    assert "a" * 121 not in lines_since(bench, since)
    bench.type("x" * 120, confirmed=Grade.RUINS)


def test_after_the_speeds_were_changed_by_hand_stop_looks_before_it_aims(bench):
    bench.counted()
    for line in ("q", "step", "mv 0 600", "q", "mot"):
        bench.type(line, confirmed=Grade.RUINS)
    bench.type("a 0 100", confirmed=Grade.RUINS)
    bench.step(2)
    before = bench.device.truth()
    assert before.moving
    bench.station.stop("you")
    bench.step(6)
    assert bench.at_rest()
    assert bench.device.truth().az_deg > before.az_deg - 5
    assert bench.state.last_stop.confirmed is True


def test_a_slow_raw_motion_is_not_taken_for_rest():
    bench = TalkBench("g2?seed=1&az_speed=1")
    bench.in_raw_motion("a 0 20", seconds=0.3)
    bench.do(ReleaseLease(CONSOLE))
    bench.step(5)
    assert not bench.at_rest()
    assert bench.state.activity is not Activity.IDLE
    bench.step(60)
    assert bench.at_rest()
    assert bench.state.activity is Activity.IDLE
    assert bench.state.fault is None


def test_homing_one_axis_before_a_release_does_not_count_after_it():
    bench = TalkBench("g2?seed=1&release_forgets=0")
    bench.type("h 0", confirmed=Grade.RUINS)
    bench.type("r", confirmed=Grade.RUINS)
    bench.type("h 1", confirmed=Grade.RUINS)
    assert bench.state.homed is None


class Hold:
    def __init__(self):
        self.held = 0

    def __call__(self):
        self.held += 1
        return self

    def works(self):
        return True

    def let_go(self):
        self.held -= 1


def test_the_machine_stays_awake_while_a_raw_line_may_move_the_dish():
    bench, hold = TalkBench(), Hold()
    bench.station._store.change(demo=False)
    inhibitor = SleepInhibitor(bench.station, hold, after_s=0.05)
    clock = RealClock()

    def become(count):
        end = clock.monotonic() + 5
        while hold.held != count and clock.monotonic() < end:
            clock.wait(None, clock.monotonic() + 0.01)
        return hold.held == count

    try:
        bench.type("a 0 170", confirmed=Grade.RUINS)
        assert become(1)
        clock.wait(None, clock.monotonic() + 0.2)
        assert hold.held == 1
        bench.do(ReleaseLease(CONSOLE))
        bench.step(12)
        assert become(0)
        bench.type("r", confirmed=Grade.RUINS)
        assert become(1)
        bench.do(ReleaseLease(CONSOLE))
        bench.step(3)  # it does not say that it rests: its position is unknown
        assert not bench.state.raw_motion
        assert become(0)
    finally:
        inhibitor.close()
