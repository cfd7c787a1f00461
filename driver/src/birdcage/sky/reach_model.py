"""What reach is told in: the parts of a pass that this dish can follow, and the others (`birdcage.sky.reach`)."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import datetime


@dataclass(frozen=True, slots=True)
class Stretch:
    """A part of the pass in which the dish can point at the satellite."""

    start: datetime
    end: datetime
    turn: int | None = None
    """The cable stands at azimuth - offset + 360 turn; None if nothing winds up, or the turn is not known."""

    @property
    def duration_s(self) -> float:
        """From start to end."""
        return (self.end - self.start).total_seconds()


@dataclass(frozen=True, slots=True)
class Lost:
    """A part of the pass in which it cannot."""

    start: datetime
    end: datetime
    reason: str
    """`floor`, `ceiling`, `horizon`, `no-go: mast`, `cable`, `keyhole`, or `no tracking`."""


@dataclass(frozen=True, slots=True)
class PassReach:
    """What of a pass this dish can follow; `intervals` and `lost` together are the whole pass, each in order."""

    intervals: tuple[Stretch, ...]
    lost: tuple[Lost, ...]
    best_el_deg: float | None
    """The highest elevation within the intervals; None if there are none."""

    @property
    def total_s(self) -> float:
        """How long it can be followed in all."""
        return sum((stretch.duration_s for stretch in self.intervals), 0.0)

    @property
    def reasons(self) -> tuple[str, ...]:
        """Why not all of it, each reason once, in order of time."""
        return tuple(dict.fromkeys(lost.reason for lost in self.lost))
