"""Fits the pointing model to peaks: weighted least squares with a prior on every term.

`docs/decisions/0016-pointing-model.md` has the terms and their priors.

Imports numpy; faces import it inside functions.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from birdcage.antenna.alignment import Alignment
from birdcage.calibration.peak import MeasuredPeak
from birdcage.calibration.terms import TERMS, Priors, terms_for

Floats = NDArray[np.float64]

STEP_DEG = 1e-3
"""Of the numerical derivative."""
TURNS_MOST = 20
DONE_DEG = 1e-5
ILL_CONDITIONED = 100.0
"""Beyond it two terms do nearly the same to these peaks. The geostationary arc alone comes to some 60."""
AGREE = 9.0
"""Peaks that scatter by three times what they were said to, squared, contradict each other."""


@dataclass(frozen=True, slots=True)
class Residual:
    """How far an object lay from where the fitted model has the beam, on the sky, in degrees."""

    peak: MeasuredPeak
    right_deg: float
    up_deg: float
    alone_right_deg: float | None
    """The same by a fit without this peak: what it says of a direction that was not measured. None for a lone peak."""
    alone_up_deg: float | None

    @property
    def off_deg(self) -> float:
        """How far in all."""
        return math.hypot(self.right_deg, self.up_deg)


@dataclass(frozen=True, slots=True)
class Fit:
    """What came out. Standard errors are by term, in the order of `TERMS`; those of terms that were held are None."""

    alignment: Alignment
    terms: tuple[str, ...]
    """Those that were fitted; the others stand where they were believed to be."""
    errors_deg: tuple[float | None, ...]
    covariance: tuple[tuple[float, ...], ...]
    """Of all five terms, priors included, in degrees squared."""
    residuals: tuple[Residual, ...]
    rms_before_deg: float
    """Of these peaks by the alignment that was in force."""
    rms_deg: float
    leave_one_out_rms_deg: float | None
    """What to expect of a direction that was not measured; None for a lone peak."""
    condition: float | None
    """How alike the terms are, as seen by these peaks alone; None if they do not even tell them apart."""
    warning: str
    """What to do about it, in a sentence; empty if nothing."""


def fit(peaks: Sequence[MeasuredPeak], priors: Priors, before: Alignment, terms: Sequence[str] | None = None) -> Fit:
    """Fit `terms` (by default as many as these peaks carry) to the peaks. ValueError without a peak."""
    if not peaks:
        raise ValueError("a fit needs a peak")
    chosen = tuple(terms or terms_for(len(peaks)))
    free = [TERMS.index(name) for name in chosen]
    values = _solve(peaks, priors, free)
    alignment = Alignment(*map(float, values))
    spread = _spread(peaks, alignment, len(chosen))
    covariance = covariance_of(peaks, priors, alignment) * max(1.0, spread)
    condition = condition_of(peaks, alignment, free)
    without = [_without(peaks, index, priors, free, values) for index in range(len(peaks))]
    alone = [
        (None, None) if others is None else peak.off(*others.to_true(peak.dish_az_deg, peak.dish_el_deg))
        for peak, others in zip(peaks, without, strict=True)
    ]
    residuals = tuple(
        Residual(peak, *peak.off(*alignment.to_true(peak.dish_az_deg, peak.dish_el_deg)), *out)
        for peak, out in zip(peaks, alone, strict=True)
    )
    outside = [math.hypot(*out) for out in alone if out[0] is not None and out[1] is not None]
    return Fit(
        alignment=alignment,
        terms=chosen,
        errors_deg=tuple(math.sqrt(covariance[index, index]) if index in free else None for index in range(len(TERMS))),
        covariance=tuple(tuple(map(float, row)) for row in covariance),
        residuals=residuals,
        rms_before_deg=_rms([math.hypot(*off) for off in _offs(peaks, before)]),
        rms_deg=_rms([each.off_deg for each in residuals]),
        leave_one_out_rms_deg=_rms(outside) if outside else None,
        condition=condition,
        warning=_warning(peaks, condition, _odd_one(peaks, without) if spread > AGREE else None),
    )


def jacobian(directions: Sequence[tuple[float, float]], alignment: Alignment) -> Floats:
    """Return what a degree of each term moves the beam on the sky with the dish at these own angles.

    Two rows a direction (to the right, up), five columns.
    """
    rows = np.zeros((2 * len(directions), len(TERMS)))
    base = [getattr(alignment, name) for name in TERMS]
    for column in range(len(TERMS)):
        ends = []
        for sign in (-1.0, 1.0):
            values = list(base)
            values[column] += sign * STEP_DEG
            ends.append([Alignment(*values).to_true(*each) for each in directions])
        for row, ((az0, el0), (az1, el1)) in enumerate(zip(*ends, strict=True)):
            turn = (az1 - az0 + 180.0) % 360.0 - 180.0
            rows[2 * row, column] = turn * math.cos(math.radians((el0 + el1) / 2.0)) / (2.0 * STEP_DEG)
            rows[2 * row + 1, column] = (el1 - el0) / (2.0 * STEP_DEG)
    return rows


def covariance_of(peaks: Sequence[MeasuredPeak], priors: Priors, alignment: Alignment) -> Floats:
    """Return how well all five terms are known from these peaks and the priors."""
    information = np.diag(1.0 / np.square(priors.sigma))
    if peaks:
        rows = jacobian([(peak.dish_az_deg, peak.dish_el_deg) for peak in peaks], alignment)
        weights = np.repeat([peak.weight for peak in peaks], 2)
        information = information + rows.T @ (rows * weights[:, None])
    return np.asarray(np.linalg.inv(information), dtype=np.float64)


def condition_of(peaks: Sequence[MeasuredPeak], alignment: Alignment, free: Sequence[int]) -> float | None:
    """Return the condition number of the peaks' own equations, columns scaled to one length; None for a singular one.

    Priors are left out: it tells whether the peaks are spread well enough over the sky.
    """
    rows = jacobian([(peak.dish_az_deg, peak.dish_el_deg) for peak in peaks], alignment)[:, free]
    rows = rows * np.sqrt(np.repeat([peak.weight for peak in peaks], 2))[:, None]
    lengths = np.linalg.norm(rows, axis=0)
    if len(rows) < len(free) or not lengths.all():
        return None
    value = float(np.linalg.cond(rows / lengths))
    return value if math.isfinite(value) and value < 1e9 else None


def _solve(peaks: Sequence[MeasuredPeak], priors: Priors, free: Sequence[int], start: Floats | None = None) -> Floats:
    """Return all five terms: Gauss and Newton, from what is believed or from a `start` that is near."""
    mean = np.array(priors.mean)
    values = mean.copy() if start is None else start.copy()
    ridge = 1.0 / np.square(np.array(priors.sigma)[free])
    weights = np.repeat([peak.weight for peak in peaks], 2)
    dish = [(peak.dish_az_deg, peak.dish_el_deg) for peak in peaks]
    for _ in range(TURNS_MOST):
        alignment = Alignment(*map(float, values))
        rows = jacobian(dish, alignment)[:, free]
        off = np.array(_offs(peaks, alignment)).ravel()
        matrix = rows.T @ (rows * weights[:, None]) + np.diag(ridge)
        step = np.linalg.solve(matrix, rows.T @ (weights * off) + ridge * (mean - values)[free])
        values[free] += step
        if float(np.abs(step).max()) < DONE_DEG:
            break
    return values


def _without(
    peaks: Sequence[MeasuredPeak], index: int, priors: Priors, free: Sequence[int], start: Floats
) -> Alignment | None:
    """Return what the others say without one of the peaks; None if there are none."""
    others = [*peaks[:index], *peaks[index + 1 :]]
    return Alignment(*map(float, _solve(others, priors, free, start))) if others else None


def _offs(peaks: Sequence[MeasuredPeak], alignment: Alignment) -> list[tuple[float, float]]:
    return [peak.off(*alignment.to_true(peak.dish_az_deg, peak.dish_el_deg)) for peak in peaks]


def _spread(peaks: Sequence[MeasuredPeak], alignment: Alignment, count: int) -> float:
    """Return by how much the peaks scatter more than they were said to, squared; 1 where that can't be told."""
    freedom = 2 * len(peaks) - count
    if freedom <= 0:
        return 1.0
    return _chi2(peaks, alignment) / freedom


def _chi2(peaks: Sequence[MeasuredPeak], alignment: Alignment) -> float:
    offs = zip(peaks, _offs(peaks, alignment), strict=True)
    return sum(peak.weight * (right**2 + up**2) for peak, (right, up) in offs)


def _odd_one(peaks: Sequence[MeasuredPeak], without: Sequence[Alignment | None]) -> MeasuredPeak | None:
    """Return the peak without which the others agree best; None if so few do not tell which it is."""
    if len(peaks) < 4:
        return None
    left = [
        _chi2([*peaks[:index], *peaks[index + 1 :]], others)
        for index, others in enumerate(without)
        if others is not None
    ]
    return peaks[left.index(min(left))]


def _rms(values: Sequence[float]) -> float:
    return math.sqrt(sum(value**2 for value in values) / len(values))


def _warning(peaks: Sequence[MeasuredPeak], condition: float | None, odd: MeasuredPeak | None) -> str:
    if len(peaks) < 3:
        return "Offsets only. Three objects give the tilt, four the collimation."
    if odd is not None:
        name = f"Peak {odd.number} ({odd.target})" if odd.number else odd.target
        return f"{name} disagrees with the others. Take it again, or delete it."
    if condition is None or condition > ILL_CONDITIONED:
        told = "These peaks can't tell all terms apart" if condition is None else (
            f"These peaks hardly tell the terms apart (condition {condition:.0f})"
        )  # fmt: skip
        return f"{told}. Add one far from them: high up, or across the sky."
    return ""
