"""The seam to one conversation with something that tells levels: a program, a server, a receiver."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

from birdcage.base.errors import BirdcageError
from birdcage.base.reason import Reason
from birdcage.signal.source import Spectrum


class MeterError(BirdcageError):
    """It is over, and is begun anew a little later. The message says why, and what helps."""

    reason = Reason.SILENT


@dataclass(frozen=True, slots=True)
class MeterReading:
    """One level."""

    value: float
    at: float
    """Monotonic seconds: the middle of what was measured, as well as that can be told."""
    dwell_s: float
    """How long it measured; 0 if that is not known."""
    spectrum: Spectrum | None = None
    n: int | None = None
    """How many values it is the mean of; None if that is not known."""
    scatter: float | None = None
    """Standard deviation of one of those; None if that is not known."""


class Meter(Protocol):
    """For one thread. `open`, then `read` again and again, and `close` on every way out; then it may be opened anew."""

    def open(self) -> None:
        """Begin. MeterError where that can't be done."""

    def read(self, within_s: float) -> MeterReading | None:
        """Return the next level; None if none came within the time. MeterError once it is over."""

    def close(self) -> None:
        """End it, also where it was never opened."""


LARGEST = 1e9
"""No unit makes a level beyond this: what is larger is a mistake, and would fill a screen with digits."""


def is_level(value: float) -> bool:
    """Return whether a number may be a level: neither infinite, nor not a number, nor beyond all sense."""
    return abs(value) < LARGEST


def level_in(text: str) -> float | None:
    """Return the number at the beginning of a line; None if there is none that may be a level."""
    words = text.replace(",", " ").split()
    try:
        value = float(words[0]) if words else float("nan")
    except ValueError:
        return None
    return value if is_level(value) else None
