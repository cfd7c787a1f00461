"""Where an object is to be seen: as computed, and lifted by the air."""

from __future__ import annotations

from datetime import datetime
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from birdcage.sky.observer import Observer
    from birdcage.sky.targets.model import Target
    from birdcage.tracking.planning.refraction import Refraction


def expected(
    target: Target, observer: Observer, when: datetime, refraction: Refraction = "radio"
) -> tuple[float, float]:
    """Return true azimuth and elevation of an object, refraction included. BirdcageError where that is not known."""
    from birdcage.tracking.planning.refraction import lift_deg

    seen = target.look(observer, when)
    return seen.az_deg, seen.el_deg + float(lift_deg(seen.el_deg, refraction))
