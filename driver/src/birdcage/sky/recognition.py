"""Which satellite somebody follows, told from the directions that he asks for: the right one, or none.

A program that follows a satellite asks for directions on its path across the sky. Some ask for where it is now
(SatNOGS, SatDump); Gpredict asks for where it will be when it has gone on by a threshold, and says nothing until then.
So each direction is laid on the path of a satellite. How far it lies beside the path is the misfit, and how much later
the satellite comes by is the lead. One satellite fits if no misfit is large, and the leads are those of one of the two.

**Chance.** Some hundred satellites of a full catalogue are up, and one of them may pass the same places by accident.
How many do so as closely is estimated from those near by: it has to be far less than one.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from birdcage.sky.frames import Floats, LookArrays, julian, look
from birdcage.sky.observer import Observer
from birdcage.sky.propagate import Fleet, over_times

FEWEST, MOST = 3, 12
"""Directions that are looked at."""
SHORTEST_S = 4.0
LEAST_ARC_DEG = 1.5
"""What is fixed, geostationary or turns with the stars does not get so far within `LONGEST_S`."""
LONGEST_S = 240.0
"""Older directions than this are not looked at."""
SPANS_S = (LONGEST_S, 80.0, 25.0)
"""The last directions of so long are tried one after the other: the first may be of another target."""
EARLIEST_S, LATEST_S = -6.0, 150.0
"""Leads that are looked for."""
NEAR_DEG = 15.0
"""On the sky, between a satellite and what is asked for, at most: the largest threshold."""
MISFIT_DEG = 0.3
"""Beside the path, at most, and what rounding adds: older elements of the same satellite."""
NOW_S, NOW_DEG = 1.0, 0.4
"""Who asks for where it is now has a mean lead of no more than this, or is no further from it."""
SPREAD_S = 1.0
"""How much the leads of such a program may differ, and what misfit and rounding make of that."""
LATE_S = 2.6
"""How old a direction of Gpredict's is at most when it comes: a tick, and a round of its client (reference 2.1)."""
FINE_S = 0.6
"""How finely Gpredict looks for the time at which the threshold is reached, and half as much again."""
THRESHOLDS_DEG = (0.2, 15.0)
CHANCE = 1e-5
"""How many other satellites may fit as well by accident, for a satellite to be recognised."""
RIVAL = 1e-2
"""Another satellite that fits, and by no more of an accident than this, leaves it undecided."""
SAME_DEG = 0.2
"""Two satellites that stay so close, as modules of one station do, are one for the dish."""
CROWDED = 8.0
"""Satellites of a constellation fly one way and equally fast: so much likelier is it that two are alike."""
STEP_S = 1.0
SKY_SAMPLE_DEG = 20.0


@dataclass(frozen=True, slots=True)
class AskedDirection:
    """A direction that somebody has asked for: true degrees, at POSIX seconds."""

    t_s: float
    az_deg: float
    el_deg: float


@dataclass(frozen=True, slots=True)
class RecognisedSatellite:
    """The satellite, and how it is followed."""

    index: int
    """In the fleet."""
    threshold_deg: float | None
    """By how far the program lets the dish lag, on either axis; None for one that asks for where the satellite is."""
    misfit_deg: float
    """How far from the path the directions lie at most."""
    leads_s: tuple[float, float]
    """The least lead, and the largest."""
    steps_deg: float
    """How far off a dish is that goes from one direction to the next, as they were asked for: RMS on the sky."""
    chance: float
    """How many satellites are expected to fit so well by accident."""


def recognise(
    fleet: Fleet, observer: Observer, asked: Sequence[AskedDirection], time_offsets: Mapping[int, float] | None = None
) -> RecognisedSatellite | None:
    """Return the satellite of the fleet that is followed; None where none is, or more than one may be.

    `asked`: in the order in which they came. `time_offsets`: how many seconds later than computed a satellite comes, by
    its index.
    """
    spans = [some for some in (_of_last(asked, span_s) for span_s in SPANS_S) if _tell_enough(some)]
    if not len(fleet) or not spans:
        return None
    offsets = time_offsets or {}
    near, density = _near(fleet, observer, spans[0][-1], offsets)
    paths = [_Path(fleet, index, observer, spans[0], offsets.get(index, 0.0)) for index in near]
    return next((found for some in spans if (found := _best(paths, some, density)) is not None), None)


def _of_last(asked: Sequence[AskedDirection], span_s: float) -> list[AskedDirection]:
    """Return those of a last time, `MOST` at most: others between them tell little more."""
    last = [each for each in asked if each.el_deg > 0.0 and asked[-1].t_s - each.t_s <= span_s]
    if len(last) <= MOST:
        return last
    return [last[round(place * (len(last) - 1) / (MOST - 1))] for place in range(MOST)]


def _tell_enough(asked: Sequence[AskedDirection]) -> bool:
    if len(asked) < FEWEST or asked[-1].t_s - asked[0].t_s < SHORTEST_S:
        return False
    ends = _vectors(asked)[[0, -1]]
    return bool(_degrees(ends[0], ends[1]) >= LEAST_ARC_DEG)


def _near(
    fleet: Fleet, observer: Observer, asked: AskedDirection, offsets: Mapping[int, float]
) -> tuple[list[int], float]:
    """Return the satellites near a direction then, and how many a square degree has in that part of the sky."""
    _, position, velocity = fleet.states(asked.t_s, offsets)
    seen = look(observer, asked.t_s, position, velocity)
    away = np.degrees(np.arccos(np.clip(_units(seen) @ _vectors([asked])[0], -1.0, 1.0)))  # NaN is near nothing
    with np.errstate(invalid="ignore"):
        near = np.flatnonzero((away < NEAR_DEG) & (seen.el_deg > -NEAR_DEG))
        around = int(np.count_nonzero((away < SKY_SAMPLE_DEG) & (seen.el_deg > 0.0)))
    cap_deg2 = 2.0 * math.pi * (1.0 - math.cos(math.radians(SKY_SAMPLE_DEG))) * math.degrees(1.0) ** 2
    return near.tolist(), max(around, 1) / cap_deg2


def _best(paths: Sequence[_Path], asked: Sequence[AskedDirection], density: float) -> RecognisedSatellite | None:
    fits = sorted(
        ((found, path) for path in paths if (found := path.fit(asked, density)) is not None),
        key=lambda each: each[0].chance,
    )
    if not fits or fits[0][0].chance > CHANCE:
        return None
    first = fits[0][1]
    same = [(found, path) for found, path in fits if path.stays_with(first, asked[-1].t_s)]
    if any(found.chance < RIVAL for found, path in fits if (found, path) not in same):
        return None
    return min(same, key=lambda each: each[1].norad_id or math.inf)[0]


class _Path:
    """The way of one satellite across the sky while directions were asked for, and shortly after."""

    def __init__(
        self, fleet: Fleet, index: int, observer: Observer, asked: Sequence[AskedDirection], offset_s: float
    ) -> None:
        self._index, self.norad_id = index, fleet[index].norad_id
        self._t_s = np.arange(asked[0].t_s + EARLIEST_S - STEP_S, asked[-1].t_s + LATEST_S + STEP_S, STEP_S)
        error, position, velocity = over_times(fleet.satrecs[index], *julian(self._t_s - offset_s))
        position[error != 0] = np.nan
        seen = look(observer, self._t_s, position, velocity)
        self._units = _units(seen)
        self._az, self._el = np.unwrap(seen.az_deg, period=360.0), seen.el_deg

    def stays_with(self, other: _Path, t_s: float) -> bool:
        """Return whether two satellites are as good as one from a time on."""
        later = self._t_s >= t_s
        apart = np.linalg.norm(self._units[later] - other._units[later], axis=1)
        return bool(np.degrees(apart.max()) < SAME_DEG)

    def fit(self, asked: Sequence[AskedDirection], density: float) -> RecognisedSatellite | None:
        """Return how the directions follow this satellite; None if they do not."""
        if np.isnan(self._el).any():
            return None
        t_s, wished = np.array([each.t_s for each in asked]), _vectors(asked)
        half_deg = _half_step(asked)
        misfit, passes_s = self._laid_on(t_s, wished)
        worst_deg, leads = float(misfit.max()), passes_s - t_s
        if worst_deg > MISFIT_DEG + 1.5 * half_deg or np.any(np.diff(passes_s) < -STEP_S):
            return None
        if leads.min() <= EARLIEST_S or leads.max() >= LATEST_S:
            return None
        arc_deg = float(np.degrees(np.linalg.norm(np.diff(self._at(passes_s), axis=0), axis=1)).sum())
        fuzzy_deg = max(worst_deg, half_deg, 0.02)
        rate = arc_deg / max(passes_s[-1] - passes_s[0], STEP_S)
        found = self._now(leads, rate, fuzzy_deg) or self._steps(t_s, wished, passes_s, asked)
        if found is None:
            return None
        threshold_deg, strip_deg, speed_fuzzy_deg = found
        direction = min(1.0, CROWDED * fuzzy_deg / max(arc_deg, 0.1) / math.pi)
        speed = min(1.0, 3.0 * speed_fuzzy_deg / max(arc_deg, 0.1))
        chance = density * 2.0 * fuzzy_deg * strip_deg * direction * speed
        return RecognisedSatellite(
            self._index, threshold_deg, worst_deg, (float(leads.min()), float(leads.max())),
            self._steps_error(t_s, wished), chance,
        )  # fmt: skip

    def _now(self, leads: Floats, rate: float, fuzzy_deg: float) -> tuple[float | None, float, float] | None:
        """Return no threshold, and within what the satellite was looked for, if they ask for where it is now.

        That is how long a strip of the sky may have held it, and how exactly its speed is known, in degrees.
        """
        spread_s, mean_s = float(np.ptp(leads)), abs(float(np.mean(leads)))
        if spread_s > SPREAD_S + 3.0 * fuzzy_deg / max(rate, 1e-3) or not (mean_s <= NOW_S or mean_s * rate <= NOW_DEG):
            return None
        return None, max(2.0 * mean_s * rate, fuzzy_deg), max(spread_s * rate, fuzzy_deg)

    def _steps(
        self, t_s: Floats, wished: Floats, passes_s: Floats, asked: Sequence[AskedDirection]
    ) -> tuple[float | None, float, float] | None:
        """Return the threshold, and the same, if they ask for where it will have gone on by a threshold."""
        az, el = np.interp(t_s, self._t_s, self._az), np.interp(t_s, self._t_s, self._el)
        wished_az = np.array([each.az_deg for each in asked])
        turn = np.abs((wished_az - az + 180.0) % 360.0 - 180.0)
        gone_on = np.maximum(turn, np.abs(np.array([each.el_deg for each in asked]) - el))
        if np.any(passes_s - t_s < -0.5):
            return None
        rates = np.array([self._fastest(begin, end) for begin, end in zip(t_s, passes_s, strict=True)])
        # Gpredict takes north for a jump of 360 degrees, and stops short of it.
        free = np.minimum(az % 360.0, wished_az) + THRESHOLDS_DEG[1] > np.maximum(az % 360.0, wished_az)
        whole = free & (wished_az > 1.0) & (wished_az < 359.0)
        least = float(np.max(gone_on - FINE_S * rates - 0.1))
        most = float(np.min(np.where(whole, gone_on + LATE_S * rates + 0.1, THRESHOLDS_DEG[1])))
        if least > most or most < THRESHOLDS_DEG[0] or least > THRESHOLDS_DEG[1]:
            return None
        threshold_deg = min(max(float(np.median(gone_on)), least), most)
        on_sky = np.degrees(np.linalg.norm(wished - self._at(t_s), axis=1))
        return threshold_deg, 2.0 * float(on_sky.max()), max(float(np.ptp(on_sky)), 0.1)

    def _laid_on(self, t_s: Floats, wished: Floats) -> tuple[Floats, Floats]:
        """Return how far directions lie beside the path, in degrees, and when the satellite comes by."""
        ahead = self._t_s[None, :] - t_s[:, None]
        closeness = np.where((ahead >= EARLIEST_S) & (ahead <= LATEST_S), wished @ self._units.T, -2.0)
        nearest = np.clip(closeness.argmax(axis=1), 1, len(self._t_s) - 2)
        best_deg, best_s = np.full(len(t_s), np.inf), np.zeros(len(t_s))
        for begin in (nearest - 1, nearest):
            start, way = self._units[begin], self._units[begin + 1] - self._units[begin]
            part = np.clip(((wished - start) * way).sum(axis=1) / (way * way).sum(axis=1), 0.0, 1.0)
            off_deg = np.degrees(np.linalg.norm(start + part[:, None] * way - wished, axis=1))
            nearer = off_deg < best_deg
            best_deg = np.where(nearer, off_deg, best_deg)
            best_s = np.where(nearer, self._t_s[begin] + part * STEP_S, best_s)
        return best_deg, best_s

    def _at(self, times: Floats) -> Floats:
        return np.stack([np.interp(times, self._t_s, self._units[:, axis]) for axis in range(3)], axis=1)

    def _fastest(self, begin_s: float, end_s: float) -> float:
        """Return how fast the faster axis turns at most between two times, in degrees a second."""
        within = (self._t_s >= begin_s - 3.0) & (self._t_s <= end_s + 3.0)
        return max(float(np.abs(np.diff(angle[within])).max()) / STEP_S for angle in (self._az, self._el))

    def _steps_error(self, t_s: Floats, wished: Floats) -> float:
        """Return the RMS distance of the satellite from the direction that was asked for last, at every moment."""
        times = self._t_s[(self._t_s >= t_s[0]) & (self._t_s <= t_s[-1])]
        last = wished[np.searchsorted(t_s, times, side="right") - 1]
        off_deg = np.degrees(np.linalg.norm(self._at(times) - last, axis=1))
        return float(np.sqrt(np.mean(off_deg**2)))


def _half_step(asked: Sequence[AskedDirection]) -> float:
    """Return by how much the angles may be rounded: half of the coarsest step that all of them are multiples of."""
    angles = np.array([[each.az_deg, each.el_deg] for each in asked])
    for step_deg in (1.0, 0.5, 0.1):
        if np.allclose(angles / step_deg, np.round(angles / step_deg), rtol=0.0, atol=1e-3):
            return step_deg / 2.0
    return 0.005


def _units(seen: LookArrays) -> Floats:
    az, el = np.radians(seen.az_deg), np.radians(seen.el_deg)
    return np.stack([np.sin(az) * np.cos(el), np.cos(az) * np.cos(el), np.sin(el)], axis=1)


def _vectors(asked: Sequence[AskedDirection]) -> Floats:
    az, el = np.radians([each.az_deg for each in asked]), np.radians([each.el_deg for each in asked])
    return np.stack([np.sin(az) * np.cos(el), np.cos(az) * np.cos(el), np.sin(el)], axis=1)


def _degrees(first: Floats, second: Floats) -> float:
    return math.degrees(2.0 * math.asin(min(1.0, float(np.linalg.norm(first - second)) / 2.0)))
