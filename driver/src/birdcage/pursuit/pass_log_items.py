"""What goes from the station's thread to the thread that writes the log of passes."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import datetime

from birdcage.pursuit.pass_record import PassHead, PassSample


@dataclass(frozen=True, slots=True)
class Began:
    """A pass begins."""

    head: PassHead
    csv: str | None = None
    """Its file, once that is made."""


@dataclass(frozen=True, slots=True)
class Told:
    """More is known of the pass under way."""

    head: PassHead


@dataclass(frozen=True, slots=True)
class Looked:
    """A sample of the pass under way."""

    sample: PassSample


@dataclass(frozen=True, slots=True)
class Remarked:
    """A line of text about a target's pass, which may have ended, or not begun."""

    name: str
    """Of the target."""
    utc: datetime
    text: str


@dataclass(frozen=True, slots=True)
class Ended:
    """The pass under way is over."""

    utc: datetime
    outcome: str
    latency_s: float | None


Item = Began | Told | Looked | Remarked | Ended
