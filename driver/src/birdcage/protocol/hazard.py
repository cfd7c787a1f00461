"""What a raw console line may do, as data: every dialect has a table, and every face warns from it."""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum


class Grade(IntEnum):
    """How much a line may do; the higher, the worse."""

    HARMLESS = 0
    SETTING = 1
    """Changes a setting. What is in no table counts as this."""
    MOVES = 2
    RUINS = 3
    """Can ruin the dish or deadlock its shell."""


@dataclass(frozen=True, slots=True)
class Verdict:
    """What is to be said of one line before it is sent."""

    grade: Grade
    consequence: str
    """A sentence for a person; empty for a harmless line."""
    forgets: frozenset[str] = frozenset()
    """What no longer holds afterwards: of `position`, `turn`, `homed`, `limits`, `search`, `settings`."""
    limit: str = ""
    """Which limit a raw motion would break and by how much, as a sentence; empty when none, or not a motion."""
    motion: tuple[int, float] | None = None
    """The axis and the absolute angle (dish frame, degrees) that the line sends it to, when that can be read off it."""
    listed: bool = True
    """Whether the table knows the line."""
