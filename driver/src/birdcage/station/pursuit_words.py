"""Why a pursuit is in its phase: sentences for a person."""

from __future__ import annotations

from birdcage.base.held import HeldReason
from birdcage.station.interruption import SENTENCES
from birdcage.station.pursuit_state import Phase, Pursuit, PursuitOptions
from birdcage.station.state import Fault, HeldState

REPLACED = "Another pursuit replaced it."
DONE = "The pass is over."
UNREAD = "The dish does not tell where it rests. birdcage assumes it is where it was sent."


def ended_by(by: str) -> str:
    """It was ended by somebody."""
    return f"Ended by {by}."


def by_hand(holder: str) -> str:
    """Whose pursuit it is has moved the dish."""
    return "You moved the dish by hand." if holder == "you" else f"{holder} moved the dish."


def yielded(holder: str | None) -> str:
    """Somebody else has the lease."""
    return "You have control." if holder == "you" else f"{holder} has control."


def held(held: HeldState, fault: Fault | None) -> str:
    """STOP, or something that went wrong."""
    if held.reason is HeldReason.STOP:
        return f"STOP by {held.by}."
    return f"{fault.what}." if fault is not None else f"The dish was stopped: {held.why}."


def interrupted(reason: HeldReason, options: PursuitOptions) -> str:
    """What broke in, and what would make it go on."""
    if reason is HeldReason.LINK and options.resume:
        return (
            f"{SENTENCES[reason]} It resumes by itself if the link is back within {options.resume_within_s:g} s "
            "and the dish has not changed. Otherwise release it."
        )
    return f"{SENTENCES.get(reason, SENTENCES[HeldReason.CLOCK])} Release it to resume while the pass lasts."


def as_steered(why: str, phase: Phase, controller: str) -> str:
    """Say with it, while following, that the position is not read."""
    return f"{why} {UNREAD}" if phase is Phase.FOLLOWING and controller == "modelled" else why


def too_late(live: Pursuit) -> str:
    """It could not go on in time."""
    if live.phase is Phase.YIELDED:
        return f"{live.why} The pass is over."
    return "The pass ended before it could resume."
