"""UT1 - UTC: how far the turning Earth is from the clock, out of a small table that ships with birdcage.

The table holds the IERS values for the first of each month, the last year of them predicted (`scripts/cut_dut1.py`).
Between two firsts it is interpolated, to 7 ms (against IERS C04, 1973 to 2026): under two arcseconds for a
satellite overhead at 400 km, a tenth of an arcsecond for a star.
"""

from __future__ import annotations

from datetime import UTC, datetime
from functools import cache
from importlib.resources import files

import numpy as np
from numpy.typing import ArrayLike, NDArray

LIMIT_S = 0.9
"""UTC is kept this near to UT1 (ITU-R TF.460); 0.045 degrees for a satellite overhead at 400 km."""

LEAP_S = 0.5
"""A change of more than this from one month to the next is a leap second at the end of the first."""


def dut1_s(when: datetime) -> float:
    """Return UT1 - UTC in seconds. Before 1973 and after the table ends, its first and last value.

    `when` is aware; ValueError otherwise.
    """
    if when.tzinfo is None:
        raise ValueError("the time must say its zone")
    return float(dut1_at(when.timestamp()))


def dut1_at(t_s: ArrayLike) -> NDArray[np.float64]:
    """Return UT1 - UTC in seconds at POSIX seconds, as `dut1_s` does."""
    starts, smooth, leaps = _table()
    month = np.clip(np.searchsorted(starts, t_s, side="right") - 1, 0, len(starts) - 1)
    return np.asarray(np.interp(t_s, starts, smooth) + leaps[month])


def table_end() -> datetime:
    """Return the last month that the table knows, as its first day: from there on the last value is held."""
    return datetime.fromtimestamp(float(_table()[0][-1]), UTC)


@cache
def _table() -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
    """Return the firsts of months in POSIX seconds, UT1 - UTC without leap seconds, and the leap seconds since 1973."""
    text = (files("birdcage.sky") / "data" / "dut1.txt").read_text(encoding="ascii")
    rows = [line.split() for line in text.splitlines() if not line.startswith("#")]
    values = np.array([float(value) for row in rows for value in row[1:]])
    first = int(rows[0][0])
    starts = [datetime(first + n // 12, n % 12 + 1, 1, tzinfo=UTC).timestamp() for n in range(len(values))]
    leaps = np.append(0.0, np.cumsum(np.diff(values) > LEAP_S))
    return np.array(starts), values - leaps, leaps
