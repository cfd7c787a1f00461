"""What a command is, and why one cannot be given now."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from birdcage.station.state import Activity

from birdcage_tui.view import View

Reason = Callable[[View], str | None]
"""Why a command cannot be given now, as a sentence; None when it can."""


def always(_: View) -> str | None:
    """Nothing is ever in the way."""
    return None


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


@dataclass(frozen=True, slots=True)
class Command:
    """One thing a person can do. `keys` are Textual's names; `shown` is how the key is written."""

    name: str
    keys: tuple[str, ...]
    shown: str
    title: str
    help: str
    group: str
    refused: Reason = always
    footer: str = ""
    """The word in the footer; not there when empty."""
    where: tuple[str, ...] = ()
    """The scopes (pages, or widgets with a `scope`) that it belongs to and that do it; empty: everywhere."""
    priority: bool = False
    """Whether its key is taken before the widget that has the focus sees it."""
    page: str = ""
    """The page on which its scope is, where that is a widget's."""
    footer_still: str = ""
    """The word instead while the dish can't be moved; empty: the same."""
