"""The passes that autotrack chooses from, and how long a dish takes between two of them."""

from __future__ import annotations

from datetime import datetime, timedelta
from functools import partial
from typing import TYPE_CHECKING

from birdcage.pursuit.schedule_model import Direction, ScheduleCandidate, Slew

if TYPE_CHECKING:
    from pathlib import Path

    from birdcage.sky.observer import Observer
    from birdcage.sky.reach_limits import ReachLimits
    from birdcage.sky.targets.model import Satellite
    from birdcage.sky.watch_source import Watched

BEFORE = timedelta(minutes=30)
"""How far back is looked, so that a pass under way has its true beginning."""
A_DAY_H = 24.0
SETTLE_S = 2.0
"""What a move takes beside its way: starting, stopping, the wire."""
UNKNOWN_SLEW_S = 60.0
"""Taken for a dish whose speed is not known: half a turn of the slowest one."""


def find_candidates(
    watched: Watched, observer: Observer, limits: ReachLimits, now: datetime, hours: float,
    downlinks: Path | None = None,
) -> list[ScheduleCandidate]:  # fmt: skip
    """Return every pass of the favourites among some satellites that is not over, also those that are never in reach.

    They reach a day ahead at least: `schedule` takes those of the hours that it is given. What stays up all the time,
    like a geostationary satellite, does not pass. About a millisecond a pass.
    """
    import numpy as np

    from birdcage.sky.downlinks_read import load_downlinks
    from birdcage.sky.pass_row import rows_of
    from birdcage.sky.passes.search import search
    from birdcage.sky.propagate import Fleet
    from birdcage.sky.targets import Resolver
    from birdcage.sky.targets.model import Satellite

    chosen = watched.part(sorted(watched.favourites))
    if not chosen.elements:
        return []
    resolver = Resolver(None, load_downlinks(downlinks))
    # Over a shorter time a long pass would look like something that stays up.
    begin, span = now - BEFORE, max(hours, A_DAY_H) + 2.0 * BEFORE / timedelta(hours=1)
    table = search(Fleet(chosen.elements), observer, begin, span, 0.0, chosen.time_offsets)
    which = np.flatnonzero((table.los_s > now.timestamp()) & ~(table.already_up & table.still_up))
    return [
        ScheduleCandidate(
            row.passing,
            row.reach,
            row.priority,
            partial(_where, Satellite(row.elements, row.time_offset_s), observer),
            resolver.silence_brief(row.elements.norad_id, row.elements.name),
        )
        for row in rows_of(table, chosen, observer, limits, which.tolist())
    ]


def slewing(limits: ReachLimits) -> Slew | float:
    """Return how long a dish with these limits takes from one direction to another, both axes one after the other.

    Where a cable winds up it takes the longer way round: nothing is promised that holds for the short way only.
    """
    az_rate, el_rate, cable = limits.az_rate_deg_s, limits.el_rate_deg_s, limits.cable
    if not az_rate or not el_rate:
        return UNKNOWN_SLEW_S

    def slew_s(start: Direction, end: Direction) -> float:
        az_deg = abs((end.az_deg - start.az_deg + 180.0) % 360.0 - 180.0)
        if cable is not None:
            az_deg = 360.0 - az_deg
        return az_deg / az_rate + abs(end.el_deg - start.el_deg) / el_rate + SETTLE_S

    return slew_s


def _where(satellite: Satellite, observer: Observer, when: datetime) -> Direction:
    look = satellite.look(observer, when)
    return Direction(look.az_deg, look.el_deg)
