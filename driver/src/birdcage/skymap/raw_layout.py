"""Which direction each number of a sky-scan matrix belongs to. Formats: `docs/reference/sky-scans.md`."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

KVH, TAILGATER, CARRYOUT = 4, 5, 8
"""How many numbers the settings have."""
STEPS_OF_LEVEL, STEPS_A_DEGREE = 400.0, 17.0
"""Elevation of the JCM fork: motor steps, 400 + 17 a degree."""
NUDGES_AZ, NUDGES_EL = 5, (3, 5)
"""Of the high resolution of the Tailgater's program, a degree."""
TURN = 360
COUNTS_CCW = "Azimuth is as the dish counted it: a Tailgater counts counterclockwise."
READS_EARLY = "These programs read before the dish is there: every other row may be shifted by some degrees."


@dataclass(frozen=True)
class MatrixLayout:
    """The grid of a matrix: which of its lines and columns hold it, from the lowest angle up."""

    x: tuple[float, float, float]
    """Lowest and highest azimuth, and the step between columns, in degrees."""
    y: tuple[float, float, float]
    rows: Sequence[int]
    columns: Sequence[int]
    label: str
    decibels: bool = False
    settings: Mapping[str, str] = field(default_factory=dict)
    notes: tuple[str, ...] = ()


def layout_of(settings: Sequence[float], values: NDArray[np.float64]) -> MatrixLayout:
    """Return the layout of a matrix by the numbers of its settings. ValueError, with a sentence, where none fits."""
    if len(settings) not in (KVH, TAILGATER, CARRYOUT):
        raise ValueError(f"the settings hold {len(settings)} numbers, and 4, 5 or 8 are known.")
    if settings[1] < settings[0] or settings[3] < settings[2]:
        raise ValueError("the settings name a region that ends before it begins.")
    if len(settings) == KVH:
        return _kvh(settings, values)
    return _carryout(settings, values) if len(settings) == CARRYOUT else _tailgater(settings, values)


def _whole(settings: Sequence[float]) -> list[int]:
    if any(each != round(each) or abs(each) > 1e5 for each in settings[:4]):
        raise ValueError("the region in the settings is not in whole numbers.")
    return [round(each) for each in settings[:4]]


def _check_shape(values: NDArray[np.float64], rows: int, columns: int, region: str) -> None:
    if values.shape != (rows, columns):
        told = f"{values.shape[0]} lines of {values.shape[1]} numbers"
        raise ValueError(f"{told}, and {region} makes {rows} of {columns}.")


def _tailgater(settings: Sequence[float], values: NDArray[np.float64]) -> MatrixLayout:
    """Columns from the highest azimuth down, lines from the highest elevation down."""
    az, az_end, el, el_end = _whole(settings)
    label, across = "Tailgater dish_scan", az_end - az
    low, high = float(el), float(el_end)
    up = el_end - el
    if el_end > 90:
        low, high = ((each - STEPS_OF_LEVEL) / STEPS_A_DEGREE for each in (el, el_end))
        label, up = "Microwave-Imager dish_scan", math.floor(high - low)
    rows, columns = values.shape
    fine = [(NUDGES_AZ, each) for each in NUDGES_EL] if settings[4] == 2 else []
    for right, above in ((1, 1), *fine):
        if (rows, columns) == (above * up + 1, right * across + 1):
            break
    else:
        _check_shape(values, up + 1, across + 1, f"az {az} to {az_end}, el {low:g} to {high:g}")
    return MatrixLayout(
        (float(az), float(az_end), 1.0 / right), (low, low + up, 1.0 / above), range(rows - 1, -1, -1),
        range(columns - 1, -1, -1), label, notes=(COUNTS_CCW,),
    )  # fmt: skip


def _carryout(settings: Sequence[float], values: NDArray[np.float64]) -> MatrixLayout:
    """Columns from the lowest azimuth up: the last is one below the end in the settings, the first is never filled.

    Azimuth beyond a whole turn, which dd_scan adds on both sides, is left out.
    """
    az, az_end, el, el_end = _whole(settings)
    _check_shape(values, el_end - el + 1, az_end - az + 1, f"az {az} to {az_end}, el {el} to {el_end}")
    filled = list(range(1, values.shape[1]))
    if not filled:
        raise ValueError("the settings name no azimuth.")
    beyond = max(len(filled) - 1 - TURN, 0)
    filled = filled[beyond // 2 : len(filled) - (beyond - beyond // 2)]
    notes = (READS_EARLY, *((f"{beyond} columns beyond a whole turn are left out.",) if beyond else ()))
    names = ("freq_hz", "bias_tee", "gain_db")
    tuned = dict(zip(names, (settings[5] * 1e6, *settings[6:]), strict=True))
    return MatrixLayout(
        (float(az + filled[0] - 1), float(az + filled[-1] - 1), 1.0), (float(el), float(el_end), 1.0),
        range(values.shape[0] - 1, -1, -1), filled, "carryout_scan or dd_scan", decibels=True, notes=notes,
        settings={name: f"{value:.12g}" for name, value in tuned.items() if name == "freq_hz" or value >= 0.0},
    )  # fmt: skip


def _kvh(settings: Sequence[float], values: NDArray[np.float64]) -> MatrixLayout:
    """As the Tailgater's, in tenths of a degree. Only what the dish went to is filled: one in ten of each, usually."""
    import numpy as np

    az, az_end, el, el_end = _whole(settings)
    _check_shape(values, el_end - el + 1, az_end - az + 1, f"az {az} to {az_end}, el {el} to {el_end} tenths")
    lines, places = (np.flatnonzero(np.any(values != 0.0, axis=axis)) for axis in (1, 0))
    if not len(lines):
        raise ValueError("every number is 0, so that nothing was measured.")
    right, above = (math.gcd(*(int(each) for each in np.diff(filled))) for filled in (places, lines))
    right, above = right or above or 1, above or right or 1
    columns = range(int(places[-1]), int(places[0]) - 1, -right)
    rows = range(int(lines[-1]), int(lines[0]) - 1, -above)
    return MatrixLayout(
        ((az_end - columns[0]) / 10.0, (az_end - columns[-1]) / 10.0, right / 10.0),
        ((el_end - rows[0]) / 10.0, (el_end - rows[-1]) / 10.0, above / 10.0), rows, columns, "TracVision scan",
    )  # fmt: skip
