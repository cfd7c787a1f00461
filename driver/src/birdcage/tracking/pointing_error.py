"""The one pointing error that a person may believe: what the dish adds, and what the age of the elements does.

The dish's own error, a saw-tooth about the computed track, has no side in common with the error of the elements, which
is one shift along the track for all of a pass. So their squares add at every moment, and over the pass:

    error(t)^2 = dish(t)^2 + elements(t)^2        rms^2 = rms_dish^2 + rms_elements^2

Of the elements' error the median and the 90th percentile are known (`sky.age`). It enters by one factor for all of the
pass, in which both formulas grow: taken at the median they are the median of all such passes, taken at the 90th
percentile what one pass in ten exceeds. Where the error of the elements is not known, neither is the whole.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from birdcage.base.beam import PEAK_LOSS_DB, Beam
from birdcage.sky.age_words import age_words, plus_minus
from birdcage.sky.element_error import ElementError
from birdcage.tracking.curve import Floats
from birdcage.tracking.plan import Forecast

UPDATE = "`birdcage elements update` gets newer ones"
STILL_FLIES = "`birdcage elements update` shows whether it still flies"


@dataclass(frozen=True, slots=True, eq=False)
class Level:
    """How far off the dish points over a pass, at one level of certainty."""

    error_deg: Floats
    """At the times of the dish's forecast."""
    loss_db: Floats | None
    """What that costs at the beam; None without one."""
    rms_deg: float
    max_deg: float


@dataclass(frozen=True, slots=True, eq=False)
class PointingError:
    """What to expect of a pass, dish and elements together."""

    dish: Forecast
    """What it would be if the elements were perfect."""
    elements: ElementError | None
    """None for what follows no elements, and for orbits that are made up."""
    median: Level | None
    """None if it is not known."""
    p90: Level | None
    """One pass in ten is worse; without elements as `median`."""

    @property
    def unknown(self) -> str:
        """Why it is not known, as a clause; empty if it is."""
        return "" if self.elements is None else self.elements.unknown

    @property
    def advice(self) -> str:
        """What would make it smaller, or known, as a clause: where the elements are what matters, and are not fresh."""
        old = self.elements is not None and self.elements.closest.grade != "fresh"
        if not old or (self.median is not None and self.median.rms_deg**2 < 2.0 * self.dish.rms_deg**2):
            return ""
        assert self.elements is not None, "elements without an age are none"
        return UPDATE if self.elements.closest.reentry is None else STILL_FLIES

    def with_dish(self, dish_deg: float | None) -> tuple[float | None, float | None]:
        """Return RMS over the pass and 90th percentile, the dish's own RMS being what was measured; None: not known."""
        if dish_deg is None or self.median is None or self.p90 is None:
            return None, None
        return tuple(  # type: ignore[return-value]
            float(np.sqrt(dish_deg**2 + max(level.rms_deg**2 - self.dish.rms_deg**2, 0.0)))
            for level in (self.median, self.p90)
        )

    def at(self, t_s: float, dish_deg: float) -> float | None:
        """Return the error to expect at a time, as a rule, of a dish so far off the track; None if it is unknown."""
        found = self.elements
        if found is None:
            return dish_deg
        if found.median_deg is None:
            return None
        return float(np.hypot(dish_deg, np.interp(t_s, found.t_s, found.median_deg)))


def pointing_error(dish: Forecast, elements: ElementError | None, beam: Beam | None) -> PointingError:
    """Return what a dish and the elements it believes come to; without a beam, no decibels.

    The error of the elements costs what the narrower width of the beam makes of it.
    """

    def level(added_deg: Floats | None) -> Level | None:
        if added_deg is None or elements is None:
            return None
        added = np.interp(dish.t_s, elements.t_s, added_deg)
        error = np.hypot(dish.error_deg, added)
        # The dish's own greatest error lies between the times of its forecast: the worst is that both come together.
        greatest = float(np.hypot(dish.max_deg, added.max()))
        loss = None
        if beam is not None and dish.loss_db is not None:
            loss = dish.loss_db + PEAK_LOSS_DB * (added / beam.narrow_deg) ** 2
        return Level(error, loss, float(np.hypot(dish.rms_deg, np.sqrt(np.mean(added**2)))), greatest)

    if elements is None:
        alone = Level(dish.error_deg, dish.loss_db, dish.rms_deg, dish.max_deg)
        return PointingError(dish, None, alone, alone)
    return PointingError(dish, elements, level(elements.median_deg), level(elements.p90_deg))


def error_words(found: PointingError) -> str:
    """Return the error over the pass: `±0.26° (90 %: 2.2°)`, `±0.02°`, `unknown`."""
    if found.median is None or found.p90 is None:
        return "unknown"
    if found.elements is None:
        return f"±{found.median.rms_deg:.2f}°"
    return plus_minus(found.median.rms_deg, found.p90.rms_deg)


def element_words(found: ElementError) -> str:
    """Return grade and age, and why the error is unknown: `✗ useless elements, 3228 d old, figures end at 7 d`."""
    closest = found.closest
    why = f", {found.unknown}" if found.unknown else ""
    return f"{closest.glyph} {closest.grade} elements, {age_words(closest.age_s)}{why}"
