"""What was heard between two samples of a pass: level, its scatter and how many readings, and the SNR."""

from __future__ import annotations

import math
import threading
from dataclasses import dataclass, field, replace

FRESH_S = 3.0
"""How old a level may be that stands beside a sample when none was heard since the one before."""
STILL_FRESH_S = 10.0
"""The same of the tuner while the dish stands still on a target that does not pass: it is read every 9 s."""


@dataclass(frozen=True, slots=True)
class SampleLevel:
    """What stands beside a sample. What was not heard is None."""

    value: float | None = None
    """The mean of `n` readings; without new ones the last that is fresh."""
    unit: str | None = None
    scatter: float | None = None
    """Standard deviation of one reading; None for fewer than two."""
    n: int = 0
    """How many readings have come since the sample before."""
    snr_db: float | None = None
    """The last that has come since the sample before."""


@dataclass
class _Gathered:
    """The readings of one source since the last sample."""

    last: tuple[float, float, str] | None = None
    """When the newest was taken, monotonic; its value and unit."""
    values: list[float] = field(default_factory=list)

    def add(self, at: float, value: float, unit: str) -> None:
        if self.last is not None and unit != self.last[2]:
            self.values.clear()
        self.last = (at, value, unit)
        self.values.append(value)

    def take(self, at: float, fresh_s: float) -> SampleLevel | None:
        """Return what stands beside a sample at this time; None without a fresh reading."""
        values, self.values = self.values, []
        if self.last is None or at - self.last[0] > fresh_s:
            return None
        _at, value, unit = self.last
        if not values:
            return SampleLevel(value, unit)
        mean = math.fsum(values) / len(values)
        return SampleLevel(mean, unit, scatter_of(values, mean), len(values))


class PassLevels:
    """Any thread adds; one takes. What a receiver tells goes before the dish's own tuner."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._receiver, self._tuner = _Gathered(), _Gathered()
        self._snr: float | None = None

    def by_receiver(self, at: float, value: float, unit: str) -> None:
        """Take what a source beside the dish tells; `at` in monotonic seconds."""
        with self._lock:
            self._receiver.add(at, value, unit)

    def by_tuner(self, at: float, value: float, unit: str) -> None:
        """Take what the dish's own tuner tells."""
        with self._lock:
            self._tuner.add(at, value, unit)

    def snr(self, snr_db: float) -> None:
        """Take the signal-to-noise ratio that the dish's own receiver tells."""
        with self._lock:
            self._snr = snr_db

    def begin(self) -> None:
        """A pass begins: what was heard before is none of its readings."""
        with self._lock:
            self._receiver.values.clear()
            self._tuner.values.clear()
            self._snr = None

    def take(self, at: float, *, still: bool) -> SampleLevel:
        """Return what was heard since the last call, at a monotonic time; `still`: the target does not pass."""
        fresh_s = STILL_FRESH_S if still else FRESH_S
        with self._lock:
            snr_db, self._snr = self._snr, None
            # Both are emptied: a reading that is not used now belongs to no later sample.
            told = [self._receiver.take(at, FRESH_S), self._tuner.take(at, fresh_s)]
        return replace(next(filter(None, told), SampleLevel()), snr_db=snr_db)


def scatter_of(values: list[float], mean: float) -> float | None:
    """Return the standard deviation of one value; None for fewer than two."""
    if len(values) < 2:
        return None
    return math.sqrt(math.fsum((each - mean) ** 2 for each in values) / (len(values) - 1))
