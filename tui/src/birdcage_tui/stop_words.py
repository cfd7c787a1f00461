"""What STOP can do at this moment, and what to do where it can't: exact in every state, or hedged.

Each sentence has a form of at most 36 columns. Pure functions of a view; `tests/tui/test_stop_truth.py` presses STOP in
each state and holds the line against the dish.
"""

from __future__ import annotations

from birdcage.station.known import SearchSwitch
from birdcage.station.state import Activity, Link, Motion, Search, StopReport

from birdcage_tui.view import View

SHORT = 36
"""Columns that every sentence has a form for: the narrowest pane, at 40x12 and at 80x24."""


def power_switch(view: View) -> str:
    """Return what to switch off where no STOP helps, as the dish calls its supply."""
    return "power switch" if view.state.dish is None else view.state.dish.power_switch


def searching(view: View) -> bool:
    """Return whether a TV search runs that can be ended at once."""
    dish = view.state.dish
    at_once = dish is not None and dish.search_switch is SearchSwitch.UNTIL_POWER_UP
    return at_once and view.link_up and view.state.search is Search.RUNNING


def is_stopping(view: View) -> bool:
    """Return whether STOP was called, and the dish was not seen at rest since."""
    return view.state.motion is None and view.state.activity is Activity.STOPPING


def stop_text(view: View, room: int = SHORT) -> str:
    """Return what STOP can do to the present motion: whole sentences where there is room for them."""
    return next((words for words in _sentences(view) if len(words) <= max(room, SHORT)), "")


def _sentences(view: View) -> tuple[str, ...]:
    """Return the same thing in one form or more, the longest first; the last is a line of `SHORT` columns."""
    state = view.state
    if view.waiting:
        return ("No STOP before the port is open",)
    if view.crash or state.link.state is Link.LOST:
        return _and_else(
            view, "STOP can't reach the dish. Switch off its {supply}.", "STOP can't reach it. Cut its {supply}."
        )
    if not view.link_up:
        return _unsure(view, "STOP may not reach the dish.")
    if is_stopping(view):
        return _stopping(view, state.last_stop)
    if state.motion is not None:
        return _in_motion(view, state.motion)
    return _without_plan(view)


def _and_else(view: View, *forms: str) -> tuple[str, ...]:
    """Return sentences with the dish's own supply and switch in their places."""
    switch = power_switch(view)
    supply = switch.removesuffix(" switch")
    emergency = f"In an emergency, switch off its {supply}"
    return tuple(form.format(emergency=emergency, supply=supply, switch=switch) for form in forms)


def _unsure(view: View, sentence: str) -> tuple[str, ...]:
    """Return that STOP may do nothing, and what then does."""
    return _and_else(view, f"{sentence} If it moves, switch off its {{supply}}.", "STOP may fail: use the {switch}")


def _in_motion(view: View, motion: Motion) -> tuple[str, ...]:
    if motion.stop_means == "end of move":
        rests = motion.eta if motion.rests_at is None else motion.rests_at
        return (f"STOP at end of move, {max(0.0, rests - view.now):.0f} s",)
    if motion.stop_means == "none" or motion.stop_power_s is None:
        ends = f"No STOP: it ends by itself in {max(0.0, motion.eta - view.now):.0f} s"
        return _and_else(view, f"{ends}. {{emergency}}.", ends)
    if not motion.eta_known:
        return ("STOP stops it; how fast is unknown",)
    tail = ", by motor release" if motion.stop_means == "release" else ""
    return (f"STOP takes {motion.stop_power_s:.1f} s{tail}",)


def _without_plan(view: View) -> tuple[str, ...]:
    """Return what STOP does to a dish that rests, or whose motion this program has not planned."""
    state = view.state
    activity = state.activity
    if state.dish is not None and not state.dish.tells_at_rest:
        if state.held is not None and activity is Activity.IDLE:
            return ("STOP is latched: no motion is sent",)
        return _and_else(view, "No STOP is known for this dish. {emergency}.", "No STOP but the {switch}")
    if activity is Activity.HOMING:
        return _and_else(view, "Homing has no STOP. {emergency}.", "Homing: no STOP but the {switch}")
    if activity is Activity.INITIALIZING:
        return _and_else(view, "There is no STOP at start-up. {emergency}.", "No STOP but the {switch}")
    if activity is Activity.UNKNOWN:
        return ("Motion unknown: STOP looks and acts",)
    if activity is Activity.MOVING_UNASKED and searching(view):
        return ("STOP ends the TV search",)
    if activity in (Activity.STOWING, Activity.MOVING_UNASKED):
        return _unsure(view, "STOP may not hold the dish.")
    if activity in (Activity.SLEWING, Activity.FOLLOWING):
        queues = state.dish is not None and state.dish.moves_in_turn
        return ("STOP at end of move" if queues else "STOP brings it to rest",)
    if state.held is not None:
        return ("STOP is latched: no motion is sent",)
    return ("STOP holds it where it is",)


def _stopping(view: View, stopped: StopReport | None) -> tuple[str, ...]:
    """Return what is awaited after a STOP; never that the dish is held before it is."""
    if stopped is None:
        return ("STOP called: not yet at rest",)
    if stopped.confirmed is False:
        return _and_else(view, "STOP is not confirmed. If the dish moves, switch off its {supply}.",
                         "STOP not confirmed: use {switch}")  # fmt: skip
    if stopped.means == "none":
        return _and_else(view, "No STOP for this motion. {emergency}.", "No STOP but the {switch}")
    if stopped.means == "no link":
        return _and_else(view, "STOP did not reach the dish. If it moves, switch off its {supply}.",
                         "STOP did not arrive. Cut its {supply}.")  # fmt: skip
    return ({
        "end of move": "STOP waits for the end of this move",
        "look": "STOP looks where the dish goes",
        "nothing moved": "STOP checks that it is at rest",
        "release": "Motors released: position unknown",
    }.get(stopped.means, "STOP sent: not yet at rest"),)  # fmt: skip


def awaited_words(stopped: StopReport) -> str:
    """Return what a STOP that is not confirmed yet has done, in a few words for the HELD row."""
    return {
        "end of move": "no STOP for this move: it ends by itself",
        "none": "no STOP for this motion: it goes on",
        "look": "STOP looks where it goes",
        "nothing moved": "STOP checks that it is at rest",
        "no link": "STOP DID NOT REACH IT",
        "release": "motors released",
    }.get(stopped.means, "STOP sent")


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
