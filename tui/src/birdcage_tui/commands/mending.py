"""What keeps the dish from moving, and the key that mends it: said where a motion is offered that can't be sent."""

from __future__ import annotations

from dataclasses import dataclass

from birdcage.station.state import Activity

from birdcage_tui.commands.table import Command
from birdcage_tui.shown.allowed import can_move, can_release, can_step
from birdcage_tui.shown.view import View


@dataclass(frozen=True, slots=True)
class Mend:
    """One way out. Without a key only waiting helps, or a hand at the dish."""

    command: str
    """The command that mends it; empty for none."""
    shown: str
    """Its key."""
    words: str
    """For the footer, after the key: `home first`."""
    sentence: str
    """`H homes the dish first`, `The dish does not answer`; without a full stop."""


def release_mend(view: View) -> Mend | None:
    """Return what Enter does before anything else; None while there is nothing to release."""
    if can_release(view) is not None:
        return None
    if view.state.fault is not None:
        return Mend("release", "Enter", "acknowledge", "Enter acknowledges the fault")
    if view.state.held is not None:
        return Mend("release", "Enter", "release", "Enter releases the dish")
    return Mend("release", "Enter", "own limits", "Enter asks about the dish's own limits")


def motion_mend(view: View) -> Mend | None:
    """Return what has to be done before the dish can be moved; None when it can be."""
    state = view.state
    reason = can_step(view)
    if reason is None:
        return None
    if state.awaits_first_move and can_move(view) is None:
        return Mend("goto", "g", "go to first", "This dish does not tell where it points: send it somewhere first (g)")
    if view.waiting or not view.link_up:
        waiting = "opening" if view.waiting else "no answer"
        return Mend("", "", waiting, "The port is not open yet" if view.waiting else "The dish does not answer")
    first = release_mend(view)
    if first is not None:
        return first
    if state.activity is Activity.HOMING:
        return Mend("", "", "homing", "The dish is homing")
    if state.dish is not None and state.dish.no_direction:
        return Mend("", "", "no direction", state.dish.no_direction)
    if state.homed is None and not state.position_lost:
        return Mend("", "", "no position yet", "No position has been read yet")
    if state.awaits_sync:
        return Mend("sync", "Y", "sync first", "Y syncs the dish first")
    if state.dish is not None and state.dish.never_homes:
        return Mend("", "", "no position yet", "No position has been read yet")
    if state.dish is not None and state.dish.homing_s is None:
        return Mend("", "", "not homed", "Switch the dish off and on, and it homes by itself")
    return Mend("home", "H", "home first", "H homes the dish first")


def held_up(command: Command, view: View) -> str | None:
    """Return why a command would come to nothing now; None if it would not.

    The go-to line opens in any case, so that what is typed blindly is no key, and says why nothing is sent.
    """
    return can_move(view) if command.name == "goto" else command.refused(view)


def offered(command: Command, view: View) -> Mend | None:
    """Return what comes before what a command offers; None if nothing does.

    Enter releases what is held before anything else; a motion that can't be sent gives way to what mends that.
    """
    mend = release_mend(view) if "enter" in command.keys and not view.typing else None
    if mend is not None and command.name == "setup-do" and view.state.fault is None and view.state.held is None:
        mend = None  # there it asks about the limits only once
    if mend is None:
        reason = held_up(command, view)
        mend = motion_mend(view) if reason is not None and reason == can_step(view) else None
    if mend is not None and not mend.command and command.name in ("home", "goto"):
        return None  # dim in their places: one mends, where anything does, and one is known by its word
    return mend


def then_words(view: View, does: str, at_once: str = "") -> str:
    """Return what a key does, as a sentence: after what has to be done first; `at_once`: where nothing has to."""
    mend = motion_mend(view)
    if mend is None:
        return f"{at_once or does}."
    return f"{mend.sentence}, then {does}." if mend.command else f"{mend.sentence}."
