"""What a dish can be peaked on now: Sun, Moon, and the places of the geostationary arc."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from datetime import datetime
from typing import TYPE_CHECKING

from birdcage.calibration.peak import SLOT_RISE_DB, sigma_by_hand
from birdcage.sky.downlinks_hearing import may_hear_slot
from birdcage.sky.downlinks_read import load_downlinks
from birdcage.sky.ephemeris.bodies import BODIES
from birdcage.sky.rise import LEAST_DB, Ear, expected_rise_db
from birdcage.sky.slots import slots
from birdcage.sky.targets.model import BodyTarget, SlotTarget

if TYPE_CHECKING:
    from birdcage.base.beam import Beam
    from birdcage.base.config import FeedProfile
    from birdcage.sky.observer import Observer
    from birdcage.sky.targets.model import Target
    from birdcage.tracking.planning.refraction import Refraction


@dataclass(frozen=True, slots=True)
class CalibrationObject:
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
    refraction: Refraction = "radio", beam: Beam | None = None,
) -> tuple[CalibrationObject, ...]:  # fmt: skip
    """Return what is up, in reach, and not known to be beyond this feed's hearing."""
    return tuple(
        each
        for each in _all(observer, when, feed, refraction, beam)
        if each.el_deg > 0 and allowed(each.az_deg, each.el_deg)
    )


def _all(
    observer: Observer, when: datetime, feed: FeedProfile, refraction: Refraction, beam: Beam | None
) -> Iterator[CalibrationObject]:
    ear = Ear.of(feed, beam)
    for name in ("sun", "moon"):
        body = BodyTarget(BODIES[name])
        rise_db = expected_rise_db(body, body.look(observer, when), ear)
        if rise_db is None or rise_db >= LEAST_DB:
            az_deg, el_deg = expected(body, observer, when, refraction)
            yield CalibrationObject(body, az_deg, el_deg, sigma_by_hand(rise_db, beam), rise_db)
    table = load_downlinks()
    for slot in slots():
        if slot.is_empty or not may_hear_slot(slot, feed, table):
            continue
        there = SlotTarget(slot)
        az_deg, el_deg = expected(there, observer, when, refraction)
        yield CalibrationObject(there, az_deg, el_deg, sigma_by_hand(SLOT_RISE_DB, beam), None)


def expected(
    target: Target, observer: Observer, when: datetime, refraction: Refraction = "radio"
) -> tuple[float, float]:
    """Return true azimuth and elevation of an object, refraction included. BirdcageError where that is not known."""
    from birdcage.tracking.planning.refraction import lift_deg

    seen = target.look(observer, when)
    return seen.az_deg, seen.el_deg + float(lift_deg(seen.el_deg, refraction))
