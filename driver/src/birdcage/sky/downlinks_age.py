"""How far an entry of the downlinks can be trusted today: by the date that its source speaks of.

Satellites fail, move and change their frequencies. An entry is *doubtful* unless a source says that it was on the air,
and that within the last three years; what fell silent stays silent, however long ago that was written down.
"""

from __future__ import annotations

from datetime import UTC, date, datetime
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from birdcage.sky.downlinks import Downlink

DOUBTFUL_DAYS = 3 * 365
"""Older than this, that something is on the air is hearsay: a small satellite serves two to five years, and television
moves its satellites about as often. A choice, not a measurement."""


def age_days(downlink: Downlink, now: datetime) -> int | None:
    """Return how old what is told of it is, counted from the end of the day, month or year named; None without a date.

    Never below 0: a year that goes on is not yet old.
    """
    if not downlink.date:
        return None
    year, month, day = (*map(int, downlink.date.split("-")), 0, 0)[:3]
    if not month:
        spoken_of = date(year, 12, 31)
    elif not day:
        spoken_of = date(year + month // 12, month % 12 + 1, 1)
    else:
        spoken_of = date(year, month, day)
    return max((now.astimezone(UTC).date() - spoken_of).days, 0)


def is_doubtful(downlink: Downlink, now: datetime) -> bool:
    """Return whether no source says that it is on the air today, nor that it is not.

    The user's own entry counts until it says so of itself or grows old: who wrote it knows.
    """
    if downlink.alive is False:
        return False
    days = age_days(downlink, now)
    if downlink.alive is None or days is None:
        return not downlink.own
    return days > DOUBTFUL_DAYS
