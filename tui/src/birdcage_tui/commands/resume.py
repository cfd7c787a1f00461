"""The command that goes on with what was interrupted."""

from __future__ import annotations

from dataclasses import replace

from birdcage_tui.commands.table import Command, can_move
from birdcage_tui.view import YOU, View

KEY = "U"


def can_resume(view: View) -> str | None:
    """Return why nothing can be resumed. HELD is no reason: resuming releases it, and says so."""
    if view.track is None or (view.track.resumable is None and view.track.unfinished is None):
        return "No interrupted pass."
    holder, pursuit = view.state.holder, view.state.pursuit
    if holder not in (None, YOU) and (pursuit is None or holder != pursuit.holder):
        return f"{holder} has control."
    if view.state.held is not None and view.state.last_stop is not None and view.state.last_stop.confirmed is not True:
        return "STOP is not confirmed: Enter releases it."
    return can_move(replace(view, state=replace(view.state, held=None)))


RESUME = (
    Command(
        "resume",
        (KEY,),
        KEY,
        "Resume",
        "Follow again what STOP, a step by hand or the end of the program has interrupted, with autotrack if that was "
        "on. It releases HELD, and row 2 says where the dish goes.",
        "Motion",
        can_resume,
    ),
)
