"""A sky to show: satellites on great circles, worked out at once and without a thread."""

from __future__ import annotations

import math
from dataclasses import replace
from datetime import UTC, datetime

from birdcage.sky.elements import ElementSet
from birdcage.sky.footprint import footprint
from birdcage.sky.horizon import HorizonMask
from birdcage.sky.observer import Observer
from birdcage.sky.pass_row import Distance, PassRow
from birdcage.sky.passes.model import Pass
from birdcage.sky.reach_model import LossReason, Lost, PassReach, Stretch
from birdcage.sky.sun_crossing import SunApproach
from birdcage.sky.terminator import sub_solar
from birdcage.sky.world import SubPoint, WorldView
from birdcage_tui.shown.sky_picture import Age, DopplerFrequency, Path, ShownPass, SkyPicture, Up

NOON = datetime(2026, 3, 20, 12, tzinfo=UTC).timestamp()
LRPT = DopplerFrequency(137.9e6, "its LRPT", ("LRPT, RHCP, 72 kbaud", "SatDump meteor_m2-x_lrpt", "on 2026-10-16"))
MASK = HorizonMask([(0, 4), (40, 9), (70, 22), (95, 24), (110, 8), (180, 2), (250, 5), (300, 14), (330, 6)])
FLOOR, CEILING = 18.0, 65.0


def path_of(start_s, length_s, from_az, to_az, top_deg):
    """A way over the sky: elevation a sine, azimuth swinging as it does."""
    times, azimuths, elevations, ranges = [], [], [], []
    turn = (to_az - from_az + 180) % 360 - 180
    for step in range(121):
        share = step / 120
        swing = 0.5 + math.atan((share - 0.5) * 2 * (1 + top_deg / 12)) / (2 * math.atan(1 + top_deg / 12))
        times.append(start_s + length_s * share)
        azimuths.append((from_az + turn * swing) % 360)
        elevations.append(top_deg * math.sin(math.pi * share) ** 1.4)
        ranges.append(math.hypot(820.0, 6.6 * length_s * (share - 0.5)))
    rates = [6.6**2 * length_s * (step / 120 - 0.5) / km for step, km in enumerate(ranges)]
    return Path(tuple(times), tuple(azimuths), tuple(elevations), tuple(ranges), tuple(rates))


def utc(t_s):
    return datetime.fromtimestamp(t_s, UTC)


def in_reach(*spans, lost=(), best=None):
    """Reach as of spans in POSIX seconds; `lost` has a reason too."""
    return PassReach(
        tuple(Stretch(utc(start), utc(end)) for start, end in spans),
        tuple(Lost(utc(start), utc(end), LossReason(reason)) for start, end, reason in lost),
        best,
    )


def reach_of(path, floor=FLOOR, ceiling=CEILING):
    """What lies between floor and ceiling."""
    intervals, lost, state, since = [], [], None, path.t_s[0]
    for t_s, el_deg in zip((*path.t_s, math.inf), (*path.el_deg, None), strict=True):
        now = None if el_deg is None else "floor" if el_deg < floor else "ceiling" if el_deg > ceiling else ""
        if now != state:
            end = min(t_s, path.t_s[-1])
            if state == "":
                intervals.append((since, end))
            elif state is not None:
                lost.append((since, end, state))
            state, since = now, end
    best = max((el for t_s, el in zip(path.t_s, path.el_deg, strict=True)
                if any(a <= t_s <= b for a, b in intervals)), default=None)  # fmt: skip
    return in_reach(*intervals, lost=lost, best=best)


PASSES = (
    # name, number, minutes until it rises, minutes up, from, to, highest, favourite, groups
    ("METEOR-M2 4", 59051, -4, 14, 341, 158, 71, True, ("weather",)),
    ("NOAA 20 (JPSS-1)", 43013, 3, 13, 22, 201, 44, False, ("weather",)),
    ("ISS (ZARYA)", 25544, 12, 10, 231, 62, 38, True, ("stations",)),
    ("METOP-C", 43689, 31, 14, 12, 190, 52, True, ("weather",)),
    ("TERRA", 25994, 36, 9, 300, 240, 11, False, ("resource",)),
    ("FENGYUN 3D", 43010, 47, 13, 170, 350, 64, False, ("weather",)),
    ("METEOR-M2 3", 57166, 58, 12, 90, 350, 24, True, ("weather",)),
    ("SUOMI NPP", 37849, 70, 14, 160, 345, 88, False, ("weather",)),
    ("CUTE-1 (CO-55)", 27844, 84, 12, 200, 340, 33, False, ("amateur",)),
    ("AQUA", 27424, 95, 13, 150, 355, 57, False, ("resource",)),
    ("METEOR-M2 4", 59051, 97, 13, 320, 200, 33, True, ("weather",)),
    ("ISS (ZARYA)", 25544, 105, 11, 262, 80, 66, True, ("stations",)),
    ("METOP-C", 43689, 132, 12, 350, 250, 21, True, ("weather",)),
    *((f"CUBESAT {number}", 60000 + number, 140 + 13 * number, 11, 17 * number % 360, (17 * number + 150) % 360,
       (37 * number) % 80 + 8, False, ("cubesat",)) for number in range(30)),
)  # fmt: skip


AGE = Age("1 d old, about ±0.26° (90 %: 2.2°) at closest", "1 d", "◐", "text")
OTHERS = (
    ("MOLNIYA 3-50", 25847, 35.0, 58.0),
    ("GALILEO 22", 41859, 290.0, 33.0),
    ("GPS BIIF-2", 37753, 120.0, 72.0),
    ("BEIDOU 34", 43622, 62.0, 12.0),
    ("ATLAS CENTAUR 2", 694, 318.0, 61.0),
)
"""What is up all the time: name, number, azimuth, elevation."""


def shown_pass(name, number, times_s, azimuths, top_deg, *, reach=None, path=None, elements=None, **changes):
    """One pass as the pages show it; times and azimuths are those of AOS, TCA and LOS."""
    passing = Pass(name, number, *map(utc, times_s), *azimuths, float(top_deg))
    elements = elements or ElementSet(name, number, utc(NOON), 98.6, 40.0, 0.001, 0.0, 0.0, 14.2)
    away = Distance(820.0, 0.0)
    found = PassRow(passing, elements, reach or PassReach(), 1.0, None, away, away, away)
    one = ShownPass(found, False, (), None, AGE, lambda: None, (), lambda: path)
    return changed(one, **changes)


def changed(row, **changes):
    """The same pass with other facts, whoever holds them: the app, the driver's row or the pass itself."""
    of = [{key: changes.pop(key) for key in list(changes) if key in held.__dataclass_fields__}
          for held in (ShownPass, PassRow, Pass)]  # fmt: skip
    assert not changes, f"no such facts: {changes}"
    return replace(row, found=replace(row.found, passing=replace(row.found.passing, **of[2]), **of[1]), **of[0])


def rows(now_s=NOON):
    """The passes over the stand-in's place."""
    found = []
    for name, number, minutes, length, from_az, to_az, top, favourite, groups in PASSES:
        aos = now_s + minutes * 60.0
        path = path_of(aos, length * 60.0, from_az, to_az, top)
        highest = max(range(121), key=lambda index: path.el_deg[index])
        found.append(shown_pass(
            name, number, (aos, path.t_s[highest], path.t_s[-1]), (from_az, path.az_deg[highest], to_az), top,
            reach=reach_of(path), path=path, favourite=favourite, groups=groups,
            hears="137.9 MHz LRPT" if name.startswith("METEOR") else "", sun=SunApproach(utc(aos + 120.0), 31.0),
            tuned=lambda name=name: LRPT if name.startswith("METEOR") else None,
        ))  # fmt: skip
    return tuple(sorted(found, key=lambda row: row.aos_s))


def picture(now_s=NOON, **changes):
    """Everything that is up at a moment, and what comes."""
    table = rows()
    up = [
        Up(row.name, row.norad_id, *row.path.at(now_s), favourite=row.favourite)
        for row in table if row.path.at(now_s) is not None
    ]  # fmt: skip
    up += [Up(*others) for others in OTHERS]
    sky = SkyPicture(
        now_s,
        tuple(up),
        (171.0, 27.0),
        (77.0, 36.0),
        table,
        1.0,
        NOON + 86400.0,
        43,
        "demo orbits",
        mask=MASK,
        feed="helix",
    )
    return replace(sky, **changes)


def world(ask):
    """The world at a moment: the chosen satellite on a circle about the Earth, and others here and there."""
    when = datetime.fromtimestamp(ask.t_s, UTC)

    def under(t_s):
        turn = math.radians(t_s / 100.0 * 6.0 % 360.0)
        latitude = math.asin(math.sin(math.radians(98.0)) * math.sin(turn))
        longitude = math.atan2(math.cos(math.radians(98.0)) * math.sin(turn), math.cos(turn))
        return math.degrees(latitude), (math.degrees(longitude) - t_s / 240.0 + 180.0) % 360.0 - 180.0

    def line(start_s, end_s):
        return tuple(under(start_s + (end_s - start_s) * step / 240) for step in range(241))

    others = tuple(
        SubPoint(
            row.name, row.norad_id, 70.0 - 17.0 * place % 130.0, 47.0 * place % 360.0 - 180.0, 800.0, row.favourite
        )
        for place, row in enumerate(ask.others)
    )
    seen = WorldView(when, sub_solar(when), Observer(40.4, -95.0, name="EN10"), others)
    if ask.chosen is None:
        return seen
    here = under(ask.t_s)
    chosen = SubPoint(ask.chosen.name, ask.chosen.norad_id, *here, 820.0, ask.chosen.favourite)
    return replace(
        seen, chosen=chosen, behind=line(ask.t_s - 6000.0, ask.t_s), ahead=line(ask.t_s, ask.t_s + 6000.0),
        footprint=footprint(*here, 820.0),
    )  # fmt: skip


class Source:
    """Shows one picture at once, and notes what is asked of it."""

    made: list[Source] = []  # noqa: RUF012 - the last one, for the tests to look at

    def __init__(self, show, say, sky=None):
        self.state, self.show, self.say = None, show, say
        self.sky = sky or picture()
        self.favourites, self.exported, self.looked, self.closed = [], [], [], False
        Source.made[:] = [self]  # one that is kept keeps its app

    def start(self):
        self.show(self.sky)

    def keep(self, state, place, horizon=None):
        self.state, self.place, self.horizon = state, place, horizon

    def set_favourite(self, satellite, favourite):
        self.favourites.append((satellite, favourite))
        table = tuple(
            replace(row, favourite=favourite) if satellite in (row.norad_id, row.name) else row
            for row in self.sky.rows
        )  # fmt: skip
        self.sky = replace(self.sky, rows=table)
        self.show(self.sky)

    def export(self, rows):
        self.exported.append(list(rows))
        self.say(f"Wrote {len(rows)} passes.")

    def look_down(self, ask, show):
        self.looked.append(ask)
        show(world(ask))

    def close(self):
        self.closed = True


def make(**changes):
    """Return what makes a source around a changed picture."""
    return lambda show, say: Source(show, say, picture(**changes))
