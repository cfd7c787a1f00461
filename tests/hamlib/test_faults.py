"""Bad days of a server and its rotator: at rest, in motion and in a pass. TCP spoils no byte, so no fault here does."""

from __future__ import annotations

from dataclasses import dataclass, replace

import pytest
from birdcage.base.errors import BirdcageError
from birdcage.station.pursuit_state import PursuitOptions
from birdcage.station.requests import AcknowledgeFault, Goto, Pursue, Release
from birdcage.station.state import MOVING, Activity, LinkPhase
from birdcage.testing import MachineBench, Stage
from birdcage.testing.passing import made_up_pass
from rotctl_twin import server

NOTICED_S = 20.0


@dataclass(frozen=True)
class ServerFault:
    """What is done to a device, how it is mended, and the state of the link that is shown; None for up."""

    inflict: object
    heal: object
    shows: LinkPhase | None = None


def lost(device, is_lost):
    device.shell._answerer._settings = replace(device.settings, lost=is_lost)


def late(device, seconds):
    device.wire.to_host.delay_min_s = device.wire.to_host.delay_max_s = seconds


def silent(device, is_silent):
    device.wire.to_host.silent = device.wire.to_dish.silent = is_silent


FAULTS = {
    "the server ends": ServerFault(lambda dev: dev.unplug(), lambda dev: dev.plug(), LinkPhase.LOST),
    "the server hangs": ServerFault(lambda dev: silent(dev, True), lambda dev: silent(dev, False), LinkPhase.SILENT),
    "the server has lost its rotator": ServerFault(
        lambda dev: lost(dev, True), lambda dev: lost(dev, False), LinkPhase.SILENT
    ),
    "replies come 3 s late": ServerFault(lambda dev: late(dev, 3.0), lambda dev: late(dev, 0.0), LinkPhase.SILENT),
    "replies come 1.2 s late": ServerFault(lambda dev: late(dev, 1.2), lambda dev: late(dev, 0.0)),
    "replies come byte by byte": ServerFault(
        lambda dev: setattr(dev.wire.to_host, "pace_baud", 1200), lambda dev: setattr(dev.wire.to_host, "pace_baud", 0)
    ),
}


def at_rest(stage):
    return None


def moving(stage):
    move = stage.station.submit(Goto(*stage.target(80.0, 20.0), "you"))
    stage.step(2.0)
    assert stage.truth.moving
    return move


def passing(stage):
    plan = made_up_pass(stage)
    stage.do(Pursue(plan, "you", PursuitOptions(at_end="stay")))
    stage.step(plan.legs[0].start_s + 10.0 - stage.clock.utc().timestamp())
    assert stage.state.activity is Activity.FOLLOWING


@pytest.fixture
def stage():
    with Stage(MachineBench("rotctl", server("seed=1&az=100&el=30"), stops=())) as stage:
        yield stage.ready()


@pytest.mark.parametrize("moment", [at_rest, moving, passing], ids=lambda moment: moment.__name__)
@pytest.mark.parametrize("name", FAULTS)
def test_what_is_shown_claimed_and_done(stage, name, moment):
    fault, move = FAULTS[name], moment(stage)
    fault.inflict(stage.twin.device)
    if fault.shows is None:
        stage.step(8.0)
        assert stage.state.link.state is LinkPhase.UP
        assert stage.state.position_lost is None
        if move is not None:
            stage.until(move.done, 60.0, "it arrives")
            move.result(0)
        fault.heal(stage.twin.device)
        return
    stage.until(lambda: stage.state.link.state is fault.shows, NOTICED_S, f"{name} was noticed")
    assert stage.state.position_lost is not None
    assert stage.state.activity not in MOVING
    if move is not None:
        assert isinstance(move.exception(0), BirdcageError)
    if moment is passing:
        assert stage.state.held is not None
    stage.until(lambda: not stage.truth.moving, 60.0, "the rotator ends its way by itself")
    stands, since = stage.truth, stage.clock.monotonic()
    stage.step(5.0)
    fault.heal(stage.twin.device)
    stage.until(
        lambda: stage.state.link.state is LinkPhase.UP and stage.state.position_lost is None, 40.0, "it is back"
    )
    stage.step(5.0)
    assert stage.truth == stands, "it stays where it is"
    assert not stage.taken_since(since)
    assert stage.shows_truth()
    if stage.state.held is not None:
        stage.do(Release("you"))
    if moment is passing:
        stage.until(lambda: stage.state.activity is Activity.FOLLOWING, 90.0, "the pass goes on once it is released")
    else:
        target = stage.go(-20.0, 5.0)
        assert stage.stands_at(*target)


@pytest.mark.parametrize("name", [name for name, fault in FAULTS.items() if fault.shows is not LinkPhase.LOST])
def test_stop_goes_out_at_once_all_the_same(stage, name):
    moving(stage)
    FAULTS[name].inflict(stage.twin.device)
    stage.step(0.3)
    stage.station.stop("you")
    stage.step(3.5)
    if name != "the server hangs":
        assert not stage.truth.moving
        assert "S" in stage.twin.said()
    stage.step(20.0)
    stop = stage.state.last_stop
    assert stage.state.held is not None
    if FAULTS[name].shows is not None:
        assert stop.confirmed is not True, "nothing tells that it rests"
    else:
        assert stop.confirmed is True


@pytest.mark.parametrize("axis", [0, 1])
def test_a_blocked_axis_is_a_fault(stage, axis):
    move = moving(stage)
    stage.twin.device.stall(axis)
    stage.until(lambda: stage.state.fault is not None, 120.0, "the stall is told")
    assert stage.state.fault.reason == "stall"
    assert isinstance(move.exception(0), BirdcageError)
    stage.twin.device.stall(axis, blocked=False)
    stage.do(AcknowledgeFault("you"))
    stage.step(2.0)
    if stage.state.held is not None:
        stage.do(Release("you"))
    target = stage.go(10.0, 5.0)
    assert stage.stands_at(*target)


def test_another_client_that_moves_it_is_told_as_unasked_motion(stage):
    stage.twin.device.receive(b"P 150.00 60.00\n")
    stage.until(lambda: stage.state.fault is not None, 10.0, "it is told")
    assert stage.state.fault.reason == "moved"
    stage.station.stop("you")
    stage.until(lambda: not stage.truth.moving, 5.0, "STOP ends that, too")
    assert stage.twin.said().count("S") >= 1


def test_a_server_that_comes_back_with_another_range_is_planned_by_that(stage):
    stage.twin.unplug()
    stage.step(5.0)
    device = stage.twin.device
    device.shell._answerer._settings = replace(device.settings, max_az=270.0, max_el=60.0)
    stage.twin.plug()
    stage.until(lambda: stage.state.link.state is LinkPhase.UP and stage.state.surveyed, 30.0, "it is back")
    stage.step(2.0)
    assert (stage.state.cable_max_deg, stage.state.el_max_deg) == (270.0, 60.0)
