"""One line of a list of passes: the pass, what this dish can follow of it, and what else one wants to know of it."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from datetime import datetime
from typing import TYPE_CHECKING

from birdcage.sky.elements import ElementSet
from birdcage.sky.observer import Observer
from birdcage.sky.passes.model import Pass
from birdcage.sky.reach_limits import ReachLimits

if TYPE_CHECKING:
    from birdcage.sky.passes.table import PassTable
    from birdcage.sky.reach_model import PassReach
    from birdcage.sky.sun_crossing import SunApproach
    from birdcage.sky.watch_source import Watched


@dataclass(frozen=True, slots=True)
class Distance:
    """How far away the satellite is, and how that changes."""

    range_km: float
    range_rate_km_s: float
    """Positive for what goes away."""


@dataclass(frozen=True, slots=True)
class NextEvent:
    """What a countdown counts to."""

    name: str
    """`reach` and `reach ends`: this dish; `AOS` and `LOS`: 0 degrees geometric."""
    at: datetime


@dataclass(frozen=True, slots=True)
class PassRow:
    """A pass as lists show it."""

    passing: Pass
    elements: ElementSet
    reach: PassReach
    sunlit_share: float
    """How much of the pass the Sun shines on the satellite, 0 to 1."""
    sun: SunApproach | None
    """Its nearest approach to the Sun; None if the Sun is down."""
    at_aos: Distance
    at_tca: Distance
    at_los: Distance
    favourite: bool = False
    priority: int = 0
    time_offset_s: float = 0.0
    """How much later than computed the satellite is taken to come."""

    @property
    def epoch_age_s(self) -> float:
        """How old the elements are at TCA; negative for an epoch after it."""
        return (self.passing.tca - self.elements.epoch).total_seconds()

    def next_event(self, now: datetime) -> NextEvent | None:
        """Return what comes next: reach if there is any to come, else AOS or LOS; None once the pass is over."""
        for stretch in self.reach.intervals:
            if now < stretch.start:
                return NextEvent("reach", stretch.start)
            if now < stretch.end:
                return NextEvent("reach ends", stretch.end)
        if now < self.passing.aos:
            return NextEvent("AOS", self.passing.aos)
        return NextEvent("LOS", self.passing.los) if now < self.passing.los else None


def row_of(
    passing: Pass, elements: ElementSet, observer: Observer, limits: ReachLimits, *,
    time_offset_s: float = 0.0, favourite: bool = False, priority: int = 0,
) -> PassRow:  # fmt: skip
    """Work out one row: about a millisecond."""
    import numpy as np

    from birdcage.sky.illumination import sunlit
    from birdcage.sky.propagate import track
    from birdcage.sky.reach import reach, sample_times
    from birdcage.sky.sun_crossing import sun_approach

    path = track(elements, observer, sample_times(passing), time_offset_s)
    lit = sunlit(observer, path.t_s, path.az_deg, path.el_deg, path.range_km)
    weights = np.gradient(path.t_s)
    top = int(np.argmin(np.abs(path.t_s - passing.tca.timestamp())))
    at_aos, at_tca, at_los = (
        Distance(float(path.range_km[index]), float(path.range_rate_km_s[index])) for index in (0, top, -1)
    )
    return PassRow(
        passing, elements, reach(path, limits), float(weights[lit].sum() / weights.sum()), sun_approach(path, observer),
        at_aos, at_tca, at_los, favourite, priority, time_offset_s,
    )  # fmt: skip


def rows_of(
    table: PassTable, watched: Watched, observer: Observer, limits: ReachLimits, which: Iterable[int] | None = None,
) -> Iterator[PassRow]:  # fmt: skip
    """Yield the rows of a table of passes, all or those of some indices; `table.fleet` is of `watched.elements`."""
    for index in range(len(table)) if which is None else which:
        satellite = int(table.fleet_index[index])
        yield row_of(
            table[index], watched.elements[satellite], observer, limits,
            time_offset_s=watched.time_offsets.get(satellite, 0.0), favourite=satellite in watched.favourites,
            priority=watched.priorities.get(satellite, 0),
        )  # fmt: skip


ORDERS: dict[str, Callable[[PassRow], tuple[object, ...]]] = {
    "aos": lambda row: (row.passing.aos,),
    "max": lambda row: (-row.passing.max_elevation_deg, row.passing.aos),
    "reach": lambda row: (-row.reach.total_s, row.passing.aos),
}
"""What a list can be sorted by: rise, highest elevation first, longest reach first."""
