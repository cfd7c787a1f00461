"""How well the dish points while it follows: one sample for each reading, and what they come to."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

from birdcage.antenna.alignment import Alignment
from birdcage.base.geometry import offset, separation, wrap_360
from birdcage.station.pursuit_state import PointingSample
from birdcage.station.state import Pointing, StationState

if TYPE_CHECKING:
    from birdcage.tracking.curve import Curve
    from birdcage.tracking.plan import Plan

ABOUT_S = 0.5
"""Which way the target goes is told by where it is so long before and after."""
EVERY_S = 0.8
"""Samples closer together than this are one; mechanical seconds."""


@dataclass(slots=True)
class Errors:
    """What the samples come to so far."""

    count: int = 0
    squares: float = 0.0
    greatest_deg: float = 0.0

    def take(self, sample: PointingSample) -> None:
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


def sample_of(plan: Plan, state: StationState, alignment: Alignment, seen_s: float) -> PointingSample | None:
    """Return how well the last reading, made at `seen_s` (POSIX), points; None if there is none to judge.

    A reading counts the motor; where the play of the gear is known, the error is that of what hangs behind it.
    """
    here = state.position
    beam = None if state.beam is None else state.beam.at(plan.aim.frequency_hz)
    if here is None or plan.course is None:
        return None
    target_az, target_el = plan.sky.at(seen_s)
    planned_az, planned_el = alignment.to_true(*plan.course.at(seen_s))
    points_az, points_el = _behind_the_play(plan.course, state, alignment, here, seen_s)
    error = separation(target_az, target_el, points_az, points_el)
    expected = error if plan.pointing is None else plan.pointing.at(seen_s, error)
    lost_db = None
    if beam is not None and expected is not None:
        # The share of the elements is of unknown direction.
        added_deg = math.sqrt(max(expected**2 - error**2, 0.0))
        lost_db = beam.loss_db(*offset(target_az, target_el, points_az, points_el)) + beam.most_loss_db(added_deg)
    commanded = state.target_az_deg, state.target_el_deg
    return PointingSample(
        here.at, here.utc, wrap_360(target_az), target_el, wrap_360(planned_az), planned_el,
        commanded[0] if commanded[0] is not None else here.az_deg,
        commanded[1] if commanded[1] is not None else here.el_deg,
        here.az_deg, here.el_deg, error, lost_db, expected,
    )  # fmt: skip


def _behind_the_play(
    course: Curve, state: StationState, alignment: Alignment, here: Pointing, seen_s: float
) -> tuple[float, float]:
    """Return where the dish points, in true degrees: half the play behind its motors, as far as that is known."""
    dish = state.dish
    if dish is None or not (dish.azimuth.play_deg or dish.elevation.play_deg):
        return here.az_deg, here.el_deg
    before, after = course.at(seen_s - ABOUT_S), course.at(seen_s + ABOUT_S)
    az_deg, el_deg = (
        read_deg - math.copysign((axis.play_deg or 0.0) / 2.0, goes_deg) if goes_deg else read_deg
        for axis, read_deg, goes_deg in (
            (dish.azimuth, here.dish_az_deg, after[0] - before[0]),
            (dish.elevation, here.dish_el_deg, after[1] - before[1]),
        )
    )
    return alignment.to_true(az_deg, el_deg)
