"""Why there is no needle, in a word or two."""

from __future__ import annotations

from birdcage.station.state import Activity, LinkPhase

from birdcage_tui.shown.state_words import home_hint
from birdcage_tui.shown.view import View

_LOST = {
    "released": "MOTORS RELEASED",
    "unhomed": "NOT HOMED",
    "unreadable": "UNREADABLE",
    "stowing": "STOWING",
    "raw": "AFTER A RAW LINE",
    "raw command": "AFTER A RAW LINE",
}


def why_unknown(view: View) -> tuple[str, ...]:
    """Return a word for why the position is not known, and what would make it known."""
    state = view.state
    if view.waiting:
        return "NOT READ YET", "opening the port"
    if state.link.state is LinkPhase.LOST:
        return "LINK LOST", "plug the cable in"
    if state.link.state is LinkPhase.SILENT:
        return "SILENT", "the dish is silent"
    if state.activity is Activity.HOMING:
        return "HOMING", "keep its swing clear"
    if state.dish is not None and state.dish.no_direction:
        return "NO DIRECTION", "no azimuth and elevation"
    if state.awaits_first_move:
        moves = state.motion is not None or state.activity is Activity.UNKNOWN
        return "NOT TOLD", "on its way" if moves else "send it somewhere first"
    if state.homed is False:
        return "NOT HOMED", *home_hint(view).split(": ")
    if state.position_lost in _LOST:
        return _LOST[state.position_lost], *home_hint(view).split(": ")
    return "UNKNOWN", "not read yet"
