"""What a person with hands on the dish needs to know: how much of the best signal this is, and where that was.

Readings are averaged where the dish stands: the highest of many single readings is noise, and so is the lowest.
"""

from __future__ import annotations

import math
from collections import deque
from dataclasses import dataclass, field
from enum import Enum
from statistics import fmean

from birdcage.base.geometry import shortest_turn
from birdcage.signal.beam_fit import LEAST_POINTS, BeamFit, HeardDirection, beam_points, fit_beam
from birdcage.signal.source import Scale

SPELL_S = 1.0
"""Readings of so long a time, in one direction, are averaged before they can be the peak or the floor."""
LEVEL_S = 0.5
"""The level that is shown is averaged over so long."""
RATE_S = 5.0
"""The rate that is reached is counted over so long."""
SAME_DEG = 0.03
"""A dish at rest repeats its angles so well."""
KEPT_SPELLS, FLOOR_PART = 900, 0.1
"""The floor is the mean of the lowest tenth of the last spells: a quarter of an hour of them."""
KEPT_STEPS = 400
"""From so many differences between one reading and the next the noise is computed."""
MOST_COUNTED = 20
"""Readings of one direction that count when it is compared with another."""
KEPT_PLACES = 60
"""Directions of which the levels are kept, for the fit: the last ones."""
CLEAR = 4.0
"""A peak must stand so many times the noise over the floor, before it is said which part of it is heard."""
SURE = 2.5
"""A direction is hotter, or colder, where the difference is so many times its own standard deviation."""
STEP_S = 30.0
"""So long what a step did is told: a source that tells once a second has more than `MOST_COUNTED` readings by then."""


class Trend(Enum):
    """What the last step did."""

    HOTTER = "hotter"
    COLDER = "colder"
    SAME = "same"


@dataclass(frozen=True, slots=True)
class HeardPeak:
    """The strongest signal since the last `forget`."""

    value: float
    at: float
    """Monotonic seconds."""
    az_deg: float | None = None
    """Where the dish pointed, true; None where that was not known."""
    el_deg: float | None = None


@dataclass(frozen=True, slots=True)
class LevelNow:
    """How well it is heard now, in the unit of its source. What is not known is None."""

    level: float
    at: float
    """When it was heard last, in monotonic seconds."""
    rate_hz: float | None
    """Readings a second that really come."""
    noise: float | None
    """Standard deviation of one reading."""
    floor: float | None
    peak: HeardPeak | None
    share: float | None
    """The part of the peak over the floor, in power: 1 is the peak, and what is stronger while its average is not
    complete. None while peak and floor cannot be told apart."""
    trend: Trend
    """Against the direction before the last step; SAME once that is `STEP_S` ago."""
    fit: BeamFit | None
    """Where the middle of the source is, by all directions that were heard; None while they do not tell."""


@dataclass(slots=True)
class _Spell:
    """Readings of one direction, one after the other."""

    at: float
    az_deg: float | None
    el_deg: float | None
    values: list[float] = field(default_factory=list)

    def is_here(self, az_deg: float | None, el_deg: float | None) -> bool:
        """Return whether a reading of that direction belongs to it."""
        if self.az_deg is None or self.el_deg is None or az_deg is None or el_deg is None:
            return self.az_deg is None and az_deg is None
        return abs(shortest_turn(self.az_deg, az_deg)) <= SAME_DEG and abs(self.el_deg - el_deg) <= SAME_DEG


class PeakHold:
    """Of one source."""

    def __init__(self, scale: Scale | None) -> None:
        """With `Scale.LOG` values are decibels; any other scale counts as proportional to power."""
        self._scale = scale
        self.forget()

    def forget(self) -> None:
        """Begin anew: another direction of the sky, another feed."""
        self._spell: _Spell | None = None
        self._means: deque[float] = deque(maxlen=KEPT_SPELLS)
        self._steps: deque[float] = deque(maxlen=KEPT_STEPS)
        self._recent: deque[tuple[float, float]] = deque()
        """Times and values of the last `RATE_S`."""
        self._here: _Spell | None = None
        """All of this direction, however long it lasts."""
        self._before: _Spell | None = None
        self._peak: HeardPeak | None = None
        self._left: deque[_Spell] = deque(maxlen=KEPT_PLACES)
        """Directions that were heard before this one."""
        self._fit: BeamFit | None = None

    def hear(
        self, at: float, value: float, az_deg: float | None = None, el_deg: float | None = None, *,
        beam_deg: float | None = None,
    ) -> None:  # fmt: skip
        """Take a reading at a monotonic time, and the true direction in which it was taken, if that is known.

        `beam_deg` is the width of the beam, as far as it is known.
        """
        if self._here is not None and self._here.is_here(az_deg, el_deg):
            self._steps.append((value - self._here.values[-1]) ** 2)
        else:
            self._end_spell()
            if self._here is not None:
                self._left.append(self._here)
            self._before, self._here = self._here, _Spell(at, az_deg, el_deg)
        self._here.values = [*self._here.values[1 - MOST_COUNTED :], value]
        self._recent.append((at, value))
        while self._recent[0][0] < at - RATE_S:
            self._recent.popleft()
        if self._spell is not None and at - self._spell.at >= SPELL_S:
            self._end_spell()
            self._fit = self._fitted(beam_deg)
        if self._spell is None:
            self._spell = _Spell(at, az_deg, el_deg)
        self._spell.values.append(value)

    def now(self) -> LevelNow | None:
        """Return what is known; None before the first reading."""
        if self._here is None:
            return None
        at, here = self._recent[-1][0], self._here
        lately = sum(1 for each, _value in self._recent if each > at - LEVEL_S)
        level = fmean(here.values[-lately:])
        span_s = at - self._recent[0][0]
        return LevelNow(
            level, at, (len(self._recent) - 1) / span_s if span_s > 0.0 else None, self._noise, self._floor, self._peak,
            self._share(level), self._trend(here), self._fit,
        )  # fmt: skip

    def _end_spell(self) -> None:
        """Take what was heard in one direction as one measurement."""
        spell, self._spell = self._spell, None
        if spell is None:
            return
        mean = fmean(spell.values)
        self._means.append(mean)
        if self._peak is None or mean > self._peak.value:
            self._peak = HeardPeak(mean, spell.at, spell.az_deg, spell.el_deg)

    def _fitted(self, beam_deg: float | None) -> BeamFit | None:
        """Return the middle of the source by every direction."""
        noise, heard = self._noise, [*self._left, *filter(None, [self._here])]
        if noise is None or len(heard) < LEAST_POINTS:
            return None
        known = [
            HeardDirection(each.az_deg, each.el_deg, each.values)
            for each in heard if each.az_deg is not None and each.el_deg is not None
        ]  # fmt: skip
        return fit_beam(beam_points(known, noise, decibels=self._scale is Scale.LOG), beam_deg)

    @property
    def _noise(self) -> float | None:
        # Successive differences: a signal that drifts slowly is no noise.
        return math.sqrt(fmean(self._steps) / 2.0) if len(self._steps) >= 3 else None

    @property
    def _floor(self) -> float | None:
        if not self._means:
            return None
        return fmean(sorted(self._means)[: max(1, int(len(self._means) * FLOOR_PART))])

    def _share(self, level: float) -> float | None:
        floor, noise, peak = self._floor, self._noise, self._peak
        if floor is None or peak is None or noise is None or peak.value - floor <= CLEAR * noise:
            return None
        part = (self._power(level) - self._power(floor)) / (self._power(peak.value) - self._power(floor))
        return min(part, 1.0)

    def _power(self, value: float) -> float:
        power: float = 10.0 ** (value / 10.0) if self._scale is Scale.LOG else value
        return power

    def _trend(self, here: _Spell) -> Trend:
        before, noise = self._before, self._noise
        if before is None or noise is None or self._recent[-1][0] - here.at > STEP_S:
            return Trend.SAME
        differs = fmean(here.values) - fmean(before.values)
        sigma = noise * math.sqrt(1.0 / len(here.values) + 1.0 / len(before.values))
        if abs(differs) <= SURE * sigma:
            return Trend.SAME
        return Trend.HOTTER if differs > 0.0 else Trend.COLDER
