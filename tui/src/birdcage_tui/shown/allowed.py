"""What may be done now, by what a frame shows: each gives the reason against it as a sentence, None for yes.

The station checks again, and its word counts.
"""

from __future__ import annotations

from dataclasses import replace

from birdcage.station.state import Activity

from birdcage_tui.shown.view import YOU, View

RESUME_KEY = "U"


def can_move(view: View) -> str | None:
    """Return why the dish cannot be moved now; the station checks again, and its word counts."""
    state = view.state
    if state.fault is not None:
        return "A fault waits. Enter acknowledges it."
    if not view.link_up:
        return "The dish does not answer."
    if state.held is not None:
        return "STOP is latched. Enter releases it."
    if state.motion_refused_because:
        return state.motion_refused_because
    if state.dish is not None and state.dish.no_direction:
        return state.dish.no_direction
    if state.awaits_first_move:
        return None
    if state.homed is False or state.position is None:
        if state.dish is not None and state.dish.never_homes:
            return "No position has been read yet."
        if state.dish is not None and state.dish.homing_s is None:
            return "The dish does not know where it points. Switch it off and on: it homes by itself."
        return "The dish does not know where it points. Home it first."
    return None


def can_step(view: View) -> str | None:
    """Return why the dish cannot be moved from where it is now."""
    reason = can_move(view)
    if reason is None and view.state.awaits_first_move:
        return "This dish does not tell where it points. Send it somewhere first (g)."
    return reason


def can_home(view: View) -> str | None:
    """Return why the dish cannot be homed now."""
    state = view.state
    if state.fault is not None:
        return "A fault waits. Enter acknowledges it."
    if not view.link_up:
        return "The dish does not answer."
    if state.dish is not None and state.dish.no_homing:
        return state.dish.no_homing
    if state.held is not None:
        return "STOP is latched. Enter releases it."
    return "The dish is already homing." if state.activity is Activity.HOMING else None


def can_release(view: View) -> str | None:
    """Return why there is nothing to release, acknowledge or accept."""
    state = view.state
    if state.fault is None and state.held is None and not state.motion_refused_because:
        return "No STOP and no fault to release."
    return None


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
