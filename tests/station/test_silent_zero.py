"""A machine that was told where it points, and then was silent: whether it had power all the time."""

from __future__ import annotations

from dataclasses import replace

import pytest
from birdcage.base.errors import PositionUnknown
from birdcage.station.requests import AcknowledgeFault, Goto, Release, Sync, Watch
from birdcage.station.state import LinkPhase

from .test_sync import desk, stage, twins

__all__ = ["desk", "stage", "twins"]


def fall_silent(stage):
    """With the position watched: a dish that is asked nothing has no answer to lose."""
    stage.station.submit(Watch("you", frozenset({"position"}), 2.0))
    stage.step(1.0)
    stage.twin.mute()
    stage.until(lambda: stage.state.link.state is LinkPhase.SILENT, 30.0, "it was silent")


def lose_power(stage, pushed_deg=0.0):
    """Without a word: a server keeps the port open, say."""
    stage.twin.zero_az_deg = stage.twin.points_az_deg + pushed_deg
    stage.twin.motors[0] = type(stage.twin.motors[0])(stage.clock, 0.0, 12.0)


def answer_again(stage):
    stage.twin.unmute()
    stage.until(lambda: stage.state.link.state is LinkPhase.UP, 10.0, "it answers")
    stage.step(2.0)


def told_at(stage, az_deg):
    stage.do(Sync(200.0, 30.0, "you"))
    stage.do(Goto(az_deg, 30.0, "you"))
    stage.step(3.0)


def test_one_that_was_silent_and_stands_where_it_stood_is_believed(stage):
    told_at(stage, 290.0)
    fall_silent(stage)
    stage.step(600.0)
    assert stage.state.position_lost is not None
    answer_again(stage)
    assert (stage.state.position.az_deg, stage.state.position_lost) == (pytest.approx(290.0), None)
    assert stage.state.fault is None
    stage.do(Release("you"))
    stage.do(Goto(300.0, 30.0, "you"))
    assert stage.twin.points_az_deg == pytest.approx(300.0)


@pytest.mark.parametrize(("stood_deg", "pushed_deg", "silent_s"), [(290.0, 40.0, 0.0), (200.0, 40.0, 600.0)])
def test_one_that_lost_its_power_in_a_silence_has_to_be_told_anew(stage, stood_deg, pushed_deg, silent_s):
    told_at(stage, stood_deg)
    fall_silent(stage)
    lose_power(stage, pushed_deg)
    stage.step(silent_s)
    answer_again(stage)
    state, sent = stage.state, len(stage.twin.sent_to)
    assert (state.position, state.homed, state.position_lost) == (None, False, "unsynced")
    assert state.fault.what == "The dish no longer knows where it points"
    assert "its power dipped, or it restarted silently" in state.fault.meaning
    assert "sync it" in state.fault.remedy
    stage.do(AcknowledgeFault("you"))
    stage.do(Release("you"))
    assert "`birdcage sync AZ EL`" in str(stage.refused(Goto(250.0, 30.0, "you"), PositionUnknown))
    stage.step(10.0)
    assert len(stage.twin.sent_to) == sent, "nothing moves by itself"
    stage.do(Sync(100.0, 30.0, "you"))
    assert stage.state.position.az_deg == pytest.approx(100.0)


@pytest.mark.parametrize("keeps_power", [True, False])
def test_one_that_was_silent_in_mid_move_is_believed_on_its_way_and_nowhere_else(stage, keeps_power):
    stage.do(Sync(200.0, 30.0, "you"))
    stage.station.submit(Watch("you", frozenset({"position"}), 2.0))
    moved = stage.station.submit(Goto(340.0, 30.0, "you"))
    stage.step(3.0)
    fall_silent(stage)
    assert moved.exception(0).reason == "link"
    if not keeps_power:
        lose_power(stage)
    answer_again(stage)
    stage.step(10.0)
    sent = len(stage.twin.sent_to)
    stage.step(30.0)
    assert (stage.state.held.reason, len(stage.twin.sent_to)) == ("link", sent)
    if keeps_power:
        assert (stage.state.position.az_deg, stage.state.fault) == (pytest.approx(340.0), None)
    else:
        assert (stage.state.position, stage.state.position_lost, stage.state.homed) == (None, "unsynced", False)
        assert stage.state.fault.what == "The dish no longer knows where it points"


@pytest.mark.parametrize(("damaged", "is_known"), [(2, True), (3, False)])
def test_one_damaged_answer_after_a_silence_is_no_proof_of_the_contrary(stage, monkeypatch, damaged, is_known):
    """The first one is lost on seeing that it answers."""
    told_at(stage, 290.0)
    fall_silent(stage)
    rotator, wrong = type(stage.station._antenna.rotator._rotator), [True] * damaged
    look = rotator.look

    def damage(self, **how):
        seen = look(self, **how)
        return replace(seen, angles={**seen.angles, "pan": 9.0}) if wrong and wrong.pop() else seen

    monkeypatch.setattr(rotator, "look", damage)
    answer_again(stage)
    assert (wrong, stage.state.position is not None) == ([], is_known)


@pytest.mark.parametrize("stops", [False, True])
def test_a_stop_into_the_silence_that_aims_it_may_have_brought_it_onto_its_way(stage, stops):
    stage.do(Sync(200.0, 30.0, "you"))
    stage.station.submit(Goto(340.0, 30.0, "you"))
    stage.step(3.0)
    fall_silent(stage)
    if stops:
        stage.station.stop("you")
    stage.twin.motors[0] = type(stage.twin.motors[0])(stage.clock, 100.0, 12.0)
    answer_again(stage)
    assert (stage.state.position is None) is stops


def test_what_a_silence_has_made_unknown_is_not_believed_by_a_later_program(desk):
    with desk.meet(turn_deg=0.0) as stage:
        stage.do(Sync(200.0, 30.0, "you"))
        stage.step(1.0)
        fall_silent(stage)
        answer_again(stage)
        assert stage.state.position is None
    with desk.meet(turn_deg=0.0) as later:
        assert later.state.position is None
