"""How far a satellite may be from where its elements say, by their age: in kilometres, in degrees, in words.

Measured is the space station alone (`docs/tracking.md`, *Age of the elements*: 6,000 element sets of 2022 to 2025, old
ones carried on to the epoch of newer ones). It is about the worst case: low, large, at solar maximum, and raised now
and then. For every other orbit the figures are an estimate, by two arguments:

- Without air, what grows is the error of the fitted period. A fit over a day or so cannot tell the period better than
  its own scatter over that time, so the error at epoch is added once a day. Seen as an angle along the orbit the
  scatter is taken to be the station's: in kilometres it grows with the size of the orbit.
- With air, the error grows as the station's does, in proportion to the drag: the published decay of the mean motion
  against the station's, or, where none is published, the density at perigee by an exponential atmosphere.

Within seven days the figures interpolate the table in logarithms; beyond that nothing was measured or is said.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from datetime import datetime
from typing import Literal

from birdcage.sky.age_words import Grade, glyph_of, grade_of, unknown_words, words_of, worse
from birdcage.sky.decay import reentry, reentry_words
from birdcage.sky.elements import ElementSet

OrbitClass = Literal["LEO", "MEO", "GEO", "HEO"]

MEASURED = ((6.0, 0.7, 2.3), (12.0, 0.9, 4.6), (24.0, 1.9, 15.8), (48.0, 6.0, 104.0), (72.0, 14.0, 388.0),
            (168.0, 125.0, 1818.0))  # fmt: skip
"""Age in hours; along-track error of the space station in km, median and 90th percentile (as above)."""
LONGEST_H = MEASURED[-1][0]
USELESS_H: dict[OrbitClass, float] = {"LEO": 28 * 24.0, "HEO": 28 * 24.0, "MEO": 182 * 24.0, "GEO": 182 * 24.0}
"""From when on elements are called useless though no error is known: a rule of caution."""
STATION = 25544
STATION_AXIS_KM = 6795.0
STATION_DOT = 1.75e-4
"""Its semi-major axis, and half the decay of its mean motion in rev/day^2: medians of the same sets (417 km up)."""
STATION_ALTITUDE_KM = 417.0
SCALE_HEIGHT_KM = 65.0
"""Over which the air thins to a third between 400 and 800 km at high solar activity: an assumption."""
MOST_DRAG = 10.0
"""Times the station's; what falls faster is about to decay, and the table says nothing of that."""

EARTH_KM = 6378.137
MU_KM3_S2 = 398600.4418


@dataclass(frozen=True, slots=True)
class ExpectedError:
    """What to expect of one element set at one time. What is not known is None, and shows as a dash."""

    age_s: float
    """Since epoch; negative where the epoch is later."""
    along_track_median_km: float | None
    along_track_p90_km: float | None
    """One case in ten is worse."""
    pointing_median_deg: float | None
    pointing_p90_deg: float | None
    grade: Grade
    glyph: str
    words: str
    """A sentence without a full stop: `1 d old, ±0.26° (90 %: 2.2°) at closest`."""
    orbit: OrbitClass
    measured: bool
    """Whether the figures are of this satellite, and not an estimate by its orbit."""
    unknown: str = ""
    """Why the error is not known, as a clause; empty if it is."""
    reentry: datetime | None = None
    """When it has re-entered by its own elements."""


def error_values(found: ExpectedError) -> dict[str, object]:
    """Return it for JSON and CSV."""

    def rounded(value: float | None, digits: int) -> float | None:
        return None if value is None else round(value, digits)

    return {
        "elements_grade": found.grade,
        "along_track_error_km": rounded(found.along_track_median_km, 2),
        "along_track_error_p90_km": rounded(found.along_track_p90_km, 2),
        "pointing_error_deg": rounded(found.pointing_median_deg, 3),
        "pointing_error_p90_deg": rounded(found.pointing_p90_deg, 3),
        "error_measured": found.measured,
        "error_unknown_because": found.unknown or None,
        "reentry_by_elements": None if found.reentry is None else f"{found.reentry:%Y-%m-%d}",
    }


def expected_error(elements: ElementSet, when: datetime, range_km: float | None = None) -> ExpectedError:
    """Return how far the satellite may be along its track at a time, and how far off a dish that believes the elements.

    `range_km` is how far away it then is: at closest for a pass, where the error is greatest. None: as close as it can
    be, at its perigee overhead.
    """
    age_s = (when - elements.epoch).total_seconds()
    orbit = orbit_class(elements)
    closest_km = max(perigee_km(elements), 100.0) if range_km is None else range_km
    age_h = abs(age_s) / 3600.0
    within = min(age_h, LONGEST_H)
    km = _along_track_km(elements, orbit, within)
    degrees = None if km is None else (_seen_deg(km[0], closest_km), _seen_deg(km[1], closest_km))
    measured = elements.norad_id == STATION
    grade = grade_of(degrees)
    if age_h > LONGEST_H:
        grade = worse(grade, "useless" if age_h > USELESS_H[orbit] else "doubtful")
    down = reentry(elements, when)
    if down is not None:
        grade = "useless"
    longest_s, clause = LONGEST_H * 3600.0, "" if down is None else reentry_words(down, when)
    unknown = unknown_words(age_s, degrees, longest_s=longest_s, down=clause)
    words = words_of(
        age_s, degrees, measured=measured, closest=range_km is None, longest_s=longest_s, down=clause
    )  # fmt: skip
    if unknown or km is None or degrees is None:
        return ExpectedError(
            age_s, None, None, None, None, grade, glyph_of(grade), words, orbit, measured, unknown, down
        )
    return ExpectedError(age_s, *km, *degrees, grade, glyph_of(grade), words, orbit, measured)


def orbit_class(elements: ElementSet) -> OrbitClass:
    """Return what kind of orbit it is: highly eccentric from 0.25 on, low up to 225 minutes, synchronous within 5 %."""
    if elements.eccentricity >= 0.25:
        return "HEO"
    if elements.mean_motion_rev_day >= 6.4:
        return "LEO"
    return "GEO" if abs(elements.mean_motion_rev_day - 1.0027) < 0.05 else "MEO"


def semi_major_axis_km(elements: ElementSet) -> float:
    """Return half the long axis of the orbit, by Kepler's third law."""
    rate = elements.mean_motion_rev_day * math.tau / 86400.0
    return math.cbrt(MU_KM3_S2 / rate**2)


def perigee_km(elements: ElementSet) -> float:
    """Return the height of the lowest point above the equator's radius."""
    return semi_major_axis_km(elements) * (1.0 - elements.eccentricity) - EARTH_KM


def _seen_deg(km: float, range_km: float) -> float:
    return math.degrees(math.atan2(km, range_km))


def _along_track_km(elements: ElementSet, orbit: OrbitClass, age_h: float) -> tuple[float, float] | None:
    """Return median and 90th percentile within the table; None for what falls too fast."""
    station = _of_station(age_h)
    if elements.norad_id == STATION:
        return station
    drag = _drag(elements, orbit)
    if drag > MOST_DRAG:
        return None
    size = semi_major_axis_km(elements) / STATION_AXIS_KM
    if orbit == "HEO":
        # An error of time is longest where the satellite is fastest, at perigee.
        size *= math.sqrt((1.0 + elements.eccentricity) / (1.0 - elements.eccentricity))
    found = []
    for at_epoch_km, of_station_km in zip(MEASURED[0][1:], station, strict=True):
        calm_km = at_epoch_km * size * (1.0 + age_h / 24.0)
        share = min(drag, 1.0)
        beyond_km = (drag - share) * (of_station_km - at_epoch_km)  # none falls faster at epoch
        found.append(calm_km * (1.0 - share) + of_station_km * share + beyond_km)
    return found[0], found[1]


def _of_station(age_h: float) -> tuple[float, float]:
    """Interpolate the table, both axes logarithmic. What is younger than its first line is as that: the fit itself."""
    if age_h <= MEASURED[0][0]:
        return MEASURED[0][1:]
    upper = next(index for index, row in enumerate(MEASURED) if row[0] >= age_h)
    below, above = MEASURED[upper - 1], MEASURED[upper]
    share = math.log(age_h / below[0]) / math.log(above[0] / below[0])
    median, p90 = (below[i] * (above[i] / below[i]) ** share for i in (1, 2))
    return median, p90


def _drag(elements: ElementSet, orbit: OrbitClass) -> float:
    """Return how much the air holds it up, in units of the station's drag."""
    if orbit in ("MEO", "GEO"):
        return 0.0
    # A negative decay is a manoeuvre or the Moon; of an eccentric orbit it is mostly the Moon.
    if orbit == "LEO" and elements.mean_motion_dot > 0.0:
        return elements.mean_motion_dot / STATION_DOT
    return math.exp(min((STATION_ALTITUDE_KM - perigee_km(elements)) / SCALE_HEIGHT_KM, 10.0))
