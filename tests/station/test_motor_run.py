"""A motor that runs while a key is held: on the twin of a machine that itself would run on for ever."""

from __future__ import annotations

import pytest
from birdcage.base.errors import (
    BirdcageError,
    CommandRefused,
    ConfirmationNeeded,
    Held,
    LeaseDenied,
    MotionRefused,
    PositionUnknown,
)
from birdcage.base.no_go import NoGoSector
from birdcage.rotator.ladder import StopMeans
from birdcage.station.events import ActivityChanged, TaskChanged
from birdcage.station.requests import AcquireLease, EndMotion, Goto, Release, Run, Set
from birdcage.station.state import Activity

from tests.easycomm.test_rotator import lines, met

AZ, EL = "duty.azimuth", "duty.elevation"


def run(stage, feature=AZ, value=0.1, holder="you", **more):
    return Run(feature, value, holder, agreed=True, **more)


def hold(stage, seconds, feature=AZ, value=0.1, *, begun=False):
    """Press the key, and let it repeat ten times a second."""
    if not begun:
        stage.do(run(stage, feature, value))
    for _ in range(round(seconds / 0.1)):
        stage.step(0.1)
        stage.station.submit(run(stage, feature, value, renews=True))


def stops(stage):
    return lines(stage).count("STOP")


def duties(stage):
    return [line for line in lines(stage) if line.startswith("DUTY")]


def test_it_turns_while_it_is_held_and_stop_goes_out_when_it_is_let_go():
    with met("&az=90&el=30") as stage:
        before = stage.truth.az_deg
        hold(stage, 3.0)
        assert duties(stage) == ["DUTY_AZ0.10"], "once, and not at every repeat"
        assert (stops(stage), stage.state.activity, stage.state.activity_text) == (0, Activity.MOTOR_RUN, "azimuth")
        assert stage.truth.moving
        assert stage.truth.az_deg - before > 5.0
        stage.step(0.9)
        assert stops(stage) == 1, "0.6 s after the last repeat, and what a look takes"
        stage.step(2.0)
        assert not stage.truth.moving
        state = stage.state
        assert (state.activity, state.tasks, state.held, state.fault) == (Activity.IDLE, (), None, None)
        stage.do(Goto(120.0, 40.0, "you"))
        assert (stage.truth.az_deg, stage.truth.el_deg) == pytest.approx((120.0, 40.0), abs=0.2)


def test_one_press_runs_for_a_second():
    with met("&az=90&el=30") as stage:
        stage.do(run(stage, EL, -0.1))
        stage.step(0.8)
        assert stops(stage) == 0
        stage.step(0.5)
        assert stops(stage) == 1
        stage.step(2.0)
        assert 20.0 < stage.truth.el_deg < 27.0


def test_stop_ends_it_at_once_and_a_key_that_is_still_held_begins_nothing():
    with met("&az=90&el=30") as stage:
        hold(stage, 1.0)
        stage.station.stop("you")
        assert stops(stage) == 1, "from the thread of whoever presses it"
        hold(stage, 2.0, begun=True)
        assert not stage.truth.moving
        assert stage.state.held is not None
        assert stage.state.last_stop.confirmed
        assert len(duties(stage)) == 1
        stage.refused(run(stage), Held)
        stage.do(Release("you"))
        hold(stage, 1.0, begun=True)
        assert len(duties(stage)) == 1, "it has to be let go first"


@pytest.mark.parametrize(("value", "el", "least", "most"), [(0.3, 60, 70.0, 90.0), (-0.3, 20, 0.0, 14.0)])
def test_it_stops_short_of_a_limit_however_long_it_is_held(value, el, least, most):
    with met(f"&az=90&el={el}") as stage:
        seen = []
        hold(stage, 0.1, EL, value)
        for _ in range(40):
            hold(stage, 0.1, EL, value, begun=True)
            seen.append(stage.truth.el_deg)
        assert (stops(stage), len(duties(stage))) == (1, 1)
        assert min(seen) >= 0.0
        assert max(seen) <= 90.0
        assert not stage.truth.moving
        assert least <= stage.truth.el_deg <= most


def test_it_does_not_begin_towards_a_limit_that_it_stands_at():
    with met("&az=90&el=89.5") as stage:
        assert "its limit that way is 90.00°" in str(stage.refused(run(stage, EL, 0.1), MotionRefused))
        assert duties(stage) == []
        hold(stage, 1.0, EL, -0.1)
        assert stage.truth.el_deg < 87.0


def test_it_stops_short_of_the_end_of_the_cable():
    with met("&az=0&el=30") as stage:
        for az in (120.0, 240.0, 350.0):
            stage.do(Goto(az, 30.0, "you"))
        hold(stage, 3.0, AZ, 0.35)
        assert stops(stage) == 1
        stage.step(3.0)
        assert 350.0 <= stage.truth.az_deg <= 360.0
        assert stage.state.position.cable_deg <= 360.0


def test_a_motor_that_is_wired_the_other_way_stops_short_of_the_limit_that_it_runs_into(monkeypatch):
    from birdcage.sim.easycomm.servo import ServoAxis

    drive = ServoAxis.drive
    monkeypatch.setattr(
        ServoAxis, "drive", lambda self, now_s, duty: drive(self, now_s, None if duty is None else -duty)
    )
    with met("&az=90&el=12") as stage:
        hold(stage, 4.0, EL, 0.2)
        assert stops(stage) == 1
        assert 0.5 < stage.truth.el_deg < 12.0


def test_a_motor_that_is_not_seen_to_turn_is_stopped():
    with met("&az=90&el=30") as stage:
        hold(stage, 3.5, AZ, 0.0)
        assert stops(stage) == 1
        assert stage.state.held is None


def test_whoever_has_no_control_runs_nothing_and_who_loses_it_runs_no_more():
    with met("&az=90&el=30") as stage:
        stage.do(AcquireLease("tracker"))
        stage.refused(run(stage), LeaseDenied)
        assert duties(stage) == []
        stage.do(run(stage, holder="tracker"))
        stage.step(0.5)
        stage.do(AcquireLease("you", take_over=True))
        stage.step(0.3)
        assert stops(stage) == 1
        assert stage.state.holder == "you"


def test_a_go_to_of_the_same_hand_ends_it_and_both_axes_are_sent():
    with met("&az=90&el=30") as stage:
        hold(stage, 1.0)
        stage.do(Goto(100.0, 35.0, "you"))
        assert stops(stage) == 1
        assert (stage.truth.az_deg, stage.truth.el_deg) == pytest.approx((100.0, 35.0), abs=0.2)


def test_end_motion_ends_it():
    with met("&az=90&el=30") as stage:
        hold(stage, 0.5)
        stage.do(EndMotion("you"))
        assert stops(stage) == 1


def test_the_end_of_the_program_ends_it():
    with met("&az=90&el=30") as stage:
        hold(stage, 0.5)
        stage.station.end()
        stage.station.shut()
        assert stops(stage) == 1


def test_it_is_refused_where_nobody_agreed_to_it_or_the_direction_is_not_known_or_it_is_only_set():
    with met("&az=90&el=30") as stage:
        assert "only the switch" in str(stage.refused(Run(AZ, 0.1, "you"), ConfirmationNeeded))
        stage.refused(run(stage, "kp"), CommandRefused)
        assert "only while it is held" in str(stage.refused(Set(AZ, 0.1, "you", agreed=True), CommandRefused))
        assert duties(stage) == []
    with met("&az=0&el=30", told=False) as stage:
        assert "birdcage sync" in str(stage.refused(run(stage), PositionUnknown))
        assert duties(stage) == []


def test_a_line_that_is_lost_while_it_runs_is_told_and_stop_goes_out_as_soon_as_it_is_back():
    with met("&az=90&el=30") as stage:
        hold(stage, 0.5)
        stage.twin.device.unplug()
        stage.step(3.0)
        assert stage.truth.moving, "its firmware does not know that anybody is gone"
        assert stage.state.held is not None
        assert "link is lost" in next(each.task.why for each in reversed(stage.events) if isinstance(each, TaskChanged))
        assert stops(stage) == 0
        stage.twin.device.plug()
        stage.step(4.0)
        assert stops(stage) >= 1
        assert not stage.truth.moving


def test_a_stop_that_is_not_answered_is_repeated_and_the_dish_is_held(monkeypatch):
    from birdcage.sim.easycomm.rp2040 import Rp2040Board

    stop, asked = Rp2040Board._stop, []

    def deaf(self, *axes):
        asked.append(self.now_s)
        return stop(self, *axes) if len(asked) > 3 else ""

    monkeypatch.setattr(Rp2040Board, "_stop", deaf)
    with met("&az=90&el=30") as stage:
        hold(stage, 0.5)
        stage.step(8.0)
        assert len(asked) >= 4
        assert not stage.truth.moving
        assert stage.state.held is not None
        assert stage.state.last_stop.confirmed


def test_it_turns_through_north_where_the_cable_goes_on():
    with met("&az=4&el=30") as stage:
        hold(stage, 3.0, AZ, -0.1)
        assert stops(stage) == 0
        assert stage.state.position.cable_deg < -2.0


def test_a_no_go_sector_ends_it_and_a_go_to_through_one_leaves_it_at_rest():
    with met("&az=90&el=30") as stage:
        stage.station._antenna.gate.update(sectors=(NoGoSector(100.0, 140.0, 50.0),))
        hold(stage, 4.0)
        assert stops(stage) == 1
        assert 92.0 < stage.truth.az_deg < 100.0
        hold(stage, 0.5, AZ, -0.1)
        stage.refused(Goto(180.0, 30.0, "you"), MotionRefused)
        assert stops(stage) == 2
        stage.step(3.0)
        assert stage.state.activity is Activity.IDLE


def test_it_is_refused_while_the_dish_moves_and_where_no_stop_is_known_to_work():
    with met("&az=90&el=30") as stage:
        going = stage.station.submit(Goto(120.0, 30.0, "you"))
        stage.step(0.5)
        assert "while the dish moves" in str(stage.refused(run(stage), BirdcageError))
        assert stage.truth.moving
        stage.until(going.done, 20.0, "it is there")
        stage.station._antenna.strategy.found_to_fail(StopMeans.COMMAND)
        assert "no STOP that is known to work" in str(stage.refused(run(stage), MotionRefused))
        assert duties(stage) == []


def test_a_stop_in_the_last_moment_keeps_it_from_being_sent():
    with met("&az=90&el=30") as stage:

        def hear(event):
            if event.activity is Activity.MOTOR_RUN:
                stage.station.stop("you")

        stage.station.subscribe(hear, ActivityChanged)
        stage.do(run(stage))
        stage.step(1.0)
        assert duties(stage) == []
        assert stops(stage) == 1
