"""How much more a feed hears with a body of the solar system in its beam than beside it: the rise, in dB.

A disc of even brightness in the middle of a Gaussian beam, over a system noise that is the user's setting. Air, spill
past the dish and the mesh of the reflector are left out: the true rise is rather a little less.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from itertools import pairwise
from types import MappingProxyType
from typing import TYPE_CHECKING

from birdcage.sky.ephemeris.bodies import Body
from birdcage.sky.targets.model import BodyTarget

if TYPE_CHECKING:
    from birdcage.base.beam import Beam
    from birdcage.base.config import FeedProfile
    from birdcage.sky.look import LookAngle
    from birdcage.sky.targets.model import Target

LEAST_DB = 0.01
"""Below this nothing of it is seen on the meters of these dishes."""

QUIET_SUN_K = (
    (0.05, 1e6), (0.2, 1e6), (1.0, 2e5), (2.0, 9e4), (3.0, 4.5e4), (4.0, 2.9e4), (5.0, 2e4), (6.0, 1.6e4), (7.0, 1.4e4),
    (8.0, 1.3e4), (9.0, 1.2e4), (10.0, 1e4), (20.0, 7e3), (30.0, 6.3e3), (40.0, 6.2e3), (50.0, 6e3), (100.0, 6e3),
)  # fmt: skip
"""Brightness of the quiet Sun in kelvins by GHz, off figure 12 of Recommendation ITU-R P.372-14.

Spots add to it: at 10.7 cm the flux goes from about 65 units at the quietest to over 200 in years of many. They add
less at shorter waves; by how much was not looked up, and nothing is allowed for it.
"""

DISC_K: Mapping[str, float] = MappingProxyType(
    {
        "Moon": 220.0,
        "Mercury": 400.0,
        "Venus": 600.0,
        "Mars": 190.0,
        "Jupiter": 290.0,
        "Saturn": 190.0,
        "Uranus": 200.0,
        "Neptune": 200.0,
    }
)
"""Brightness at centimetre wavelengths in kelvins, rounded.

The Moon's hardly changes over a month below 10 GHz, and the more the higher (radio-science-institute.eu, *Moon*).
Venus, Mars, Jupiter and Saturn were measured at 6 cm at 630, 190, 291 and 190 K, within 30 to 60 K (*Planetary
observations at a wavelength of 6 cm*, 1965 and 1966), Venus at 3 cm at 560 K (Mayer and others, 1956). Those of
Mercury, Uranus and Neptune are assumptions. No dish of this size hears a planet: tens of percent would change nothing.
"""


@dataclass(frozen=True, slots=True)
class Ear:
    """What a feed hears with."""

    beam: Beam
    freq_hz: float
    system_k: float
    """Noise of receiver, ground and sky together, with nothing in the beam."""

    @classmethod
    def of(cls, feed: FeedProfile, beam: Beam | None) -> Ear | None:
        """Return that of a feed, at the middle of its band; None when the beam or its band is not known."""
        edges = [edge for edge in (feed.freq_min_hz, feed.freq_max_hz) if edge is not None]
        if beam is None or not edges:
            return None
        return cls(beam, sum(edges) / len(edges), feed.system_k)


def expected_rise_db(target: Target, look: LookAngle, ear: Ear | None) -> float | None:
    """Return the rise to expect with the dish on a target, in dB.

    None if unknown: for satellites, whatever stands on the arc, points of the sky, and a feed without beam or band.
    """
    if ear is None or look.range_km is None or not isinstance(target, BodyTarget):
        return None
    return body_rise_db(target.body, look.range_km, ear)


def body_rise_db(body: Body, range_km: float, ear: Ear) -> float | None:
    """Return the rise by one body from that far; None for the Sun outside 0.05 to 100 GHz."""
    bright_k = quiet_sun_k(ear.freq_hz) if body.name == "Sun" else DISC_K[body.name]
    if bright_k is None:
        return None
    # The share of a Gaussian beam that a disc in its middle covers; of an ellipse, as of the round one of its area.
    share = 1.0 - math.exp(-math.log(2.0) * (body.width_deg(range_km) / ear.beam.mean_deg) ** 2)
    return 10.0 * math.log10(1.0 + bright_k * share / ear.system_k)


def quiet_sun_k(freq_hz: float) -> float | None:
    """Return the brightness of the quiet Sun in kelvins, between the points of the table; None outside them."""
    ghz = freq_hz / 1e9
    for (low, low_k), (high, high_k) in pairwise(QUIET_SUN_K):
        if low <= ghz <= high:
            part = math.log(ghz / low) / math.log(high / low)
            return float(low_k * (high_k / low_k) ** part)
    return None


def rise_words(rise_db: float | None) -> str:
    """Return a rise for people: `2.0 dB`, `0.05 dB`, `under 0.01 dB`, or a dash."""
    if rise_db is None:
        return "-"
    if rise_db < LEAST_DB:
        return f"under {LEAST_DB} dB"
    return f"{rise_db:.1f} dB" if rise_db >= 1.0 else f"{rise_db:.2f} dB"
