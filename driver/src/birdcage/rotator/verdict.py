"""What a raw line may do: every face warns from it, and the languages fill it from their tables."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from enum import IntEnum


class Grade(IntEnum):
    """How much a line may do; the higher, the worse."""

    HARMLESS = 0
    SETTING = 1
    """Changes a setting. What is in no table counts as this, or as worse."""
    MOVES = 2
    RUINS = 3
    """Can ruin the dish or deadlock its shell."""


@dataclass(frozen=True, slots=True)
class RawAim:
    """Where a raw line sends the dish, in its own frame."""

    angles_deg: Mapping[int, float]
    """By motor number."""
    relative: bool = False
    """Whether they count from where the dish stands (noted of one firmware only).

    Its target is judged and not told, as another firmware may take it as it is written.
    """

    @property
    def single(self) -> tuple[int, float] | None:
        """The axis and the absolute angle that the line sends it to; None if it is no such line."""
        (found, *others) = self.angles_deg.items()
        return None if others or self.relative else found


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
    aim: RawAim | None = None
    """Where the line sends the dish, when that can be read off it."""
    listed: bool = True
    """Whether the table knows the line."""
    takes_s: float = 0.0
    """How long it may keep the shell busy before the prompt comes back."""
    streams: bool = False
    """Whether it prints until a key ends it."""
    homes: tuple[int, ...] = ()
    """The axes whose reference it finds, with a motion that nothing stops."""
    restarts: bool = False
    """Whether the dish starts anew."""
    releases: bool = False
    """Whether it takes the current off the motors."""
