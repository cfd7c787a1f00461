"""Answers to the question for the position that are none."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import TypeVar

from birdcage.base.errors import NoReply, PositionUnknown
from birdcage.base.reason import Reason

T = TypeVar("T")


class UnreadablePosition(NoReply):
    """An answer to the question for the position that is no position. `printed` is what the machine said."""

    reason = Reason.GARBAGE

    def __init__(self, message: str, printed: Iterable[str], *, unhomed: bool = False) -> None:
        """Take in what was said; `unhomed`: whether that says in words that the machine is not homed."""
        super().__init__(message)
        self.printed = tuple(printed)
        self.unhomed = unhomed

    def repeats(self, other: UnreadablePosition) -> bool:
        """Return whether the dish said the same before, with every byte legible: then no damage made it of an angle."""
        legible = not any("\N{REPLACEMENT CHARACTER}" in line for line in self.printed)
        return legible and self.printed == other.printed


def settled(read: Callable[[], T]) -> T:
    """Return what `read` reads, asking once more after what is no position.

    PositionUnknown (`unhomed`, `unreadable`) where the machine says the same twice: it answers, so it can be homed all
    the same.
    """
    try:
        return read()
    except UnreadablePosition as once:
        first = once
    try:
        return read()
    except UnreadablePosition as again:
        if not again.repeats(first):
            raise
        if again.unhomed:
            raise PositionUnknown(f"The dish reports that it is not homed. {again}", reason=Reason.UNHOMED) from again
        raise PositionUnknown(f"The position reply can't be read. {again}", reason=Reason.UNREADABLE) from again
