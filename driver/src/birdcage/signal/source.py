"""The seam to whatever tells a signal level: the dish's own tuner, a receiver over rigctl, or somebody else's meter."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from datetime import datetime
from enum import Enum
from typing import Protocol

MONITOR = "monitor"
"""The owner of a source that is read because somebody looks at it, and not for a pass."""


class Scale(Enum):
    """What equal steps of a source's values mean."""

    LOG = "log"
    """Equal ratios of power: decibels."""
    LINEAR = "linear"
    """Equal steps of power."""


@dataclass(frozen=True, slots=True)
class SignalFacts:
    """What holds for every reading of a source. What is not known of it is None."""

    id: str
    """What `feed.NAME.signal` calls it: `tuner`, `rigctl`, the name of a `[signal.NAME]`."""
    label: str
    """What a person calls it, in a word."""
    unit: str
    scale: Scale | None
    rate_hz: float
    """How many readings it gives in a second of steady watching, on average."""
    pause_s: float
    """The longest usual time between two readings: a longer one is a gap."""
    latency_s: float | None
    """From the middle of what was measured to the reading."""
    dwell_s: float | None
    """How long a reading measures."""
    decimals: int
    """Digits behind the point that are worth showing."""
    span: float
    """What a scale shows of it at least, in its unit, so that noise looks like noise."""
    least: float | None
    """The lowest value that it can give; None where there is no such thing."""
    of_dish: bool
    """Whether it is the dish that is asked: it tells nothing while the dish does not answer, or is talked to."""
    demo: bool
    """Whether it is simulated."""
    where: str = ""
    """Where it is asked, for a person: an address, a command."""
    set_to: tuple[tuple[str, str], ...] = ()
    """What it is set to, for a recording: names and values."""


@dataclass(frozen=True, slots=True)
class Spectrum:
    """Levels at equal steps of frequency, lowest first, in the unit of the source."""

    levels: Sequence[float]
    low_hz: float
    high_hz: float
    channel_hz: tuple[float, float]
    """From where to where the source measures."""


@dataclass(frozen=True, slots=True)
class SignalReading:
    """One value, stamped at the middle of its dwell, as well as that can be told."""

    value: float
    unit: str
    at: float
    """Monotonic seconds."""
    utc: datetime
    source: str
    """The `id` of its facts."""
    dwell_s: float = 0.0
    """How long it measured, half of that before `at`; 0 if that is not known."""
    spectrum: Spectrum | None = None
    """What it was measured in, of a source that tells that."""
    n: int | None = None
    """How many values of the source's own it is the mean of; None where it does not tell."""
    scatter: float | None = None
    """Standard deviation of one of those; None where it does not tell."""


Hear = Callable[[SignalReading], object]
"""Takes a reading, on whichever thread took it: do nothing slow there."""


class SignalSource(Protocol):
    """A source. It is read only while somebody watches it, or a pass owns it; no call waits, any thread may make it."""

    @property
    def facts(self) -> SignalFacts:
        """What its readings mean."""

    @property
    def trouble(self) -> str:
        """Why nothing is read now, in sentences; empty while all is well, or where that says itself."""

    def subscribe(self, hear: Hear) -> Callable[[], None]:
        """Tell every reading from now on, whoever it was taken for; the result ends that."""

    def watch(self, watcher: str, *, steady: bool = False) -> None:
        """Read it from now on, again and again; `watcher` is `MONITOR`, or the target that it is read for.

        `steady`: as often as it can tell, at the cost of what else is read.
        """

    def unwatch(self, watcher: str) -> None:
        """Read it no more for this watcher."""
