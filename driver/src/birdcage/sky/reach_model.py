"""What reach is told in: the parts of a pass that this dish can follow, and the others (`birdcage.sky.reach`)."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass
from datetime import datetime
from enum import StrEnum
from typing import NamedTuple


class LossReason(StrEnum):
    """Which limit keeps a dish from following; the words are those of lists and files."""

    FLOOR = "floor"
    CEILING = "ceiling"
    HORIZON = "horizon"
    """The horizon mask: the dish may follow behind it, and hears nothing."""
    NO_GO = "no-go"
    CABLE = "cable"
    KEYHOLE = "keyhole"
    """Too fast near the zenith."""
    NO_TRACKING = "no tracking"
    """A machine that follows nothing."""


class LossCause(NamedTuple):
    """A limit: of several no-go sectors, which one."""

    reason: LossReason
    sector: str = ""
    """What stands in a no-go sector, as its owner calls it; empty if not said, and for other limits."""

    @property
    def words(self) -> str:
        """The same for a person: `floor`, `no-go: mast`."""
        return f"{self.reason}: {self.sector}" if self.sector else str(self.reason)


@dataclass(frozen=True, slots=True)
class Stretch:
    """A part of the pass in which the dish can point at the satellite."""

    start: datetime
    end: datetime
    turn: int | None = None
    """The cable stands at azimuth - offset + 360 turn; None if nothing winds up, or the turn is not known."""

    @property
    def start_s(self) -> float:
        """POSIX seconds."""
        return self.start.timestamp()

    @property
    def end_s(self) -> float:
        """POSIX seconds."""
        return self.end.timestamp()

    @property
    def duration_s(self) -> float:
        """From start to end."""
        return (self.end - self.start).total_seconds()


@dataclass(frozen=True, slots=True)
class Lost:
    """A part of the pass in which it cannot."""

    start: datetime
    end: datetime
    reason: LossReason
    sector: str = ""
    """As `LossCause.sector`."""

    @property
    def cause(self) -> LossCause:
        """Reason and sector."""
        return LossCause(self.reason, self.sector)

    @property
    def duration_s(self) -> float:
        """From start to end."""
        return (self.end - self.start).total_seconds()


@dataclass(frozen=True, slots=True)
class PassReach:
    """What of a pass this dish can follow; `intervals` and `lost` together are the whole pass, each in order."""

    intervals: tuple[Stretch, ...] = ()
    lost: tuple[Lost, ...] = ()
    best_el_deg: float | None = None
    """The highest elevation within the intervals; None if there are none."""

    @property
    def total_s(self) -> float:
        """How long it can be followed in all."""
        return sum((stretch.duration_s for stretch in self.intervals), 0.0)

    @property
    def reasons(self) -> tuple[LossReason, ...]:
        """Why not all of it, each reason once, in order of time."""
        return tuple(dict.fromkeys(lost.reason for lost in self.lost))

    @property
    def lost_s(self) -> dict[LossCause, float]:
        """How long each limit takes in all, in order of time."""
        seconds: dict[LossCause, float] = {}
        for lost in self.lost:
            seconds[lost.cause] = seconds.get(lost.cause, 0.0) + lost.duration_s
        return seconds

    def words(self, *, but: Collection[LossReason] = (), costliest_first: bool = False) -> tuple[str, ...]:
        """Return the words of each limit once, but for some reasons: in order of time, or of what they cost."""
        seconds = {cause: lost_s for cause, lost_s in self.lost_s.items() if cause.reason not in but}
        causes = sorted(seconds, key=lambda cause: -seconds[cause]) if costliest_first else list(seconds)
        return tuple(cause.words for cause in causes)

    def holds(self, t_s: float) -> bool:
        """Return whether the dish can point there at a time (POSIX seconds)."""
        return any(one.start_s <= t_s <= one.end_s for one in self.intervals)
