"""The five terms of the pointing model, what is believed of them beforehand, and how many can be fitted."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, fields

from birdcage.antenna.alignment import Alignment
from birdcage.antenna.pointing_model import tilt_of_base
from birdcage.base.config.sections import AlignmentSettings
from birdcage.base.geometry import shortest_turn, wrap_360
from birdcage.calibration.peak import MeasuredPeak

TERMS = tuple(each.name for each in fields(Alignment) if each.init)
"""az_offset_deg, el_offset_deg, ca_deg, an_deg, aw_deg: in this order everywhere in this room."""

OFFSETS_ONLY = TERMS[:2]
WITH_TILT = ("az_offset_deg", "el_offset_deg", "an_deg", "aw_deg")

AZ_SIGMA_DEG = 30.0
EL_SIGMA_DEG = 3.0
CA_SIGMA_DEG = 0.3
TILT_SIGMA_DEG = 1.0
"""Of an unmeasured base, put up by eye."""
LEVEL_SIGMA_DEG = 0.3
"""Of one that was measured with a phone in Setup."""


@dataclass(frozen=True, slots=True)
class Priors:
    """What each term is believed to be, and how well: the ridge of the fit."""

    mean: tuple[float, ...]
    sigma: tuple[float, ...]
    leveled: bool = False
    """Whether the tilt was measured in Setup."""

    @property
    def alignment(self) -> Alignment:
        """The terms that are believed."""
        return Alignment(*self.mean)


def priors_of(
    settings: AlignmentSettings, peaks: Sequence[MeasuredPeak], feed_deg: tuple[float, float] = (0.0, 0.0)
) -> Priors:
    """Return what is believed before a fit: the level of the base from Setup, the azimuth from the peaks themselves.

    Without a peak the azimuth is believed to be what the settings say. `feed_deg` is how far the feed looks aside, in
    azimuth and elevation: the terms here are those of dish and feed together.
    """
    az_deg = settings.az_offset_deg + feed_deg[0]
    if peaks:
        turns = [math.radians(peak.true_az_deg - peak.dish_az_deg) for peak in peaks]
        north = sum(peak.weight * math.cos(turn) for peak, turn in zip(peaks, turns, strict=True))
        east = sum(peak.weight * math.sin(turn) for peak, turn in zip(peaks, turns, strict=True))
        az_deg = shortest_turn(0.0, wrap_360(math.degrees(math.atan2(east, north))))
    leveled = settings.pitch_deg is not None and settings.roll_deg is not None
    an_deg = aw_deg = 0.0
    if settings.pitch_deg is not None and settings.roll_deg is not None:
        an_deg, aw_deg = tilt_of_base(settings.pitch_deg, settings.roll_deg, az_deg - feed_deg[0])
    tilt = LEVEL_SIGMA_DEG if leveled else TILT_SIGMA_DEG
    return Priors(
        (az_deg, feed_deg[1], 0.0, an_deg, aw_deg), (AZ_SIGMA_DEG, EL_SIGMA_DEG, CA_SIGMA_DEG, tilt, tilt), leveled
    )


def terms_for(count: int) -> tuple[str, ...]:
    """Return which terms so many peaks can carry: the offsets, from three on the tilt, from four on all five."""
    return OFFSETS_ONLY if count < 3 else WITH_TILT if count == 3 else TERMS
