"""Whether a satellite has re-entered by its own elements: SGP4 answers for long after the orbit has gone.

SGP4 shrinks an orbit by a polynomial in time, whose square is the size: where drag has taken the polynomial through
zero the orbit grows again, and positions come out as if nothing had been. Elements may also publish a decay (the dot of
the mean motion) that SGP4 does not use. The earlier of both is taken. A satellite that raises its orbit, as the space
station does, is still up: its elements cannot say so.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from datetime import datetime, timedelta

from birdcage.sky.elements import ElementSet

LOWEST_KM = 140.0
"""Mean height at which a satellite stays in orbit for less than about a day."""
LOWEST_PERIGEE_KM = 80.0
"""Below this no perigee is passed in one piece."""
ROUND = 0.05
"""Up to this eccentricity a published decay lowers all of the orbit, and not the apogee alone."""
CALM_DAYS, CALM_PERIGEE_KM, CALM_DOT = 7.0, 200.0, 1.75e-3
"""Elements this young, of an orbit this high, that decays no faster (rev/day^2, as published), need no closer look."""
LOW_REV_DAY = 6.4
"""From so many revolutions a day on an orbit is low; air does not matter to the others within the life of elements."""
_NAMED = 4
_LOOKS = 8
_HALVINGS = 20
_EARTH_KM = 6378.137
_MU_KM3_S2 = 398600.4418


def reentry(elements: ElementSet, when: datetime) -> datetime | None:
    """Return the time, up to `when`, at which its elements let it down; None if it stays up, or is too eccentric."""
    days = (when - elements.epoch).total_seconds() / 86400.0
    if days < 0.0 or elements.mean_motion_rev_day < LOW_REV_DAY or _is_calm(elements, days):
        return None
    found = [each for each in (_by_drag(elements, days), _by_published(elements, days)) if each is not None]
    return elements.epoch + timedelta(days=min(found)) if found else None


def reentry_words(at: datetime, when: datetime) -> str:
    """Return it as a clause: `by its elements it re-entered about May 2023, unless it was boosted`."""
    if when - at < timedelta(days=3):
        return "by its elements it re-enters about now, unless it is boosted"
    date = f"{at:%B %Y}" if when - at > timedelta(days=60) else f"{at.day} {at:%B %Y}"
    return f"by its elements it re-entered about {date}, unless it was boosted"


def reentry_warning(rows: Iterable[tuple[ElementSet, datetime]]) -> str | None:
    """Return what to say where some of these satellites have re-entered by then; None if none has."""
    down = {each.name or str(each.norad_id): None for each, when in rows if reentry(each, when) is not None}
    if not down:
        return None
    names = ", ".join([*list(down)[:_NAMED], *([f"{len(down) - _NAMED} more"] if len(down) > _NAMED else [])])
    return (
        f"By their own elements these have re-entered, unless they were boosted: {names}. "
        "`birdcage elements update` shows whether they still fly."
    )


def _height_km(rev_day: float) -> float:
    return math.cbrt(_MU_KM3_S2 / (rev_day * math.tau / 86400.0) ** 2) - _EARTH_KM


def _is_calm(elements: ElementSet, days: float) -> bool:
    low_km = (_height_km(elements.mean_motion_rev_day) + _EARTH_KM) * (1.0 - elements.eccentricity) - _EARTH_KM
    return days < CALM_DAYS and low_km > CALM_PERIGEE_KM and elements.mean_motion_dot < CALM_DOT


def _by_drag(elements: ElementSet, days: float) -> float | None:
    """Return after how many days SGP4 itself has it too low, or has no orbit of it left."""
    from birdcage.sky.propagate import mean_orbit, satrec

    record = satrec(elements)

    def is_down(after_days: float) -> bool:
        mean = mean_orbit(record, after_days)
        if mean is None:
            return True
        axis_km, eccentricity = mean
        return axis_km - _EARTH_KM < LOWEST_KM or axis_km * (1.0 - eccentricity) - _EARTH_KM < LOWEST_PERIGEE_KM

    if mean_orbit(record, 0.0) is None:
        return None  # they are no orbit at all, which is another thing
    looks = (days * step / _LOOKS for step in range(_LOOKS + 1))
    high = next((each for each in looks if is_down(each)), None)
    if high is None:
        return None
    low = max(high - days / _LOOKS, 0.0)
    for _ in range(_HALVINGS):
        middle = (low + high) / 2.0
        low, high = (low, middle) if is_down(middle) else (middle, high)
    return high


def _by_published(elements: ElementSet, days: float) -> float | None:
    """Return after how many days the published decay, which only gets faster, has it too low."""
    if elements.eccentricity > ROUND or elements.mean_motion_dot <= 0.0:
        return None
    lowest_rev_day = 86400.0 / math.tau * math.sqrt(_MU_KM3_S2 / (_EARTH_KM + LOWEST_KM) ** 3)
    after = max(lowest_rev_day - elements.mean_motion_rev_day, 0.0) / (2.0 * elements.mean_motion_dot)
    return after if after <= days else None
