"""What a dish can be peaked on now: Sun, Moon, and the places of the geostationary arc."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from datetime import datetime
from typing import TYPE_CHECKING

from birdcage.calibration.expected import expected
from birdcage.calibration.peak import SLOT_RISE_DB, sigma_by_hand
from birdcage.sky.ephemeris.bodies import BODIES
from birdcage.sky.rise import LEAST_DB, Ear, expected_rise_db
from birdcage.sky.slots import slots
from birdcage.sky.targets.model import BodyTarget, SlotTarget

if TYPE_CHECKING:
    from birdcage.base.config import FeedProfile
    from birdcage.sky.observer import Observer
    from birdcage.sky.targets.model import Target
    from birdcage.tracking.planning.refraction import Refraction

BANDS_HZ = {"Ku": (10.7e9, 12.75e9), "L": (1.52e9, 1.71e9), "Ka": (18.3e9, 20.2e9)}
"""What slots send in, by the bands of `birdcage.sky.slots`."""


@dataclass(frozen=True, slots=True)
class Candidate:
    """An object that is up and in reach."""

    target: Target
    az_deg: float
    """True, refraction included."""
    el_deg: float
    sigma_deg: float
    """How well a person would find its middle."""
    rise_db: float | None

    @property
    def name(self) -> str:
        """What it is called."""
        return self.target.name


def candidates(
    observer: Observer, when: datetime, feed: FeedProfile, allowed: Callable[[float, float], bool],
    refraction: Refraction = "radio",
) -> tuple[Candidate, ...]:  # fmt: skip
    """Return what is up, in reach, and not known to be beyond this feed's hearing."""
    return tuple(
        each for each in _all(observer, when, feed, refraction) if each.el_deg > 0 and allowed(each.az_deg, each.el_deg)
    )


def _all(observer: Observer, when: datetime, feed: FeedProfile, refraction: Refraction) -> Iterator[Candidate]:
    ear = Ear.of(feed)
    for name in ("sun", "moon"):
        body = BodyTarget(BODIES[name])
        rise_db = expected_rise_db(body, body.look(observer, when), ear)
        if rise_db is None or rise_db >= LEAST_DB:
            az_deg, el_deg = expected(body, observer, when, refraction)
            yield Candidate(body, az_deg, el_deg, sigma_by_hand(rise_db, feed.beam_deg), rise_db)
    for slot in slots():
        if slot.is_empty or not _in_band(feed, *BANDS_HZ[slot.band]):
            continue
        there = SlotTarget(slot)
        az_deg, el_deg = expected(there, observer, when, refraction)
        yield Candidate(there, az_deg, el_deg, sigma_by_hand(SLOT_RISE_DB, feed.beam_deg), None)


def _in_band(feed: FeedProfile, low_hz: float, high_hz: float) -> bool:
    """Return whether a feed may hear a band; one that does not say what it hears may."""
    above = feed.freq_max_hz is None or feed.freq_max_hz >= low_hz
    return above and (feed.freq_min_hz is None or feed.freq_min_hz <= high_hz)
