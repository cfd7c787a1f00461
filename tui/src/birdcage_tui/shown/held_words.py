"""The row of a dish that is HELD: by whom, and what moves it once Enter has released it. Exact, or hedged."""

from __future__ import annotations

from datetime import datetime

from birdcage.base.held import HeldReason
from birdcage.base.reason import Reason
from birdcage.station.pursuit_state import Phase, Pursuit
from birdcage.station.state import Activity, HeldState, StopReport, TvSearch
from birdcage.station.stop_words import awaited_words

from birdcage_tui.shown.pursuit import pursuit_of
from birdcage_tui.shown.resume_words import direction_words, resume_words
from birdcage_tui.shown.track_words import plain_name
from birdcage_tui.shown.view import YOU, View


def enter_words(view: View, does: str) -> str:
    """Return what Enter does, after a gap; in a field once Esc has closed that, unless Esc stops the dish."""
    if not view.typing:
        return f"   Enter {does}"
    return "" if view.may_move else f"   Esc, then Enter {does}"


def held_words(view: View) -> str:
    """Return who holds it and why, whose motion was refused, and what Enter and U set in motion."""
    held = view.state.held
    assert held is not None, "asked only while held"
    why = "" if held.reason is HeldReason.STOP else f" ({held.why})"
    words = f"■ HELD by {held.by}{why}{_since(view, held.utc)}"
    if held.damage:
        words = f"■ HELD by unknown{_since(view, held.utc)}"
    words += _ignored(view, held)
    stopped = view.state.last_stop
    if held.reason is HeldReason.STOP and stopped is not None:
        awaited = f"  {awaited_words(view.state, stopped)}"
        words += {True: "", False: "  STOP NOT CONFIRMED", None: awaited}[stopped.confirmed]
    kept = "  NOT KEPT on disk" if view.state.held_trouble else ""
    resume = "" if view.typing else resume_words(view)  # a field takes its letter
    release = enter_words(view, f"release: {after_release(view)}")
    return f"{words}{kept}{release}{f'   {resume}' if resume else ''}"


def after_release(view: View) -> str:
    """Return who moves the dish first once it is released, and where to; that nothing does, only where that is sure."""
    state, held = view.state, view.state.held
    if state.search is TvSearch.RUNNING:
        return "the TV search moves it on"
    if state.activity is Activity.INITIALIZING:
        return "it starts up, and moves by itself"
    if state.position_lost is Reason.RELEASED:
        return "its motors stay off"
    by_time = state.dish is not None and not state.dish.tells_at_rest and state.activity is Activity.IDLE
    unproven = held is not None and held.reason is HeldReason.STOP and _unproven(state.last_stop) and not by_time
    if view.moving or unproven:
        return "it may still be moving"
    if (words := _next_mover(view)) is not None:
        return words
    seen_at_rest = state.activity is Activity.IDLE and state.position is not None and not by_time
    return "nothing moves then" if seen_at_rest else "birdcage sends no motion then"


def _unproven(stopped: StopReport | None) -> bool:
    return stopped is not None and stopped.confirmed is not True


def _next_mover(view: View) -> str | None:
    """Return who has asked for a motion that the release lets go on; None without one."""
    state, held, pursuit = view.state, view.state.held, pursuit_of(view.state)
    if state.motion_refused_because:
        return None
    if _goes_on(pursuit):
        assert pursuit is not None, "what goes on is one"
        known = "" if state.position is not None else ", once its position is known"
        where = direction_words(pursuit.plan, view.utc)
        return f"{pursuit.holder} moves it to {where} for {plain_name(pursuit.plan.aim.name)}{known}"
    if view.track is not None and view.track.autotrack:  # STOP switches it off a moment later
        return "autotrack may move it"
    if held is not None and held.ignored and held.next_holder not in (None, YOU):
        return f"{held.next_holder} may move it{_direction(held, ' to ')}"
    return None


def _goes_on(pursuit: Pursuit | None) -> bool:
    return pursuit is not None and pursuit.phase is Phase.INTERRUPTED


def _ignored(view: View, held: HeldState) -> str:
    """Return whose motion was refused meanwhile. A pursuit that is to go on is announced there, and was not refused."""
    if held.next_holder is None or not held.ignored:
        return ""
    if _goes_on(pursuit_of(view.state)):
        return f"  {held.ignored} motion{'s' if held.ignored > 1 else ''} ignored"
    times = f" x{held.ignored}" if held.ignored > 1 else ""
    return f"  {held.next_holder}{_direction(held, ' ')} ignored{times}"


def _direction(held: HeldState, before: str) -> str:
    if held.next_az_deg is None or held.next_el_deg is None:
        return ""
    return f"{before}{held.next_az_deg:.1f}/{held.next_el_deg:.1f}"


def _since(view: View, utc: datetime | None) -> str:
    """Return when, with the day where that was another one."""
    if utc is None:
        return ""
    return f" {utc:%H:%M:%S}" if utc.date() == view.utc.date() else f" {utc:%d %b %H:%M:%S}"
