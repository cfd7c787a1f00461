"""Why a task is in its phase: sentences for a person."""

from __future__ import annotations

from birdcage.base.held import HeldReason
from birdcage.station.interruption import SENTENCES
from birdcage.station.state import Fault, HeldState
from birdcage.station.task import Task

CLOSED = "birdcage has ended."
CUT_SHORT = {
    HeldReason.LINK: "The link is lost. Nothing more is sent, and a move that has begun may still end.",
    HeldReason.FAULT: "The dish no longer knows where it points.",
    HeldReason.CLOCK: "The clock stepped, or the computer slept.",
}
"""What ends a task that does not go on afterwards. The other reasons latch by a person's STOP or a fault."""


def replaced(kind: str, by_kind: str) -> str:
    """Another task of its holder's, or of its kind, was asked for."""
    return f"Another {kind} replaced it." if kind == by_kind else f"The {by_kind} replaced it."


def ended(kind: str) -> str:
    """Return the sentence for the motion of a task that was ended."""
    return f"The {kind} was ended."


def ended_by(by: str) -> str:
    """It was ended by somebody."""
    return f"Ended by {by}."


def by_hand(holder: str) -> str:
    """Whose task it is has moved the dish."""
    return "You moved the dish by hand." if holder == "you" else f"{holder} moved the dish."


def yielded(holder: str | None) -> str:
    """Somebody else has the lease."""
    return "You have control." if holder == "you" else f"{holder} has control."


def held(held: HeldState, fault: Fault | None) -> str:
    """STOP, or something that went wrong."""
    if held.reason is HeldReason.STOP:
        return f"STOP by {held.by}."
    return f"{fault.what}." if fault is not None else f"The dish was stopped: {held.why}."


def interrupted(reason: HeldReason, task: Task) -> str:
    """What broke in, and what would make it go on; of a task that does not go on, what became of it."""
    if not task.goes_on:
        return f"{CUT_SHORT.get(reason, CUT_SHORT[HeldReason.CLOCK])} {task.cut_words}".rstrip()
    if reason is HeldReason.LINK and task.resumes:
        return (
            f"{SENTENCES[reason]} It resumes by itself if the link is back within {task.resume_within_s:g} s "
            "and the dish has not changed. Otherwise release it."
        )
    goes_on = task.homed_words if reason is HeldReason.FAULT and task.homed_words else task.resume_words
    return f"{SENTENCES.get(reason, SENTENCES[HeldReason.CLOCK])} {goes_on}"


def too_late(kind: str, *, yielded_to: str) -> str:
    """It could not go on in time; `yielded_to` says who had control, empty if it was interrupted."""
    over = "The pass" if kind == "pursuit" else f"The {kind}"
    return f"{yielded_to} {over} is over." if yielded_to else f"{over} ended before it could resume."
