"""A direction over time, dense enough that a cubic between its points is as good as the truth."""

from __future__ import annotations

from bisect import bisect_right
from dataclasses import dataclass
from functools import cached_property
from typing import TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Curve:
    """Azimuth and elevation in degrees at rising times, in POSIX seconds; azimuth is unrolled, beyond 0..360."""

    t_s: Floats
    az_deg: Floats
    el_deg: Floats

    def __post_init__(self) -> None:
        if len(self.t_s) < 2 or not len(self.t_s) == len(self.az_deg) == len(self.el_deg):
            raise ValueError("a curve has two points at least, and three arrays of one length")

    @property
    def start_s(self) -> float:
        """The first time."""
        return float(self.t_s[0])

    @property
    def end_s(self) -> float:
        """The last time."""
        return float(self.t_s[-1])

    @cached_property
    def _slopes(self) -> tuple[Floats, Floats]:
        return np.gradient(self.az_deg, self.t_s), np.gradient(self.el_deg, self.t_s)

    @cached_property
    def _times(self) -> list[float]:
        # Floats of Python's own: one look-up at a time is what a controller makes, a few hundred for a decision.
        times: list[float] = self.t_s.tolist()
        return times

    @cached_property
    def _points(self) -> list[tuple[float, float, float, float]]:
        slopes = self._slopes
        return list(
            zip(self.az_deg.tolist(), self.el_deg.tolist(), slopes[0].tolist(), slopes[1].tolist(), strict=True)
        )

    def at(self, t_s: float) -> tuple[float, float]:
        """Return azimuth and elevation at a time; before the first and after the last one those of that end."""
        times = self._times
        if t_s <= times[0]:
            return self._points[0][:2]
        if t_s >= times[-1]:
            return self._points[-1][:2]
        index = bisect_right(times, t_s) - 1
        step = times[index + 1] - times[index]
        a, b = self._points[index], self._points[index + 1]
        u = (t_s - times[index]) / step
        return _hermite(a[0], b[0], a[2] * step, b[2] * step, u), _hermite(a[1], b[1], a[3] * step, b[3] * step, u)

    def sample(self, times: ArrayLike) -> tuple[Floats, Floats]:
        """Return azimuths and elevations at many times, as `at`."""
        t = np.clip(np.asarray(times, dtype=np.float64), self.t_s[0], self.t_s[-1])
        index = np.clip(np.searchsorted(self.t_s, t, side="right") - 1, 0, len(self.t_s) - 2)
        step = self.t_s[index + 1] - self.t_s[index]
        u = (t - self.t_s[index]) / step
        az, el = (
            _hermite(y[index], y[index + 1], m[index] * step, m[index + 1] * step, u)
            for y, m in zip((self.az_deg, self.el_deg), self._slopes, strict=True)
        )
        return az, el


_Number = TypeVar("_Number", float, Floats)


def _hermite(a: _Number, b: _Number, slope_a: _Number, slope_b: _Number, u: _Number) -> _Number:
    """Return the cubic with these ends and slopes (per step) at `u` in 0..1."""
    v = 1.0 - u
    return v * v * (a * (1.0 + 2.0 * u) + slope_a * u) + u * u * (b * (1.0 + 2.0 * v) - slope_b * v)
