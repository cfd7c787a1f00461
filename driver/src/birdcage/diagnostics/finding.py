"""One thing that a person should know of a dish, how urgent it is, and what to do."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import datetime
from enum import Enum, IntEnum


class Weight(Enum):
    """How a finding is shown."""

    FAULT = "fault"
    WARN = "warn"
    NOTE = "note"


class Urgency(IntEnum):
    """What comes of a finding that is left alone. The smaller, the sooner it is told."""

    HURTS = 0
    """It can hurt the dish, or a person beside it."""
    STOPS = 1
    """The dish does not work, or not for long."""
    WILL_STOP = 2
    """It works, and that will end."""
    NOTE = 3
    """Worth knowing."""


WEIGHTS = {
    Urgency.HURTS: Weight.FAULT,
    Urgency.STOPS: Weight.FAULT,
    Urgency.WILL_STOP: Weight.WARN,
    Urgency.NOTE: Weight.NOTE,
}


@dataclass(frozen=True, slots=True)
class Finding:
    """What was found, in sentences: first the fact, then what it means, then what to do."""

    id: str
    """Stable from one look to the next: `stall.elevation`."""
    urgency: Urgency
    text: str
    why: str
    todo: tuple[str, ...]
    """What to do, step by step, the first step first."""
    since: datetime | None = None
    """When it happened first, of what is counted here; None for what only is so now."""
    latest: datetime | None = None
    """When it happened last."""
    count: int = 1
    grade: float = 0.0
    """How bad it is, in steps of its own: a finding that was acknowledged returns when this grows."""
    lasts: bool = False
    """Whether it is there only as long as its cause is: it goes by itself, and can't be acknowledged."""

    @property
    def weight(self) -> Weight:
        """How it is shown."""
        return WEIGHTS[self.urgency]

    def seen_until(self, days: int) -> str:
        """Return for how long an acknowledgement holds, where `days` are judged: `until it happens again`."""
        if self.latest is not None:
            return "until it happens again"
        return f"for {days} days, or until it gets worse" if days > 1 else "for a day, or until it gets worse"

    @property
    def needs_you(self) -> bool:
        """Whether somebody has to do something; a note only wants to be read."""
        return self.weight is not Weight.NOTE
