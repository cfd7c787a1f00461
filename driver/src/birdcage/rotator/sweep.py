"""A sweep along one axis that a machine makes by itself, telling the signal as it goes."""

from __future__ import annotations

import math
from dataclasses import dataclass

ROUNDING_DEG = 1e-6


@dataclass(frozen=True, slots=True)
class OwnSweep:
    """What is known of it, as data."""

    axes: tuple[str, ...]
    """Which axes it can sweep, by name."""
    least_step_deg: float
    """Its steps are whole multiples of this."""
    most_span_deg: float
    most_transponders: int
    """How many it can go through at each position."""
    way_known: bool
    """Whether it is known to turn to greater angles; else the gate wants as much room on the other side."""
    whole_span: bool = True
    """Whether it takes whole degrees only."""

    def asked_deg(self, span_deg: float, step_deg: float) -> float:
        """Return the span to ask it for, so that both ends of a line are heard: it stops a step before the end."""
        asked = span_deg + step_deg
        return float(math.ceil(asked - ROUNDING_DEG)) if self.whole_span else asked


@dataclass(frozen=True, slots=True)
class SweepOrder:
    """One sweep, from where the machine stands. Degrees of its own."""

    axis: str
    span_deg: float
    step_deg: float
    transponders: int = 1
    """How many it goes through at each position."""


@dataclass(frozen=True, slots=True)
class SweptReading:
    """What it told at one position."""

    axis: str
    deg: float
    """Its own degrees."""
    level: float
    """In counts of its own, whose scale need not be that of its tuner."""
