"""From what the watch publishes to what panes draw. Passes that are the same as before stay the same objects."""

from __future__ import annotations

from collections.abc import Callable
from datetime import datetime, timedelta
from functools import partial
from typing import TYPE_CHECKING

from birdcage.base.geometry import separation
from birdcage.sky.age import expected_error
from birdcage.sky.age_words import REENTERED
from birdcage.sky.catalogue.entry import key_of
from birdcage.sky.catalogue.words import span
from birdcage.sky.frozen import SOURCE as SHIPPED
from birdcage.sky.horizon import HorizonMask
from birdcage.sky.observer import Observer
from birdcage.sky.sun import sun
from birdcage.sky.watch_model import SkyNow, UpNow

from birdcage_tui.shown.sky_picture import (
    DEMO,
    GRADE_INKS,
    Age,
    DopplerFrequency,
    Path,
    ShownPass,
    SkyPicture,
    Up,
)

if TYPE_CHECKING:
    from birdcage.sky.elements import ElementSet
    from birdcage.sky.pass_row import PassRow
    from birdcage.sky.reach_limits import Horizon

SAMPLES = 72
"""Of a path: closer than a dot of the largest picture, and half of them about the top, where azimuth sweeps."""
AHEAD = timedelta(hours=24)
MOST_OTHERS = 1000
"""With so many passes of satellites that are no favourites the watch lists no later ones (`sky.pass_search_job`)."""
GEO_KM, STILL_KM_S = 34_000.0, 0.02
"""From so far, and as slow as that, a satellite stands still in the sky."""
TRAIL_DEG, TRAIL = 0.4, 24
"""How far apart the points of a trail are, at least, and how many are kept."""


class Converter:
    """Keeps what it made, as long as the watch keeps what that was made of. One thread at a time."""

    def __init__(self) -> None:
        self.favourites: dict[int | str, bool] = {}
        """What was marked here, and the watch does not know yet."""
        self.mask: Horizon | None = None
        self.groups: dict[str, tuple[str, ...]] = {}
        """Groups and tags by key of the catalogue."""
        self.feed, self.hear_first = "", False
        self.hears: Callable[[int, str], str] | None = None
        """What the feed hears of a satellite, by number and name."""
        self.tuned: Callable[[int, str], DopplerFrequency | None] | None = None
        """At which frequency Doppler of a satellite is told, by number and name."""
        self.also: Callable[[int, str], tuple[str, ...]] | None = None
        """What else a satellite is called, by number and name."""
        self._rows: dict[int, ShownPass] = {}
        """By `id` of what the driver found."""
        self._made_of: tuple[object, ...] = ()
        """What `_table` was made of."""
        self._table: tuple[ShownPass, ...] = ()
        self._old: dict[tuple[int, str], tuple[ElementSet, int, bool]] = {}
        """Whether elements are too old, and for which hour since 1970 that was worked out."""
        self._trails: dict[tuple[int, str], tuple[tuple[float, float], ...]] = {}

    def picture(self, sky: SkyNow, moon: tuple[float, float, float] | None, *, demo: bool) -> SkyPicture:
        """Return the picture of one look at the sky."""
        observer, t_s = sky.observer, sky.utc.timestamp()
        if observer is None:
            return SkyPicture(t_s, satellites=sky.satellites, problem=sky.note)
        table = self._rows_of(sky, observer)
        until = t_s + AHEAD.total_seconds()
        others = [row for row in table if not row.favourite]
        if len(others) >= MOST_OTHERS:
            until = min(until, others[-1].aos_s)
        ups = tuple(self._up(one, sky.utc) for one in sky.up)
        self._trails = {(one.norad_id, one.name): one.trail for one in ups}
        where = sun(sky.utc, observer.latitude_deg, observer.longitude_deg)
        return SkyPicture(
            t_s,
            ups,
            where,
            None if moon is None else moon[1:],
            table,
            1.0 if sky.searching is None else sky.searching,
            until,
            sky.satellites,
            "demo orbits" if demo else "elements that ship" if sky.note else "",
            "" if demo else sky.note,
            self.mask if isinstance(self.mask, HorizonMask) else None,
            self.feed if self.hears is not None else "",
            self.hear_first,
        )

    def _favourite(self, number: int, name: str, known: bool) -> bool:
        return self.favourites.get(number or name, known)

    def _tuned(self, found: PassRow) -> Callable[[], DopplerFrequency | None]:
        number, name = found.passing.norad_id, found.passing.name
        return lambda: None if self.tuned is None else self.tuned(number, name)

    def _is_old(self, one: UpNow, now: datetime) -> bool:
        """Return whether a place is not to be believed; worked out once an hour, as thousands may be up."""
        key, hour = (one.norad_id, one.name), int(now.timestamp() // 3600)
        known = self._old.get(key)
        if known is None or known[0] is not one.elements or known[1] != hour:
            source = one.elements.source
            old = source == SHIPPED or (source != "demo" and expected_error(one.elements, now).grade == "useless")
            known = self._old[key] = (one.elements, hour, old)
        return known[2]

    def _up(self, one: UpNow, now: datetime) -> Up:
        fixed = one.range_km > GEO_KM and abs(one.range_rate_km_s) < STILL_KM_S
        known = self._favourite(one.norad_id, one.name, one.favourite)
        name = one.name.removeprefix(DEMO)
        trail = self._trails.get((one.norad_id, name), ())
        if not trail or separation(*trail[-1], one.az_deg, one.el_deg) >= TRAIL_DEG:
            trail = (*trail[-TRAIL + 1 :], (one.az_deg, one.el_deg))
        return Up(name, one.norad_id, one.az_deg, one.el_deg, known, fixed, self._is_old(one, now), trail)

    def _rows_of(self, sky: SkyNow, observer: Observer) -> tuple[ShownPass, ...]:
        made_of = (sky.passes, observer, dict(self.favourites), self.groups, self.hears)
        if made_of == self._made_of:
            return self._table  # nearly always, once all is searched: then a thousand rows cost nothing
        self._made_of = made_of
        kept: dict[int, ShownPass] = {}
        told: dict[int | str, bool] = {}
        for found in sky.passes:
            known = self._rows.get(id(found))
            passing = found.passing
            favourite = self._favourite(passing.norad_id, passing.name, found.favourite)
            satellite = passing.norad_id or passing.name
            if satellite in self.favourites:
                told[satellite] = told.get(satellite, True) and found.favourite == favourite
            groups = self.groups.get(key_of(found.elements), ())
            hears = None if self.hears is None else self.hears(passing.norad_id, passing.name)
            if (
                known is not None
                and known.found is found
                and (known.favourite, known.groups, known.hears) == (favourite, groups, hears)
            ):
                kept[id(found)] = known
            else:
                also = () if self.also is None else self.also(passing.norad_id, passing.name)
                kept[id(found)] = ShownPass(
                    found, favourite, groups, hears, _age(found), self._tuned(found), also,
                    partial(_path, found, observer),
                )  # fmt: skip
        self._rows = kept
        for satellite, known_now in told.items():
            if known_now:  # from here on the catalogue's word counts again, whoever changes it
                self.favourites.pop(satellite, None)
        table = tuple(kept.values())
        if len(table) != len(self._table) or any(a is not b for a, b in zip(table, self._table, strict=True)):
            self._table = table  # else the old one: what was made of it is kept, too
        return self._table


def _age(found: PassRow) -> Age:
    """Return how old the elements are at the pass, and what that means there; of made-up ones nothing can be said."""
    elements = found.elements
    if elements.source == "demo":
        return Age("made up for the demo", "made up", "·", "dim")
    error = expected_error(elements, found.passing.tca, found.at_tca.range_km)
    short = span(abs(error.age_s)) if error.reentry is None else REENTERED
    return Age(error.words, short, error.glyph, GRADE_INKS[error.grade], error.grade == "useless")


def _path(found: PassRow, observer: Observer) -> Path:
    """Work out the path of a pass, closer about the top."""
    import numpy as np
    from birdcage.sky.propagate import track

    aos_s, tca_s, los_s = (at.timestamp() for at in (found.passing.aos, found.passing.tca, found.passing.los))
    about = 0.06 * (los_s - aos_s)
    close = np.linspace(max(tca_s - about, aos_s), min(tca_s + about, los_s), SAMPLES // 2)
    times = np.unique(np.concatenate([np.linspace(aos_s, los_s, SAMPLES // 2), close]))
    way = track(found.elements, observer, times, found.time_offset_s)
    good = np.isfinite(way.el_deg)
    kept = (way.t_s, way.az_deg, way.el_deg, way.range_km, way.range_rate_km_s)
    return Path(*(tuple(each[good].tolist()) for each in kept))
