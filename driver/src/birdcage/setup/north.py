"""From what was seen to the offsets of the alignment: true = the dish's own + offset."""

from __future__ import annotations

from datetime import UTC, datetime

from birdcage.base.config import PlaceSettings
from birdcage.base.errors import BirdcageError
from birdcage.base.geometry import shortest_turn
from birdcage.base.reason import Reason
from birdcage.setup.context import SetupContext
from birdcage.setup.steps.base import Step
from birdcage.sky.magnetic import declination_deg
from birdcage.sky.sun import sun
from birdcage.station.state import Activity, Pointing

LONGEST_CLOCK_S = 10.0
"""A clock further off than this moves the Sun by more than 0.04 degrees."""
FAR_DEG = 10.0
"""Dish and Sun further apart in elevation than this: the shadow is not in mid-dish."""
EARLIEST = datetime(2025, 1, 1, tzinfo=UTC)
"""A machine without a battery wakes up long before this."""


class NotYet(BirdcageError):
    """North can't be set this way now; the message says what is missing."""

    reason = Reason.NOT_YET


def az_offset_deg(true_az_deg: float, dish_az_deg: float) -> float:
    """Return what is added to the dish's azimuth to get the true one, in -180 to 180."""
    return round(shortest_turn(dish_az_deg, true_az_deg), 2) + 0.0


def sun_now(bench: SetupContext) -> tuple[float, float]:
    """Return the Sun's true azimuth and elevation now. NotYet while the place is unknown."""
    place = bench.settings.place
    if place.latitude_deg is None or place.longitude_deg is None:
        raise NotYet("No location set. Set it in step 9.")
    return sun(bench.utc, place.latitude_deg, place.longitude_deg)


def usable_sun(bench: SetupContext) -> tuple[float, float]:
    """Return the Sun as a mark to measure by. NotYet: place or clock unknown, or the Sun below the dish's floor."""
    az_deg, el_deg = sun_now(bench)
    offset_s = bench.settings.setup.clock_offset_s
    if bench.utc < EARLIEST:
        raise NotYet(f"This machine's clock says {bench.utc:%Y-%m-%d}: set it, then compare it in step 9.")
    if offset_s is None:
        raise NotYet("The clock is unchecked. Compare it, or trust it, in step 9.")
    if abs(offset_s) > LONGEST_CLOCK_S:
        raise NotYet(f"This machine's clock was {offset_s:+g} s off: set it, then compare again in step 9.")
    floor = bench.state.el_min_deg
    if el_deg < (0.0 if floor is None else floor):
        where = "below the horizon" if el_deg < 0 else f"at {el_deg:.1f}°, below the dish's floor"
        raise NotYet(f"The Sun is {where}: wait, or use another way.")
    ceiling = bench.state.el_max_deg
    if ceiling is not None and el_deg > ceiling:
        raise NotYet(f"The Sun is at {el_deg:.1f}°, above the dish's ceiling: wait, or use another way.")
    return az_deg, el_deg


def resting_position(bench: SetupContext) -> Pointing:
    """Return where the dish stands. NotYet: not known, not read just now, or it moves."""
    position = bench.position
    if position is None:
        lost = bench.state.position_lost
        raise NotYet(f"The dish's direction is unknown{f' ({lost})' if lost else ''}: home it, step 4.")
    if bench.state.motion is not None or bench.state.activity is not Activity.IDLE:
        raise NotYet("The dish is moving. Wait until it rests.")
    return position


def declination(bench: SetupContext) -> float | None:
    """Return the magnetic declination of the place, as typed or by the model; None when it is not known."""
    place: PlaceSettings = bench.settings.place
    if place.declination_deg is not None:
        return place.declination_deg
    if place.latitude_deg is None or place.longitude_deg is None:
        return None
    return declination_deg(bench.utc, place.latitude_deg, place.longitude_deg, place.height_m)


def ready_for_sun(step: Step) -> str:
    """Say why the Sun can't be used now; empty when it can."""
    try:
        usable_sun(step.bench)
    except NotYet as missing:
        return str(missing)
    return ""
