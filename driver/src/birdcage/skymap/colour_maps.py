"""Colours of a scale from low to high: also where red and green look alike, on a screen at night, and without colour.

Each is a path through Oklab whose lightness rises steadily, so that higher is lighter for every eye and in print.
Formulas: B. Ottosson, *A perceptual color space for image processing* (2020), which he gave to the public domain.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import cache, partial

RGB = tuple[int, int, int]
OKLAB = tuple[float, float, float]
STEPS = 255
"""A level is one of so many and one."""
_PATHS: Mapping[str, Sequence[OKLAB]] = {
    "blue-yellow": (
        (0.22, -0.004, -0.085), (0.36, -0.010, -0.095), (0.50, -0.006, -0.040), (0.64, -0.004, 0.020),
        (0.78, -0.010, 0.085), (0.92, -0.025, 0.150),
    ),
    "violet-yellow": (
        (0.24, 0.065, -0.075), (0.38, 0.020, -0.110), (0.52, -0.050, -0.055), (0.66, -0.100, 0.010),
        (0.80, -0.120, 0.120), (0.94, -0.045, 0.175),
    ),
    "red": ((0.15, 0.055, 0.030), (0.33, 0.125, 0.068), (0.50, 0.185, 0.100), (0.66, 0.190, 0.105)),
    "grey": ((0.20, 0.0, 0.0), (0.97, 0.0, 0.0)),
}  # fmt: skip
"""Points at equal steps of the level: lightness, green to red, blue to yellow."""


@cache
def _colour(path: str, step: int) -> RGB:
    points = _PATHS[path]
    at = step / STEPS * (len(points) - 1)
    left = min(int(at), len(points) - 2)
    lightness, a, b = (
        low + (high - low) * (at - left) for low, high in zip(points[left], points[left + 1], strict=True)
    )
    long = (lightness + 0.3963377774 * a + 0.2158037573 * b) ** 3
    middle = (lightness - 0.1055613458 * a - 0.0638541728 * b) ** 3
    short = (lightness - 0.0894841775 * a - 1.2914855480 * b) ** 3
    return (
        _channel(4.0767416621 * long - 3.3077115913 * middle + 0.2309699292 * short),
        _channel(-1.2684380046 * long + 2.6097574011 * middle - 0.3413193965 * short),
        _channel(-0.0041960863 * long - 0.7034186147 * middle + 1.7076147010 * short),
    )


def _channel(linear: float) -> int:
    """Return a channel of sRGB, 0 to 255 (IEC 61966-2-1)."""
    inside = min(max(linear, 0.0), 1.0)
    return round(255.0 * (12.92 * inside if inside <= 0.0031308 else 1.055 * inside ** (1 / 2.4) - 0.055))


def _at(path: str, level: float) -> RGB:
    return _colour(path, round(min(max(level, 0.0), 1.0) * STEPS))


COLOUR_MAPS: Mapping[str, Callable[[float], RGB]] = {name: partial(_at, name) for name in _PATHS}
"""By name: what returns the colour, red, green and blue of 0 to 255, of a level from 0 to 1; beyond that the end's."""
USUAL = "blue-yellow"
"""Looks nearly alike to those who confuse red and green."""
