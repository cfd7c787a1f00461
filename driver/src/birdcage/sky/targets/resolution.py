"""What came of a text that names a target."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

from birdcage.base.errors import BirdcageError
from birdcage.base.reason import Reason
from birdcage.sky.elements import ElementSet
from birdcage.sky.targets.model import SlotTarget, Target
from birdcage.sky.targets.names import OffAir


class UnknownTarget(BirdcageError):
    """No single target is meant. Reasons: unknown, absent (a known name without elements), ambiguous, silent, angle."""

    reason = Reason.UNKNOWN


class Hit(Protocol):
    """A satellite that a search found: `birdcage.sky.catalogue.CatalogueEntry` is one."""

    @property
    def elements(self) -> ElementSet:
        """Its elements."""

    @property
    def time_offset_s(self) -> float | None:
        """How much later than computed it comes; None if not set."""


class Searchable(Protocol):
    """Where satellites are looked up: `SearchIndex` can do it."""

    def __len__(self) -> int:
        """How many there are."""

    def search(self, text: str, limit: int) -> Sequence[Hit]:
        """Return what a text may mean, best first."""

    def names(self) -> Sequence[str]:
        """Return what all of them are called."""


@dataclass(frozen=True, slots=True)
class TargetCandidate:
    """A target that may be meant."""

    target: Target
    text: str
    """What to type to mean this one and no other."""
    hit: Hit | None = None
    """What the catalogue has of it, of a satellite."""
    silence: OffAir | None = None
    """Of a satellite that is off the air."""

    @property
    def words(self) -> str:
        """Name, what to type for it, and whether it is silent: `NOAA 19 (33591, silent since 2025-08-13)`."""
        slot = self.target.slot if isinstance(self.target, SlotTarget) else None
        name = self.target.name if slot is None else slot.name or slot.label
        beside = [] if self.text.casefold() == name.casefold() else [self.text]
        beside += [] if self.silence is None else [self.silence.brief]
        return f"{name} ({', '.join(beside)})" if beside else name


@dataclass(frozen=True, slots=True)
class Resolution:
    """What a text means: one target, or why not."""

    typed: str
    found: TargetCandidate | None = None
    """What is meant: it alone bears the name, or it is clearly preferred."""
    exact: bool = False
    """Whether that is by its whole name, its number or numbers typed, and not by a part of a name."""
    reason: Reason | None = None
    """`UNKNOWN`, `ABSENT`, `AMBIGUOUS`, `SILENT` or `ANGLE` where nothing is found."""
    problem: str = ""
    """Why nothing is found, and what to type or do; empty if something is."""
    candidates: tuple[TargetCandidate, ...] = ()
    """What may be meant, best first, where nothing is found."""

    @property
    def note(self) -> str:
        """What a person should know of what is found, wherever it stands; empty for nothing."""
        if self.found is None:
            return ""
        target = self.found.target
        if isinstance(target, SlotTarget) and target.slot.is_empty:
            return f"Nothing is known to send from {target.slot.label} any more."
        return "" if self.found.silence is None else self.found.silence.words(target.name)

    @property
    def silent_since(self) -> str | None:
        """Day, month or year since which what is found is off the air; None if it is not, or none is known."""
        silence = None if self.found is None else self.found.silence
        return None if silence is None else silence.since or None

    @property
    def target(self) -> Target:
        """What is meant. UnknownTarget where nothing is found."""
        if self.found is None:
            raise UnknownTarget(self.problem, reason=self.reason)
        return self.found.target
