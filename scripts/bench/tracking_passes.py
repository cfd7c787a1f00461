"""Real passes to follow: of the element sets that ship, over six places. And hard ones by name."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from datetime import UTC, datetime, timedelta

import numpy as np
from birdcage.sky.elements import ElementSet
from birdcage.sky.frozen import frozen
from birdcage.sky.observer import Observer
from birdcage.sky.passes.model import Pass
from birdcage.sky.passes.search import search
from birdcage.sky.propagate import Fleet, track

PLACES = (
    Observer(40.0, -105.0, 1650.0, "Boulder"),
    Observer(47.0, 8.0, 500.0, "Zug"),
    Observer(60.2, 24.9, 20.0, "Helsinki"),
    Observer(-33.9, 151.2, 40.0, "Sydney"),
    Observer(1.3, 103.8, 20.0, "Singapore"),
    Observer(64.1, -21.9, 30.0, "Reykjavik"),
)
DAYS = datetime(2018, 1, 21, 12, tzinfo=UTC), datetime(2026, 9, 20, 14, tzinfo=UTC)
"""When most of the elements are fresh, and when those of the ISS are."""
HOURS = 72.0
LOW_REV_DAY = 11.0
LEAST_EL_DEG = 25.0
EVERY_S = 0.5


@dataclass(frozen=True)
class Case:
    """One pass over one place."""

    satellite: ElementSet
    observer: Observer
    passing: Pass
    name: str = ""

    @property
    def label(self) -> str:
        return self.name or f"{self.passing.name[:12]} {self.passing.max_elevation_deg:.0f}° {self.observer.name}"

    def track(self, times: np.ndarray, late_s: float = 0.0) -> tuple[np.ndarray, np.ndarray]:
        """Return azimuth, unrolled, and elevation."""
        seen = track(self.satellite, self.observer, times, late_s)
        return np.degrees(np.unwrap(np.radians(seen.az_deg))), seen.el_deg

    def times(self) -> np.ndarray:
        return np.arange(self.passing.aos.timestamp(), self.passing.los.timestamp(), EVERY_S)


def everything() -> list[Case]:
    """Return every pass above 25 degrees of the low satellites that ship, in a fixed order."""
    cases = []
    low = [each for each in frozen() if each.mean_motion_rev_day > LOW_REV_DAY]
    for day in DAYS:
        fleet = Fleet([each for each in low if abs(each.epoch - day) < timedelta(days=10)])
        for place in PLACES:
            table = search(fleet, place, day, HOURS)
            for index, passing in enumerate(table):
                if passing.max_elevation_deg > LEAST_EL_DEG and not (passing.already_up or passing.still_up):
                    cases.append(Case(fleet[int(table.fleet_index[index])], place, passing))
    return cases


def spread(cases: list[Case], count: int) -> list[Case]:
    """Return so many of them, evenly chosen: all satellites and places have their share."""
    return [cases[int((index + 0.5) * len(cases) / count)] for index in range(count)]


def named(cases: list[Case], fits: Callable[[Case], bool], low_el: float, high_el: float) -> list[Case]:
    """Return the hard ones: nearly overhead at 86 and 89 degrees, across north, and one that fits no turn.

    `fits`: whether some turn of the cable serves a pass.
    """

    def first(name: str, test: Callable[[Case], bool]) -> Case:
        case = next(case for case in cases if test(case))
        return Case(case.satellite, case.observer, case.passing, name)

    def north(case: Case) -> bool:
        az, el = case.track(case.times())
        az = az[(el > low_el) & (el < high_el)] % 360.0
        crosses = len(az) > 0 and bool(np.any(np.abs(np.diff(az)) > 180.0))
        return crosses and fits(case) and case.passing.max_elevation_deg < 60.0

    return [
        first("86 degrees", lambda case: 85.5 < case.passing.max_elevation_deg < 86.7 and fits(case)),
        first("89 degrees", lambda case: case.passing.max_elevation_deg > 88.5 and fits(case)),
        first("north crossing", north),
        first("fits no turn", lambda case: not fits(case)),
    ]
