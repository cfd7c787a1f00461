"""Work on the motors by hand: current, speed, stow."""

from __future__ import annotations

import pytest
from birdcage.base.errors import (
    BirdcageError,
    CommandRefused,
    Held,
    LeaseDenied,
    MotionRefused,
    OutOfRange,
    PositionUnknown,
    Stopped,
)
from birdcage.rotator.facts import CableTurn
from birdcage.station.requests import AcquireLease, Engage, Goto, Home, Release, ReleaseMotors, SetSpeed, Stow
from birdcage.station.state import Activity

from .conftest import Bench


@pytest.fixture
def bench():
    return surveyed(Bench())


def surveyed(bench):
    bench.watch("position", rate_hz=1.0)
    bench.connect(6.0)
    assert bench.state.firmware_version is not None
    return bench


STOWABLE = {"stow_allowed": True}


def stowable(query="", **options):
    return Bench(f"g2?seed=1&az=-180&stow_az=-60&stow_el=20{query}", STOWABLE | options).connect()


def held(bench):
    bench.station.stop("you")
    bench.step(2)
    assert bench.state.held is not None
    return bench


def test_releasing_forgets_position_turn_and_homing(bench):
    bench.do(Home("you"))
    assert bench.state.turn is CableTurn.COUNTED
    bench.do(ReleaseMotors("you"))
    state = bench.state
    assert (state.position, state.position_lost, state.turn, state.homed) == (None, "released", CableTurn.UNKNOWN, None)
    assert state.activity is Activity.IDLE
    assert bench.device.truth().released


def test_stop_after_a_release_says_that_nothing_drives_the_dish(bench):
    bench.do(ReleaseMotors("you"))
    before = bench.clock.monotonic()
    held(bench)
    report = bench.state.last_stop
    assert "released" in report.sentence
    assert "Home it" in report.sentence
    assert bench.moves_since(before) == []


def test_held_does_not_keep_a_person_from_releasing_the_motors(bench):
    held(bench)
    bench.do(ReleaseMotors("you"))
    assert bench.device.truth().released
    assert bench.state.held is not None, "the latch holds all the same"
    assert bench.state.holder is None


def test_a_release_asked_for_before_stop_is_dropped(bench):
    future = bench.station.submit(ReleaseMotors("you"))
    bench.station.stop("you")
    bench.step(2)
    with pytest.raises(Stopped, match="keep their current"):
        future.result(0)
    assert "r" not in bench.lines()
    assert not bench.device.truth().released


def test_releasing_ends_what_stop_still_watches(bench):
    bench.station.submit(Goto(180, 45, "you"))
    bench.step(0.5)
    bench.station.stop("you")
    bench.do(ReleaseMotors("you"))
    before = bench.clock.monotonic()
    bench.step(3)
    assert bench.moves_since(before) == []
    assert "released" in bench.state.last_stop.sentence


def test_a_stop_that_was_not_answered_is_not_repeated_to_released_motors(bench):
    bench.station.submit(Goto(180, 45, "you"))
    bench.step(0.5)
    bench.station.stop("you")
    bench.step(0.001)
    stopper = bench.station._stopper
    assert stopper.due is not None
    stopper.motors_were_released()
    assert stopper.due is None
    assert "released" in bench.state.last_stop.sentence


def test_releasing_under_another_holder_is_denied(bench):
    bench.do(AcquireLease("tracker"))
    with pytest.raises(LeaseDenied):
        bench.do(ReleaseMotors("you"))


def test_engaging_gives_current_and_no_position(bench):
    bench.do(ReleaseMotors("you"))
    bench.do(Engage("you"))
    assert not bench.device.truth().released
    assert bench.state.position is None
    with pytest.raises(PositionUnknown):
        bench.do(Goto(180, 45, "you"))
    bench.do(Home("you"))
    assert bench.do(Goto(180, 45, "you")).az_deg == pytest.approx(180, abs=0.1)


def test_engaging_does_not_trust_a_dish_that_goes_on_counting():
    bench = Bench("g2?seed=1&release_forgets=0").connect()
    bench.do(ReleaseMotors("you"))
    bench.do(Engage("you"))
    bench.step(3)
    assert (bench.state.position, bench.state.position_lost) == (None, "released")


def test_engaging_is_a_motion_that_held_refuses(bench):
    bench.do(ReleaseMotors("you"))
    held(bench)
    with pytest.raises(Held):
        bench.do(Engage("you"))
    assert bench.device.truth().released
    bench.do(Release("you"))
    bench.do(Engage("you"))


def test_stow_needs_a_feed_that_allows_it():
    bench = Bench(options={"stow_allowed": False, "feed_name": "helix"}).connect()
    with pytest.raises(MotionRefused, match=r"'helix'.*crushed.*stow_allowed") as refused:
        bench.do(Stow("you"))
    assert refused.value.reason == "feed"
    assert "stow" not in bench.lines()


@pytest.mark.parametrize("blocks", [0, 1])
def test_stow_ends_where_the_dish_came_to_rest(blocks):
    bench = stowable(f"&stow_blocks={blocks}")
    pointing = bench.do(Stow("you"))
    assert (pointing.az_deg, pointing.el_deg) == (pytest.approx(300, abs=0.1), pytest.approx(20, abs=0.1))
    assert not bench.device.truth().moving
    assert bench.lines().count("stow") == 1
    state = bench.state
    assert (state.activity, state.position_lost, state.turn) == (Activity.IDLE, None, CableTurn.UNKNOWN)
    seen = [event.activity for event in bench.events if type(event).__name__ == "ActivityChanged"]
    assert Activity.STOWING in seen
    assert Activity.MOVING_UNASKED not in seen
    assert state.fault is None


def test_while_it_stows_the_state_says_so():
    bench = stowable("&az_speed=10")
    bench.station.submit(Stow("you"))
    bench.step(3)
    assert bench.state.activity is Activity.STOWING
    assert bench.state.motion is None
    assert bench.state.target_az_deg is None
    assert bench.station.bar(), "leaving now would send STOP"


def test_an_unhomed_dish_is_not_stowed():
    bench = Bench("g2?seed=1&unhomed=1", STOWABLE).connect()
    with pytest.raises(PositionUnknown, match="Home it first") as refused:
        bench.do(Stow("you"))
    assert refused.value.reason == "unhomed"
    assert "stow" not in bench.lines()


def test_held_refuses_to_stow():
    bench = held(stowable())
    with pytest.raises(Held):
        bench.do(Stow("you"))
    assert "stow" not in bench.lines()


def test_nothing_is_stowed_engaged_or_set_while_the_dish_moves():
    bench = stowable("&az_speed=10")
    bench.station.submit(Goto(90, 45, "you"))
    bench.step(1)
    for request in (Stow("you"), Engage("you"), SetSpeed(0, 10, "you")):
        with pytest.raises(BirdcageError, match="while the dish moves") as refused:
            bench.do(request)
        assert refused.value.reason == "moving"
    assert bench.state.activity is Activity.SLEWING


def test_stop_while_it_stows_is_tried_from_the_motor_menu():
    bench = stowable("&az_speed=10")
    future = bench.station.submit(Stow("you"))
    bench.step(3)
    assert bench.device.truth().moving
    before = bench.clock.monotonic()
    bench.station.stop("you")
    bench.step(6)
    said = [event.report.sentence for event in bench.events if type(event).__name__ == "StopSent"]
    assert "No STOP is documented for stowing" in said[0]
    with pytest.raises(Stopped):
        future.result(0)
    truth = bench.device.truth()
    assert not truth.moving
    assert truth.cable_deg < -90, "long before the stow position"
    assert any(line.startswith("a 0 ") for line in bench.moves_since(before))
    assert bench.state.last_stop.confirmed is True
    assert bench.state.activity is Activity.IDLE


def test_stop_while_stowing_keeps_the_shell_busy_says_what_is_left():
    bench = stowable("&az_speed=10&stow_blocks=1")
    machine = bench.device.machine
    machine.at(bench.clock.monotonic() + 5.0, lambda: bench.station.stop("you"))
    future = bench.station.submit(Stow("you"))
    bench.step(20)
    with pytest.raises(Stopped):
        future.result(0)
    said = [event.report.sentence for event in bench.events if type(event).__name__ == "StopSent"]
    assert said == ["Stowing cannot be stopped from here: cut the power of the dish."]
    assert bench.state.held is not None
    assert not bench.device.truth().moving
    assert (bench.state.activity, bench.state.position_lost) == (Activity.IDLE, None)


def test_the_speeds_in_force_are_read_with_the_survey(bench):
    readings = bench.state.readings
    assert readings["speed.azimuth"].value == pytest.approx(65.0, abs=0.01)
    assert readings["speed.elevation"].value == pytest.approx(45.0, abs=0.01)
    assert readings["speed.azimuth"].unit == "deg/s"


def test_a_lower_speed_is_set_read_back_and_planned_with(bench):
    assert bench.do(SetSpeed(0, 10.0, "you")) == pytest.approx(10.0, abs=0.01)
    assert "mv 0 1111" in bench.lines()
    assert bench.state.readings["speed.azimuth"].value == pytest.approx(10.0, abs=0.01)
    assert bench.state.readings["speed.elevation"].value == pytest.approx(45.0, abs=0.01)
    start = bench.clock.monotonic()
    future = bench.station.submit(Goto(260, 45, "you"))
    bench.step(0.5)
    assert bench.state.motion.eta - start == pytest.approx(10.1, abs=0.3)
    while not future.done():
        bench.step(0.1)
    assert bench.clock.monotonic() - start == pytest.approx(10.3, abs=0.5)


def test_stop_aims_with_the_lower_speed(bench):
    bench.do(SetSpeed(0, 10.0, "you"))
    bench.station.submit(Goto(260, 45, "you"))
    bench.step(3)
    at = bench.device.truth().az_deg
    bench.station.stop("you")
    bench.step(3)
    truth = bench.device.truth()
    assert not truth.moving
    assert at - 2.0 < truth.az_deg <= at
    assert bench.state.last_stop.confirmed is True


@pytest.mark.parametrize("speed", [0.0, -5.0, 65.1, float("nan"), float("inf")])
def test_a_speed_out_of_range_is_refused_with_the_range(bench, speed):
    with pytest.raises(OutOfRange, match=r"Greatest azimuth speed.*(0.009 to 65 deg/s|no number)"):
        bench.do(SetSpeed(0, speed, "you"))
    assert bench.state.readings["speed.azimuth"].value == pytest.approx(65.0, abs=0.01)
    assert not [line for line in bench.lines() if line.startswith("mv 0")]


def test_no_such_motor(bench):
    with pytest.raises(MotionRefused, match="no motor 7"):
        bench.do(SetSpeed(7, 5.0, "you"))


def test_a_speed_is_denied_to_who_has_no_control(bench):
    bench.do(AcquireLease("tracker"))
    with pytest.raises(LeaseDenied):
        bench.do(SetSpeed(0, 5.0, "you"))


def test_a_dish_that_does_not_take_the_speed_is_told_of(bench):
    text = "Max Vel [0] = 7222\nMax Vel [1] = 3120\n"
    bench.device.shell._menus["step"].commands["mv"] = lambda args: (line for line in [text])
    with pytest.raises(CommandRefused, match=r"10.00°/s.*shows 65.00°/s|shows 65"):
        bench.do(SetSpeed(0, 10.0, "you"))
    assert "speed.azimuth" not in bench.state.readings


def test_speeds_are_forgotten_with_a_restart_and_read_again(bench):
    bench.do(SetSpeed(1, 5.0, "you"))
    bench.device.reboot()
    bench.step(1.0)
    assert "speed.elevation" not in bench.state.readings
    bench.step(30)
    assert bench.state.readings["speed.elevation"].value == pytest.approx(45.0, abs=0.01)


def test_a_speed_set_by_another_program_is_seen_on_connecting():
    bench = Bench()
    bench.device.board.dish.axes[0].data.max_rate_deg_s = 5.0
    surveyed(bench)
    assert bench.state.readings["speed.azimuth"].value == pytest.approx(5.0, abs=0.01)
    bench.station.submit(Goto(310, 45, "you"))
    bench.step(0.5)
    assert bench.state.motion.eta - bench.state.motion.started == pytest.approx(10.0, abs=0.2)


def test_a_dish_without_the_stepper_menu_still_comes_up():
    bench = Bench()
    del bench.device.shell._menus["step"]
    from birdcage.sim.g2 import root

    menus = dict(root.SUBMENUS)
    root.SUBMENUS.pop("step")
    try:
        surveyed(bench)
        assert "speed.azimuth" not in bench.state.readings
    finally:
        root.SUBMENUS.clear()
        root.SUBMENUS.update(menus)


def test_both_speeds_may_stand_on_one_line():
    bench = Bench()
    text = "Max Vel [0] = 7222 / Max Vel [1] = 3120\n"
    bench.device.shell._menus["step"].commands["mv"] = lambda args: (line for line in [text])
    readings = surveyed(bench).state.readings
    assert readings["speed.azimuth"].value == pytest.approx(65.0, abs=0.01)
    assert readings["speed.elevation"].value == pytest.approx(45.0, abs=0.01)
