"""Where something stands in an observer's sky."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class LookAngle:
    """A direction in true degrees, without refraction, and how far that is. Unknown is None."""

    az_deg: float
    """0 to 360, clockwise from north."""
    el_deg: float
    """Geometric; negative below the horizon."""
    range_km: float | None = None
    range_rate_km_s: float | None = None
    """Positive while it moves away."""


@dataclass(frozen=True, slots=True)
class LookRate:
    """How fast a direction changes, in degrees a second."""

    az_deg_s: float
    """Clockwise is positive. It grows without limit towards the zenith."""
    el_deg_s: float


def rate_between(before: LookAngle, after: LookAngle, seconds: float) -> LookRate:
    """Return the rate from one look to another, `seconds` later; the azimuth goes the short way round."""
    turn_deg = (after.az_deg - before.az_deg + 180.0) % 360.0 - 180.0
    return LookRate(turn_deg / seconds, (after.el_deg - before.el_deg) / seconds)
