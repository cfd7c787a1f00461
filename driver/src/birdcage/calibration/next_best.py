"""Which object to peak on next: the one after which the whole sky is known best. Imports numpy."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from birdcage.antenna.alignment import Alignment
from birdcage.calibration.candidates import CalibrationObject
from birdcage.calibration.fit import Fit, Floats, covariance_of, jacobian
from birdcage.calibration.peak import MeasuredPeak
from birdcage.calibration.terms import Priors

AZ_STEP_DEG = 30
EL_STEP_DEG = 12


@dataclass(frozen=True, slots=True)
class Proposal:
    """An object, and what a peak on it is worth."""

    candidate: CalibrationObject
    error_now_deg: float
    """The expected error over the sky that this dish reaches, as known now."""
    error_then_deg: float
    """The same after this peak."""

    @property
    def gain_deg(self) -> float:
        """By how much that falls."""
        return self.error_now_deg - self.error_then_deg

    def words(self) -> str:
        """Say why."""
        where = f"at {self.candidate.az_deg:.0f}° / {self.candidate.el_deg:.0f}°"
        falls = f"{_deg(self.error_now_deg)} to {_deg(self.error_then_deg)}"
        return f"{where}: the expected error over the sky falls from {falls}"


LITTLE = 0.05
"""A share of the error below which another peak is hardly worth the walk."""


def enough(proposals: Sequence[Proposal]) -> bool:
    """Return whether nothing that is up would tell much more than is known already."""
    return all(each.gain_deg < LITTLE * each.error_now_deg for each in proposals)


def rank(
    candidates: Iterable[CalibrationObject], peaks: Sequence[MeasuredPeak], priors: Priors, alignment: Alignment,
    el_range_deg: tuple[float, float],
) -> tuple[Proposal, ...]:  # fmt: skip
    """Return the objects, best first. `el_range_deg`: the lowest and highest elevation that this dish reaches."""
    sky = _over_the_sky(alignment, el_range_deg)
    before = np.linalg.inv(covariance_of(peaks, priors, alignment))
    now = expected_error_deg(np.linalg.inv(before), sky)
    proposals = []
    for candidate in candidates:
        rows = jacobian([alignment.to_dish(candidate.az_deg, candidate.el_deg)], alignment)
        then = np.linalg.inv(before + rows.T @ rows / candidate.sigma_deg**2)
        proposals.append(Proposal(candidate, now, expected_error_deg(then, sky)))
    return tuple(sorted(proposals, key=lambda each: each.error_then_deg))


def sky_error_deg(fitted: Fit, el_range_deg: tuple[float, float]) -> float:
    """Return the error to expect over the sky by a fit, as well as its peaks and priors know it."""
    return expected_error_deg(np.array(fitted.covariance), _over_the_sky(fitted.alignment, el_range_deg))


def expected_error_deg(covariance: NDArray[np.floating], sky: Floats) -> float:
    """Return the root mean square over the sky of the error that these uncertain terms make."""
    return math.sqrt(float(np.einsum("ij,jk,ik->", sky, covariance, sky)) * 2.0 / len(sky))


def _over_the_sky(alignment: Alignment, el_range_deg: tuple[float, float]) -> Floats:
    """Return what the terms do to directions all over the sky that is reached, even in solid angle."""
    low, high = (math.sin(math.radians(min(max(el, 0.0), 89.0))) for el in el_range_deg)
    levels = max(2, round(math.degrees(math.asin(high) - math.asin(low)) / EL_STEP_DEG))
    elevations = [math.degrees(math.asin(low + (high - low) * (level + 0.5) / levels)) for level in range(levels)]
    directions = [alignment.to_dish(float(az), el) for el in elevations for az in range(0, 360, AZ_STEP_DEG)]
    return jacobian(directions, alignment)


def _deg(value: float) -> str:
    return f"{value:.2f}°" if value < 10.0 else f"{value:.0f}°"
