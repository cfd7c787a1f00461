"""The scale of a strip chart: from where to where it goes, and at which round numbers it has a line."""

from __future__ import annotations

import math
from dataclasses import dataclass

APART, TIGHT, TALL = 2.0, 1.5, 8
"""Rows that two lines are apart at least; where there are fewer than `TALL`, `TIGHT`; one, where only then two show."""


@dataclass(frozen=True, slots=True)
class StripScale:
    """From `low` at the bottom to `high` at the top, in the unit of what is drawn."""

    low: float
    high: float
    step: float
    """From one line to the next: 1, 2 or 5 times a power of ten."""

    @property
    def ticks(self) -> tuple[float, ...]:
        """Where the lines are: multiples of the step, the lowest first."""
        first = math.ceil(self.low / self.step - 1e-9)
        last = math.floor(self.high / self.step + 1e-9)
        return tuple(index * self.step for index in range(first, last + 1))

    @property
    def decimals(self) -> int:
        """Digits behind the point that tell one line from the next."""
        return max(0, -math.floor(math.log10(self.step) + 1e-9))

    def dot(self, value: float, dots: int) -> float:
        """Return the row of dots of a value, the uppermost being 0 and the lowest `dots`."""
        return dots * (1.0 - (value - self.low) / (self.high - self.low))


def strip_scale(lowest: float, highest: float, span: float, least: float | None, rows: int) -> StripScale:
    """Return a scale that holds all values, shows `span` at least, and ends at what can be least."""
    spare = max(span - (highest - lowest), (highest - lowest) * 0.1, 1e-6)
    low, high = lowest - spare / 2.0, highest + spare / 2.0
    if least is not None:
        low = max(least, low)
        high = max(high, low + spare / 2.0)
    rows = max(rows, 2)
    scale = StripScale(low, high, _round_up((high - low) * (APART if rows >= TALL else TIGHT) / rows))
    closer = StripScale(low, high, _round_up((high - low) / rows))
    return closer if len(scale.ticks) < min(2, len(closer.ticks)) else scale


def _round_up(step: float) -> float:
    """Return the next of 1, 2 and 5 times a power of ten."""
    power: float = 10.0 ** math.floor(math.log10(step))
    return next(factor * power for factor in (1.0, 2.0, 5.0, 10.0) if factor * power >= step * (1.0 - 1e-9))
