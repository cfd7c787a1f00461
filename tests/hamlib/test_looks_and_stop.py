"""At the server: how often it is asked where its rotator is, and what STOP says to servers that know less."""

from __future__ import annotations

from itertools import pairwise

import pytest
from birdcage.station.pursuit_state import PursuitOptions
from birdcage.station.requests import AcknowledgeFault, Goto, Jog, Pursue, Release, Watch
from birdcage.station.state import Activity, LinkPhase
from birdcage.testing import MachineBench, Stage
from birdcage.testing.passing import made_up_pass
from rotctl_twin import server

AT = "seed=1&az=100&el=30"


def stage_at(options=AT):
    return Stage(MachineBench("rotctl", server(options), stops=()))


def gaps(twin, since=0.0):
    asked = [at for at, line in twin.lines() if line == "p" and at >= since]
    return [later - earlier for earlier, later in pairwise(asked)]


def test_a_position_is_asked_for_once_a_second_at_most():
    with stage_at() as stage:
        stage.ready()
        stage.station.submit(Watch("a face", frozenset({"position"}), 20.0))
        stage.step(5.0)
        stage.go(20.0, 5.0)
        stage.do(Jog(1.0, 0.0, "contract"))
        plan = made_up_pass(stage)
        stage.do(Pursue(plan, "contract", PursuitOptions(at_end="stay")))
        stage.step(plan.legs[0].start_s + 30.0 - stage.clock.utc().timestamp())
        assert stage.state.activity is Activity.FOLLOWING
        stage.station.stop("you")
        stage.step(8.0)
        assert stage.state.last_stop.confirmed
        told = gaps(stage.twin)
        assert len(told) > 40
        assert min(told) > 0.98, "as it reaches the server: latency varies"


def test_a_step_does_not_wait_for_the_next_look():
    with stage_at() as stage:
        stage.ready()
        stage.step(3.0)
        for _ in range(4):
            began = stage.clock.monotonic()
            step = stage.station.submit(Jog(1.0, 0.0, "you"))
            stage.step(0.2)
            assert any(at >= began and line.startswith("P ") for at, line in stage.twin.lines())
            stage.until(step.done, 10.0, "it arrived")


@pytest.mark.parametrize(("stop", "means"), [("reply", "command"), ("mute", "retarget"), ("error", "retarget"),
                                             ("ignore", "retarget")])  # fmt: skip
def test_stop_ends_the_motion_on_every_kind_of_server(stop, means):
    with stage_at(f"{AT}&stop={stop}") as stage:
        stage.ready()
        stage.station.submit(Goto(200.0, 45.0, "you"))
        stage.step(4.0)
        began = stage.clock.monotonic()
        stage.station.stop("you")
        stage.step(0.1)
        stage.until(lambda: not stage.truth.moving, 4.0, "it rests")
        assert stage.clock.monotonic() - began < (2.0 if stop in ("reply", "mute") else 4.0)
        stage.until(lambda: stage.state.last_stop.confirmed is not None, 15.0, "STOP is confirmed")
        assert (stage.state.last_stop.means, stage.state.last_stop.confirmed) == (means, True)
        assert "S" in stage.twin.said()
        assert stage.truth.az_deg < 150.0


def test_a_server_that_was_found_to_know_no_stop_is_sent_a_target_at_once():
    with stage_at(f"{AT}&stop=ignore") as stage:
        stage.ready()
        for _ in range(2):
            stage.station.submit(Goto(200.0 if stage.truth.az_deg < 150.0 else 60.0, 45.0, "you"))
            stage.step(4.0)
            stage.station.stop("you")
            stage.step(0.1)
            stage.until(lambda: stage.state.last_stop.confirmed is not None, 15.0, "STOP is confirmed")
            stage.station.submit(Release("you"))
            stage.step(1.0)
        assert stage.twin.said().count("S") == 1


def test_after_a_step_beside_a_stopped_axis_that_one_stays():
    """`P` names both: after STOP the other axis is sent where it stands, not where it was going."""
    with stage_at() as stage:
        stage.ready()
        stage.station.submit(Goto(160.0, 80.0, "you"))
        stage.step(3.0)
        stage.station.stop("you")
        stage.step(8.0)
        stage.station.submit(Release("you"))
        stage.step(2.0)
        before = stage.truth
        stage.do(Jog(-2.0, 0.0, "you"))
        assert stage.truth.az_deg == pytest.approx(before.az_deg - 2.0, abs=0.05)
        assert stage.truth.el_deg == pytest.approx(before.el_deg, abs=0.02)


def test_an_axis_that_stays_is_sent_the_angle_that_the_server_told():
    """Not a whole turn from it: without a range from `\\dump_state`, 270 may be a way round from -90."""
    with stage_at("seed=1&az=-90&el=30&dump_state=error&min_az=-180&max_az=180") as stage:
        stage.ready()
        stage.do(Jog(0.0, 2.0, "you"))
        assert [line for line in stage.twin.said() if line.startswith("P ")] == ["P -90.00 32.00"]


def test_a_target_of_the_raw_console_is_not_taken_back_by_the_next_step():
    with stage_at() as stage:
        stage.ready()
        stage.go(20.0, 5.0)
        stage.twin.device.receive(b"P 60.00 70.00\n")  # as somebody else's, or a line of F5
        stage.until(lambda: stage.truth.moving, 2.0, "it moves")
        stage.until(lambda: not stage.truth.moving, 60.0, "it rests there")
        stage.step(6.0)
        assert stage.state.fault is not None, "it moved unasked"
        stage.do(AcknowledgeFault("you"))
        if stage.state.held is not None:
            stage.do(Release("you"))
        stage.step(2.0)
        stage.do(Jog(3.0, 0.0, "you"))
        assert stage.truth.el_deg == pytest.approx(70.0, abs=0.05)


def test_a_reply_that_is_late_is_told_from_the_next():
    """Its commands are answered in order: a slow server makes no position of an earlier question."""
    with stage_at(f"{AT}&latency_min=0.6&latency_max=0.9") as stage:
        stage.ready()
        target = stage.go(40.0, 10.0)
        assert stage.stands_at(*target)
        assert stage.shows_truth()
        assert stage.state.link.state is LinkPhase.UP
        plan = made_up_pass(stage)
        stage.do(Pursue(plan, "contract", PursuitOptions(at_end="stay")))
        stage.step(plan.legs[0].start_s + 40.0 - stage.clock.utc().timestamp())
        assert stage.state.activity is Activity.FOLLOWING
        stage.station.stop("you")
        stage.step(10.0)
        assert stage.shows_truth()


def test_how_long_a_server_takes_is_learnt_from_replies_that_came_too_late():
    with stage_at() as stage:
        stage.ready()
        plan = made_up_pass(stage)
        stage.do(Pursue(plan, "contract", PursuitOptions(at_end="stay")))
        stage.step(plan.legs[0].start_s + 10.0 - stage.clock.utc().timestamp())
        to_host = stage.twin.device.wire.to_host
        to_host.delay_min_s = to_host.delay_max_s = 1.2
        stage.step(6.0)
        late, asked = stage.state.link.late, stage.state.link.asked
        assert late > 0
        stage.step(12.0)
        assert stage.state.link.late == late, "it is waited for"
        assert stage.state.link.asked > asked + 5
        assert (stage.state.link.state, stage.state.activity) == (LinkPhase.UP, Activity.FOLLOWING)
