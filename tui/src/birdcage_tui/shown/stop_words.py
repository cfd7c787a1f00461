"""What STOP and Esc do at this moment, for the screen: `birdcage.station.stop_words` with what only the app knows.

`tests/tui/test_stop_truth.py` presses STOP in each state and holds the line against the dish.
"""

from __future__ import annotations

from birdcage.station import stop_words
from birdcage.station.known import SearchSwitch
from birdcage.station.state import TvSearch
from birdcage.station.stop_words import SHORT, fitting

from birdcage_tui.shown.view import View


def power_switch(view: View) -> str:
    """Return what to switch off where no STOP helps, as the dish calls its supply."""
    return stop_words.power_switch(view.state.dish)


def searching(view: View) -> bool:
    """Return whether a TV search runs that can be ended at once."""
    dish = view.state.dish
    at_once = dish is not None and dish.search_switch is SearchSwitch.UNTIL_POWER_UP
    return at_once and view.link_up and view.state.search is TvSearch.RUNNING


def stop_text(view: View, room: int = SHORT) -> str:
    """Return what STOP can do to the present motion: whole sentences where there is room for them."""
    if view.crash and not view.waiting:
        return fitting(stop_words.unreachable(view.state.dish), room)
    return stop_words.stop_line(view.state, view.now, room)


def esc_text(view: View, *, closes: str, other: str = "") -> str:
    """Return what Esc does now: `closes` (`closes`, `leaves`, …) only while nothing moves or may move.

    `other` says what else closes the same layer while Esc stops the dish.
    """
    if not view.may_move:
        return f"Esc {closes}"
    return other or "Esc stops the dish"


def stop_keys(view: View) -> str:
    """Return the keys that stop the dish from a layer or a text field."""
    return "Esc or Ctrl+C stops the dish" if view.may_move else "Ctrl+C stops"
