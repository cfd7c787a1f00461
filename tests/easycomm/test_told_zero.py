"""An RP2040 that was silent, or lost its power unheard: whether what it was told of its azimuth still holds."""

from __future__ import annotations

import pytest
from birdcage.sim.wire import Byte
from birdcage.station.events import LinkChanged
from birdcage.station.requests import Goto, Watch
from birdcage.station.state import LinkPhase

from .test_rotator import RP2040, met, sets


def fall_silent(stage, seconds, *, answers=b""):
    """No byte gets through, or only `answers` in place of each one that comes back; nothing says when power is back."""
    wire = stage.twin.device.wire
    for lane in (wire.to_host,) if answers else wire.lanes:
        lane.silent, lane.plan = not answers, (lambda _byte: Byte(drop=True, noise=answers)) if answers else None
    stage.step(seconds)
    for lane in wire.lanes:
        lane.silent, lane.plan = False, None


def stand_at(stage, turn_deg):
    """Stand so far from where it counts 0, and be seen there."""
    here = stage.state.position
    if turn_deg != here.cable_deg:
        stage.do(Goto(here.az_deg + turn_deg - here.cable_deg, 30.0, "you"))
    stage.step(5.0)


def restart_unheard(stage, seconds):
    """Let it start anew while for so long no byte gets through."""
    for lane in stage.twin.device.wire.lanes:
        lane.silent = True
    stage.twin.device.reboot()
    stage.step(seconds)
    for lane in stage.twin.device.wire.lanes:
        lane.silent = False


@pytest.mark.parametrize("moves", [False, True])
def test_power_that_goes_and_comes_back_in_a_silence_makes_the_azimuth_unknown(moves):
    """In mid-move, too, where its way leads across the 0 that it counts after a start."""
    with met(f"{RP2040}&el_homes=0") as stage:
        stage.do(Goto(40.0, 40.0, "you"))
        stage.step(3.0)
        if moves:
            stage.station.submit(Goto(300.0, 40.0, "you"))
            stage.step(1.5)
        restart_unheard(stage, 8.0)
        stage.step(10.0)
        state, sent = stage.state, len(sets(stage))
        assert (state.link.state, state.position, state.position_lost) == (LinkPhase.UP, None, "unsynced")
        assert state.fault.what == "The dish no longer knows where it points"
        assert "its power dipped, or it restarted silently" in state.fault.meaning
        assert "sync it" in state.fault.remedy
        stage.step(60.0)
        assert len(sets(stage)) == sent, "nothing moves by itself"
        assert not stage.truth.moving


def test_power_that_goes_and_comes_back_between_two_questions_makes_the_azimuth_unknown():
    """Then no silence is seen: it rested, was sent nowhere, and counts 0."""
    with met(f"{RP2040}&el_homes=0") as stage:
        stage.do(Goto(140.0, 40.0, "you"))
        stage.station.submit(Watch("contract", frozenset({"position"}), 0.2))
        stage.step(10.0)
        read_at = stage.state.position.at
        stage.until(lambda: stage.state.position.at > read_at, 6.0, "it was asked")
        restart_unheard(stage, 2.0)
        stage.step(5.0)
        assert [event for event in stage.events if isinstance(event, LinkChanged) and event.link.reason] == []
        assert (stage.state.link.state, stage.state.position_lost) == (LinkPhase.UP, "unsynced")
        assert (stage.state.position, stage.state.held.reason) == (None, "fault")
        assert stage.state.fault.what == "The dish no longer knows where it points"


def test_a_set_whose_answer_is_lost_is_a_way_that_it_may_have_gone():
    with met(RP2040) as stage:
        stand_at(stage, 50.0)
        stage.station.submit(Goto(stage.state.position.az_deg + 60.0, 30.0, "you"))
        stage.twin.device.wire.to_host.silent = True
        stage.step(15.0)
        assert stage.state.link.state is LinkPhase.SILENT
        stage.twin.device.wire.to_host.silent = False
        stage.step(8.0)
        assert stage.state.position.az_deg == pytest.approx(stage.truth.az_deg % 360.0, abs=0.15)
        assert stage.state.position.cable_deg == pytest.approx(110.0, abs=0.15)


@pytest.mark.parametrize(("stands_deg", "seconds", "answers", "is_known"), [
    (50.0, 600.0, b"", True), (0.0, 12.0, b"", True), (0.0, 60.0, b"", False), (0.0, 60.0, b"\x81", True),
])  # fmt: skip
def test_an_rp2040_that_stands_where_it_counts_0_is_doubted_after_a_silence_of_more_than_a_start(
    stands_deg, seconds, answers, is_known
):
    """There it would stand after a start, too, and somebody may have turned it. Who answers noise has power."""
    with met(RP2040) as stage:
        stand_at(stage, stands_deg)
        fall_silent(stage, seconds, answers=answers)
        assert stage.state.link.state is LinkPhase.SILENT
        stage.step(8.0)
        assert stage.state.link.state is LinkPhase.UP
        assert (stage.state.position is not None) is is_known
