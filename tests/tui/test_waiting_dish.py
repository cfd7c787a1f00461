"""What the app says of a dish that waits for its motors, and of a move that was not taken."""

from __future__ import annotations

from dataclasses import replace
from datetime import UTC, datetime

from birdcage.base.reason import Reason
from birdcage.signal.tuner import TUNER_FACTS
from birdcage.station.events import End, MoveEnded
from birdcage_tui.commands.signal import can_find
from birdcage_tui.shown.state_words import ended_text, motion_text

from .test_travler import view_of


def test_a_dish_that_does_not_answer_a_motor_command_is_busy_with_the_last_move():
    view = view_of("slewing")
    busy = replace(view, state=replace(view.state, activity_text="busy with the last move"))
    assert motion_text(busy) == "SLEWING: busy with the last move"
    assert motion_text(view).startswith("SLEWING ")


def test_a_move_that_was_not_taken_is_told_with_where_the_dish_stands():
    position = view_of("idle").state.position
    told = ended_text(MoveEnded(0.0, datetime.now(UTC), End.NOT_TAKEN, "not taken", position))
    assert told == f"The dish ignored the move and stands still at {position.az_deg:.2f}°/{position.el_deg:.2f}°."


def test_a_dish_that_tells_where_it_is_only_once_it_has_moved_is_sent_somewhere_before_a_search():
    view = view_of("idle")
    untold = replace(view, heard=replace(TUNER_FACTS, of_dish=False),
                     state=replace(view.state, position=None, position_lost=Reason.UNTOLD))  # fmt: skip
    assert can_find(untold) == "This dish does not tell where it points. Send it somewhere first (g)."
    lost = replace(untold, state=replace(untold.state, position_lost=Reason.UNHOMED))
    assert can_find(lost) == "The dish does not know where it points. Home it first."
