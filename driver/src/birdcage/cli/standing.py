"""Whether a dish that is not asked could point somewhere, by what the settings say of it."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from birdcage.cli.options import Wanted
    from birdcage.sky.look import LookAngle
    from birdcage.sky.reach_limits import ReachLimits


def limits_of(wanted: Wanted) -> ReachLimits:
    """Return what limits the dish that somebody named; without a name only the settings limit anything."""
    from birdcage.station.reach_limits import reach_limits

    return reach_limits(wanted.settings, wanted.named_model)


def what_stands_in_the_way(wanted: Wanted) -> Callable[[LookAngle], str | None]:
    """Return what says of a direction why the dish cannot hear anything there.

    It is empty if nothing is known against it, and None if that is not known: no dish or floor was named, or
    the settings that limit motion could not be read. How far the cable has turned is a matter for the dish itself.
    """
    from birdcage.sky.reach_checks import checks_of
    from birdcage.sky.reach_model import LossReason

    known = wanted.named_model is not None or wanted.settings.motion.min_elevation_deg is not None
    known = known and wanted.settings.motion_problem is None
    limits = limits_of(wanted)
    checks = checks_of(limits)
    words = {
        LossReason.FLOOR: f"below the floor of {limits.el_floor_deg:g}°",
        LossReason.CEILING: f"above the ceiling of {limits.el_ceiling_deg:g}°",
        LossReason.HORIZON: "behind the horizon of this place",
    }

    def judge(look: LookAngle) -> str | None:
        if look.el_deg <= 0.0:
            return "below the horizon"
        if not known:
            return None
        broken = next((each.cause for each in checks if each.of_point(look.az_deg, look.el_deg) < 0.0), None)
        return "" if broken is None else words.get(broken.reason, broken.words)

    return judge
