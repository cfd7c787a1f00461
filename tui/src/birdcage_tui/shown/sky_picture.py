"""What the pages show of the sky: plain values, made off the app's thread (`sky_feed`) and never changed.

Times are POSIX seconds (UTC), angles true degrees. What is not known is None.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cached_property
from itertools import pairwise
from typing import TYPE_CHECKING

from birdcage.base.geometry import separation, shortest_turn
from birdcage.sky.horizon import HorizonMask

if TYPE_CHECKING:
    from birdcage.sky.pass_row import PassRow
    from birdcage.sky.reach_model import PassReach

DEMO = "DEMO "
"""What the names of a demo's satellites begin with."""
GRADE_INKS = {"fresh": "good", "usable": "text", "doubtful": "warn", "useless": "fault"}


@dataclass(frozen=True, slots=True)
class Path:
    """Where a satellite stands over a pass: samples in order of time."""

    t_s: tuple[float, ...]
    az_deg: tuple[float, ...]
    el_deg: tuple[float, ...]
    range_km: tuple[float, ...] = ()
    rate_km_s: tuple[float, ...] = ()
    """How fast the range grows."""

    def at(self, t_s: float) -> tuple[float, float] | None:
        """Return azimuth and elevation at a time; None outside the pass."""
        if not self.t_s or not self.t_s[0] <= t_s <= self.t_s[-1]:
            return None
        index = min(bisect_right(self.t_s, t_s), len(self.t_s) - 1)
        before = max(index - 1, 0)
        span = self.t_s[index] - self.t_s[before]
        share = 0.0 if span <= 0 else (t_s - self.t_s[before]) / span
        turn = shortest_turn(self.az_deg[before], self.az_deg[index])
        rise = self.el_deg[index] - self.el_deg[before]
        return (self.az_deg[before] + turn * share) % 360.0, self.el_deg[before] + rise * share

    def distance(self, t_s: float) -> tuple[float, float] | None:
        """Return range in km and its rate in km/s at a time; None outside the pass, or where it is not known."""
        if not self.range_km or not self.t_s[0] <= t_s <= self.t_s[-1]:
            return None
        index = min(max(bisect_right(self.t_s, t_s), 1), len(self.t_s) - 1)
        begin, end = index - 1, index
        span = self.t_s[end] - self.t_s[begin]
        share = 0.0 if span <= 0 else (t_s - self.t_s[begin]) / span
        # The cubic through both ends with both rates: straight lines would be kilometres off.
        here, there = self.range_km[begin], self.range_km[end]
        pull, push = self.rate_km_s[begin] * span, self.rate_km_s[end] * span
        rest = 1.0 - share
        range_km = here * (1 + 2 * share) * rest**2 + there * (1 + 2 * rest) * share**2
        range_km += pull * share * rest**2 - push * rest * share**2
        return range_km, self.rate_km_s[begin] * rest + self.rate_km_s[end] * share

    def fastest_deg_s(self) -> float | None:
        """Return the greatest angular rate of the pass; None if there is no path."""
        places = list(zip(self.t_s, self.az_deg, self.el_deg, strict=True))
        rates = [
            separation(*before[1:], *after[1:]) / (after[0] - before[0])
            for before, after in pairwise(places) if after[0] - before[0] > 1e-3
        ]  # fmt: skip
        return max(rates, default=None)


@dataclass(frozen=True, slots=True)
class Age:
    """How much the elements may be trusted for a pass."""

    words: str
    """`6 h old, about ±0.05° (90 %: 0.20°) at closest`."""
    short: str
    """`6 h`, `re-entered?`."""
    glyph: str
    ink: str
    useless: bool = False
    """Whether no dish finds the satellite by them."""


@dataclass(frozen=True, slots=True)
class DopplerFrequency:
    """What Doppler is told for."""

    hz: float
    what: str
    """`its LRPT`, `middle of feed`."""
    signal: tuple[str, ...] = ()
    """What is sent there, SatDump's name for it, and how sure that is; empty if nothing is known to be sent."""


@dataclass(frozen=True, eq=False)
class ShownPass:
    """A pass as the pages show it: what the driver found of it, and what the app adds.

    Each is itself alone: after a search the same objects stand for what is the same. Lists of thousands are sorted and
    painted, so that what is worked out is kept.
    """

    found: PassRow
    favourite: bool
    """As it is marked here: the driver may not know yet."""
    groups: tuple[str, ...]
    hears: str | None
    """What the feed in use hears of it, in words; empty: nothing that is known; None: unknown."""
    age: Age
    tuned: Callable[[], DopplerFrequency | None] = field(repr=False)
    """Finds the frequency to tell Doppler for; None if there is none."""
    also: tuple[str, ...] = field(repr=False)
    """What else the satellite is called."""
    trace: Callable[[], Path] = field(repr=False)
    """Works out `path`."""

    @cached_property
    def name(self) -> str:
        """The satellite's name without the mark of a demo, which stands in row 1."""
        return self.found.passing.name.removeprefix(DEMO)

    @property
    def norad_id(self) -> int:
        """Its catalogue number, 0 if it has none."""
        return self.found.passing.norad_id

    @cached_property
    def aos_s(self) -> float:
        """When it rises; where `already_up`, when the search began."""
        return self.found.passing.aos.timestamp()

    @cached_property
    def tca_s(self) -> float:
        """When it is highest."""
        return self.found.passing.tca.timestamp()

    @cached_property
    def los_s(self) -> float:
        """When it sets; where `still_up`, when the search ended."""
        return self.found.passing.los.timestamp()

    @property
    def aos_az_deg(self) -> float:
        """Azimuth at AOS."""
        return self.found.passing.aos_azimuth_deg

    @property
    def tca_az_deg(self) -> float:
        """Azimuth at TCA."""
        return self.found.passing.tca_azimuth_deg

    @property
    def los_az_deg(self) -> float:
        """Azimuth at LOS."""
        return self.found.passing.los_azimuth_deg

    @property
    def max_el_deg(self) -> float:
        """Elevation at TCA."""
        return self.found.passing.max_elevation_deg

    @property
    def already_up(self) -> bool:
        """Whether it was up when the search began."""
        return self.found.passing.already_up

    @property
    def still_up(self) -> bool:
        """Whether it was up when the search ended."""
        return self.found.passing.still_up

    @property
    def reach(self) -> PassReach:
        """What of it this dish can follow."""
        return self.found.reach

    @cached_property
    def reach_s(self) -> float:
        """How long it is in reach."""
        return self.reach.total_s

    @cached_property
    def path(self) -> Path:
        """Where it goes: some tenths of a millisecond the first time, and only the passes that are seen need one."""
        return self.trace()

    @property
    def key(self) -> tuple[int, str, int]:
        """The same for the same pass after another search: times move by seconds then, not by half a minute."""
        return self.norad_id, self.name, round(self.tca_s / 60.0)

    @property
    def stays(self) -> bool:
        """Whether it is up all the time, as far as the search went: that is no pass."""
        return self.already_up and self.still_up

    def events(self) -> list[tuple[float, str]]:
        """Return when something begins or ends, in order: `AOS`, `reach` (begins), `out` (of reach), `LOS`.

        Where reach begins or ends with the pass it is one event, and the one of the pass is told.
        """
        found = [] if self.still_up else [(self.los_s, "LOS")]
        if not self.already_up:
            found.append((self.aos_s, "AOS"))
        for one in self.reach.intervals:
            if one.start_s - self.aos_s > 1.0:
                found.append((one.start_s, "reach"))
            if self.los_s - one.end_s > 1.0:
                found.append((one.end_s, "out"))
        return sorted(found)

    def next_event(self, t_s: float) -> tuple[float, str] | None:
        """Return what comes next: of reach if there is any to come, else AOS or LOS.

        None once it is over, and for what was up when the search ended: nothing later was searched.
        """
        for one in self.reach.intervals:
            if t_s < one.start_s:
                return one.start_s, "reach"
            if t_s < one.end_s:
                return None if self.still_up and self.los_s - one.end_s <= 1.0 else (one.end_s, "out")
        if t_s < self.aos_s and not self.already_up:
            return self.aos_s, "AOS"
        return (self.los_s, "LOS") if t_s < self.los_s and not self.still_up else None


@dataclass(frozen=True, slots=True)
class Up:
    """A satellite above the horizon."""

    name: str
    norad_id: int
    az_deg: float
    el_deg: float
    favourite: bool = False
    fixed: bool = False
    """It stands where it is: geostationary, and named on the arc already."""
    old: bool = False
    """Its elements are those that ship, or too old to say where it stands."""
    trail: tuple[tuple[float, float], ...] = ()
    """Where it was since it is watched: azimuth and elevation, some tenths of a degree apart, the newest last."""


@dataclass(frozen=True, slots=True)
class SkyPicture:
    """Everything that is known of the sky at one moment."""

    t_s: float
    """When the satellites stand where `up` says."""
    up: tuple[Up, ...] = ()
    sun: tuple[float, float] | None = None
    """Azimuth and elevation; below the horizon too."""
    moon: tuple[float, float] | None = None
    rows: tuple[ShownPass, ...] = ()
    """Passes in order of AOS."""
    searched: float | None = None
    """The part of the search that is done, 0 to 1; None before it began."""
    until_s: float | None = None
    """Up to when passes are searched."""
    satellites: int = 0
    """In the catalogue."""
    source: str = ""
    """What the elements are, in a few words: `demo orbits`, `elements that ship`; empty for the user's own."""
    note: str = ""
    """What has to be said of the elements: that no dish finds a satellite by them, and why these; else empty."""
    mask: HorizonMask | None = None
    """What hides the sky all around; None for a flat horizon."""
    feed: str = ""
    """The feed that `ShownPass.hears` is told for; empty while nothing is known of what it hears."""
    hear_first: bool = False
    """Whether a list begins with what that feed hears: the user has said which one is mounted."""
    problem: str = ""
    """Why there is no sky, or not all of it, as a sentence with what to do."""
