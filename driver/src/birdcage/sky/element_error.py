"""How far beside a satellite a dish looks that believes its elements, over one stretch of time and from one place.

`sky.age` says how far off along its track the satellite may be. Here that becomes an angle at every moment: with `v`
the direction in which the satellite flies, `los` the line of sight, `R` the range and `d` the error along the track,

    angle = atan2(d |v x los|, R - d |v . los|)

Half of `d` is taken to be early and half late; the nearer of both counts, which looks larger. The track is taken to be
straight over `d`.
"""

from __future__ import annotations

from dataclasses import dataclass
from datetime import UTC, datetime

import numpy as np

from birdcage.sky.age import ExpectedError, expected_error
from birdcage.sky.elements import ElementSet
from birdcage.sky.frames import Floats, line_of_sight
from birdcage.sky.observer import Observer
from birdcage.sky.propagate import track

MADE_UP = "demo"
"""The source of orbits that exist in the demo alone: these have no error."""
POINTS = 121


@dataclass(frozen=True, slots=True, eq=False)
class ElementError:
    """What to expect of one element set from one time to another."""

    elements: ElementSet
    closest: ExpectedError
    """Age and grade at the moment of the least range, as the lists of passes tell them."""
    t_s: Floats
    """POSIX seconds."""
    median_deg: Floats | None
    """None if the error is not known, as `p90_deg`."""
    p90_deg: Floats | None
    """One case in ten is worse."""

    @property
    def unknown(self) -> str:
        """Why the error is not known; empty if it is."""
        return "" if self.median_deg is not None else self.closest.unknown


def element_error(
    elements: ElementSet, observer: Observer, start_s: float, end_s: float, time_offset_s: float = 0.0
) -> ElementError | None:
    """Return it from one time to another (POSIX seconds); None for a made-up orbit and where there is no position."""
    if elements.source == MADE_UP:
        return None
    t_s = np.linspace(start_s, end_s, POINTS)
    seen = track(elements, observer, t_s, time_offset_s)
    if not np.isfinite(seen.range_km).all():
        return None
    nearest = int(np.argmin(seen.range_km))
    closest = expected_error(elements, datetime.fromtimestamp(float(t_s[nearest]), UTC), float(seen.range_km[nearest]))
    sight = line_of_sight(observer, t_s, seen.position_km)
    along = np.abs(np.sum(seen.velocity_km_s * sight, axis=1)) / np.linalg.norm(seen.velocity_km_s, axis=1)
    across = np.sqrt(np.clip(1.0 - along**2, 0.0, 1.0))

    def angles(km: float | None) -> Floats | None:
        if km is None:
            return None
        found: Floats = np.degrees(np.arctan2(km * across, seen.range_km - km * along))
        return found

    return ElementError(
        elements, closest, t_s, angles(closest.along_track_median_km), angles(closest.along_track_p90_km)
    )  # fmt: skip
