"""How well the dish points while it follows: one sample for each reading, and what they come to."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

from birdcage.antenna.alignment import Alignment
from birdcage.base.geometry import separation, wrap_360
from birdcage.station.pursuit import Sample
from birdcage.station.state import StationState

if TYPE_CHECKING:
    from birdcage.tracking.plan import Plan

EVERY_S = 0.8
"""Samples closer together than this are one; mechanical seconds."""


@dataclass(slots=True)
class Errors:
    """What the samples come to so far."""

    count: int = 0
    squares: float = 0.0
    greatest_deg: float = 0.0

    def take(self, sample: Sample) -> None:
        """Count a sample in."""
        self.count += 1
        self.squares += sample.error_deg**2
        self.greatest_deg = max(self.greatest_deg, sample.error_deg)

    @property
    def rms_deg(self) -> float | None:
        """None before the first sample."""
        return math.sqrt(self.squares / self.count) if self.count else None

    @property
    def max_deg(self) -> float | None:
        """None before the first sample."""
        return self.greatest_deg if self.count else None


def sample_of(plan: Plan, state: StationState, alignment: Alignment, seen_s: float) -> Sample | None:
    """Return how well the last reading, made at `seen_s` (POSIX), points; None where there is none to judge."""
    from birdcage.tracking.mount import beam_deg_at

    here, beam_deg = state.position, beam_deg_at(state.beam_deg, state.beam_at_hz, plan.aim.frequency_hz)
    if here is None or plan.course is None:
        return None
    target_az, target_el = plan.sky.at(seen_s)
    planned_az, planned_el = alignment.to_true(*plan.course.at(seen_s))
    error = separation(target_az, target_el, here.az_deg, here.el_deg)
    expected = error if plan.pointing is None else plan.pointing.at(seen_s, error)
    commanded = state.target_az_deg, state.target_el_deg
    return Sample(
        here.at, here.utc, wrap_360(target_az), target_el, wrap_360(planned_az), planned_el,
        commanded[0] if commanded[0] is not None else here.az_deg,
        commanded[1] if commanded[1] is not None else here.el_deg,
        here.az_deg, here.el_deg, error,
        None if beam_deg is None or expected is None else 12.0 * (expected / beam_deg) ** 2, expected,
    )  # fmt: skip
