"""What goes from the station's thread to the thread that writes the log of passes."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import datetime

from birdcage.pursuit.pass_listener import PassFile, PassRemark
from birdcage.pursuit.pass_record import PassHead, PassSample


@dataclass(frozen=True, slots=True)
class PassBegan:
    """A pass begins."""

    head: PassHead
    csv: str | None = None
    """Its file, once that is made."""


@dataclass(frozen=True, slots=True)
class PassTold:
    """More is known of the pass under way."""

    head: PassHead


@dataclass(frozen=True, slots=True)
class PassLooked:
    """A sample of the pass under way."""

    sample: PassSample


@dataclass(frozen=True, slots=True)
class PassEnded:
    """The pass under way is over."""

    utc: datetime
    outcome: str
    latency_s: float | None


Item = PassBegan | PassTold | PassLooked | PassRemark | PassFile | PassEnded
