"""UT1 - UTC: how far the turning Earth is from the clock, out of a small table that ships with birdcage.

The table holds the IERS values for the first of each month, the last year of them predicted (`scripts/cut_dut1.py`).
Between two firsts it is interpolated, to 3 ms; a satellite overhead at 400 km moves 0.01 arcseconds on that.
"""

from __future__ import annotations

from datetime import UTC, datetime
from functools import cache
from importlib.resources import files

LIMIT_S = 0.9
"""UTC is kept this near to UT1 (ITU-R TF.460); 0.045 degrees for a satellite overhead at 400 km."""

_LEAP_S = 0.5
"""A change of more than this within a month is a leap second at the end of it."""


def dut1_s(when: datetime) -> float:
    """Return UT1 - UTC in seconds. Before 1973 and after the table ends, its first and last value.

    `when` is aware; ValueError otherwise.
    """
    if when.tzinfo is None:
        raise ValueError("the time must say its zone")
    when = when.astimezone(UTC)
    first_year, values = _table()
    month = (when.year - first_year) * 12 + when.month - 1
    if month < 0:
        return values[0]
    if month >= len(values) - 1:
        return values[-1]
    begin = datetime(when.year, when.month, 1, tzinfo=UTC)
    end = datetime(when.year + when.month // 12, when.month % 12 + 1, 1, tzinfo=UTC)
    before, after = values[month], values[month + 1]
    if after - before > _LEAP_S:
        after -= 1.0  # leap seconds fall on the last second of a month
    return before + (after - before) * ((when - begin) / (end - begin))


def table_end() -> datetime:
    """Return the last month that the table knows, as its first day: from there on the last value is held."""
    first_year, values = _table()
    year, month = divmod(len(values) - 1, 12)
    return datetime(first_year + year, month + 1, 1, tzinfo=UTC)


@cache
def _table() -> tuple[int, tuple[float, ...]]:
    """Return the first year, and the value of each month from January of it."""
    text = (files("birdcage.sky") / "data" / "dut1.txt").read_text(encoding="ascii")
    rows = [line.split() for line in text.splitlines() if not line.startswith("#")]
    return int(rows[0][0]), tuple(float(value) for row in rows for value in row[1:])
