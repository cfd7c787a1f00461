"""UT1 - UTC: how far the turning Earth is from the clock, out of a small table that ships with birdcage.

The table holds the IERS values for the first of each month, the last year of them predicted (`scripts/cut_dut1.py`).
Between two firsts it is interpolated, to 7 ms (against IERS C04, 1973 to 2026): under two arcseconds for a
satellite overhead at 400 km, a tenth of an arcsecond for a star.
"""

from __future__ import annotations

from bisect import bisect_right
from dataclasses import dataclass
from datetime import UTC, datetime
from functools import cache
from importlib.resources import files
from itertools import accumulate, pairwise

LIMIT_S = 0.9
"""UTC is kept this near to UT1 (ITU-R TF.460); 0.045 degrees for a satellite overhead at 400 km."""

LEAP_S = 0.5
"""A change of more than this from one month to the next is a leap second at the end of the first."""


@dataclass(frozen=True, slots=True)
class Table:
    """UT1 - UTC at the firsts of months."""

    starts_s: tuple[float, ...]
    """The firsts, in POSIX seconds."""
    smooth_s: tuple[float, ...]
    """UT1 - UTC without leap seconds, which can be interpolated."""
    leaps_s: tuple[float, ...]
    """The leap seconds since the first month, to be added."""


def dut1_s(when: datetime) -> float:
    """Return UT1 - UTC in seconds. Before 1973 and after the table ends, its first and last value.

    `when` is aware; ValueError otherwise. For arrays of times there is `frames.dut1_at`.
    """
    if when.tzinfo is None:
        raise ValueError("the time must say its zone")
    t_s, known = when.timestamp(), table()
    month = bisect_right(known.starts_s, t_s) - 1
    if month < 0:
        return known.smooth_s[0]
    if month == len(known.starts_s) - 1:
        return known.smooth_s[-1] + known.leaps_s[-1]
    begin, end = known.starts_s[month : month + 2]
    before, after = known.smooth_s[month : month + 2]
    return before + (after - before) * (t_s - begin) / (end - begin) + known.leaps_s[month]


def table_end() -> datetime:
    """Return the last month that the table knows, as its first day: from there on the last value is held."""
    return datetime.fromtimestamp(table().starts_s[-1], UTC)


@cache
def table() -> Table:
    """Return the table that ships with birdcage."""
    text = (files("birdcage.sky") / "data" / "dut1.txt").read_text(encoding="ascii")
    rows = [line.split() for line in text.splitlines() if not line.startswith("#")]
    values = [float(value) for row in rows for value in row[1:]]
    first = int(rows[0][0])
    starts = (datetime(first + n // 12, n % 12 + 1, 1, tzinfo=UTC).timestamp() for n in range(len(values)))
    leaps = tuple(accumulate((float(b - a > LEAP_S) for a, b in pairwise(values)), initial=0.0))
    return Table(tuple(starts), tuple(value - leap for value, leap in zip(values, leaps, strict=True)), leaps)
