"""Whether a dish that is not asked could point somewhere, by what the settings say of it."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from birdcage.base.config import Settings
    from birdcage.cli.options import Wanted
    from birdcage.sky.horizon import HorizonMask
    from birdcage.sky.look import LookAngle


def what_stands_in_the_way(look: LookAngle, wanted: Wanted) -> str | None:
    """Return why the dish cannot hear anything there; empty if nothing is known against it, None if it is not known.

    Floor and ceiling are the narrower of the settings' and of the firmware's, if somebody named one; then come the
    horizon and the no-go sectors. How far the cable has turned is a matter for the dish itself.
    """
    from birdcage.sky.reach_checks import checks_of
    from birdcage.sky.reach_limits import NoGo, ReachLimits

    if look.el_deg <= 0.0:
        return "below the horizon"
    settings = wanted.settings
    bounds = _bounds(wanted)
    if bounds is None or settings.motion_problem is not None:
        return None
    floor_deg, ceiling_deg = bounds
    limits = ReachLimits(
        el_floor_deg=floor_deg,
        el_ceiling_deg=ceiling_deg,
        horizon=_horizon(settings),
        no_go=tuple(NoGo(*sector) for sector in settings.motion.no_go_sectors),
    )
    words = {
        "floor": f"below the floor of {floor_deg:g}°",
        "ceiling": f"above the ceiling of {ceiling_deg:g}°",
        "horizon": "behind the horizon of this place",
    }
    broken = next((each.reason for each in checks_of(limits) if each.of_point(look.az_deg, look.el_deg) < 0.0), None)
    return "" if broken is None else words.get(broken, broken)


def _bounds(wanted: Wanted) -> tuple[float, float] | None:
    """Return floor and ceiling in true degrees; None when neither the settings nor a firmware tell the floor."""
    motion, offset_deg = wanted.settings.motion, wanted.settings.alignment.el_offset_deg
    axis = wanted.model.elevation if wanted.firmware_given and wanted.model is not None else None
    own = (axis.min_deg, axis.max_deg) if axis is not None else (None, None)
    floors = [each for each in (motion.min_elevation_deg, own[0]) if each is not None]
    ceilings = [each for each in (motion.max_elevation_deg, own[1]) if each is not None]
    if not floors:
        return None
    return max(floors) + offset_deg, (min(ceilings) + offset_deg if ceilings else 180.0)


def _horizon(settings: Settings) -> HorizonMask | None:
    from birdcage.sky.horizon import HorizonMask

    return HorizonMask(settings.place.horizon) if settings.place.horizon else None
