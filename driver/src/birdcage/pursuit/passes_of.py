"""The next passes of one satellite, and which of them is meant."""

from __future__ import annotations

from collections.abc import Sequence
from datetime import datetime, timedelta
from typing import TYPE_CHECKING

from birdcage.sky.pass_row import PassRow

if TYPE_CHECKING:
    from birdcage.sky.elements import ElementSet
    from birdcage.sky.observer import Observer
    from birdcage.sky.reach_limits import ReachLimits

HOURS = (24.0, 48.0)
"""How far ahead is looked; the second one if there is nothing within the first."""
MOST = 18
"""Rows that are worked out, each in a millisecond: a low orbit has up to 16 passes a day, and any may be picked."""
SAME_S = 120.0
"""As near as this two times of AOS are one pass: other elements or another offset have moved it."""
BEFORE = timedelta(minutes=30)
"""A pass that is under way shall be found whole: none of a low orbit lasts longer."""


def next_passes(
    elements: ElementSet, observer: Observer, limits: ReachLimits, now: datetime, *, time_offset_s: float = 0.0,
    favourite: bool = False, priority: int = 0,
) -> tuple[PassRow, ...]:  # fmt: skip
    """Return the next passes that are not over, in order; none for a satellite that stays up, or never rises."""
    import numpy as np

    from birdcage.sky.pass_row import rows_of
    from birdcage.sky.passes.search import search
    from birdcage.sky.propagate import Fleet
    from birdcage.sky.watch_source import Watched

    watched = Watched(
        (elements,), favourites=frozenset({0} if favourite else ()), priorities={0: priority},
        time_offsets={0: time_offset_s},
    )  # fmt: skip
    begin = now - BEFORE
    for hours in HOURS:
        table = search(Fleet(watched.elements), observer, begin, hours, 0.0, watched.time_offsets)
        comes = (table.los_s > now.timestamp()) & ~(table.already_up & table.still_up)
        which = np.flatnonzero(comes)[:MOST]
        if len(which):
            return tuple(rows_of(table, watched, observer, limits, which.tolist()))
    return ()


def still_followed(row: PassRow, now: datetime) -> bool:
    """Return whether some of its reach is still to come."""
    return any(stretch.end > now for stretch in row.reach.intervals)


def meant(rows: Sequence[PassRow], now: datetime, wanted: datetime | None) -> PassRow | None:
    """Return the pass that goes on at the `wanted` time; else the first that comes into reach, or the first of all."""
    coming = [row for row in rows if row.passing.los > now]
    if wanted is not None:
        early = wanted + timedelta(seconds=SAME_S)
        found = next((row for row in coming if row.passing.aos <= early and wanted < row.passing.los), None)
        if found is not None:
            return found
    return next((row for row in coming if still_followed(row, now)), coming[0] if coming else None)
