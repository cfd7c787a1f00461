"""Looks a day ahead of what does not pass."""

from __future__ import annotations

from birdcage.base.errors import BirdcageError
from birdcage.sky.observer import Observer
from birdcage.sky.targets.model import Target
from birdcage.tracking.day import HOURS, Day
from birdcage.tracking.mount import Mount
from birdcage.tracking.planning.limit_words import where_words
from birdcage.tracking.planning.refraction import Refraction, lift_deg
from birdcage.tracking.planning.sky_path import sky_path
from birdcage.tracking.planning.target_track import TargetTrack


def day_ahead(
    target: Target, observer: Observer, mount: Mount, start_s: float, refraction: Refraction, time_offset_s: float
) -> Day | None:
    """Return the day from a time on (POSIX seconds); None if a position is not known for all of it."""
    end_s = start_s + HOURS * 3600.0
    try:
        sky = sky_path(target, observer, start_s, end_s, refraction=refraction, time_offset_s=time_offset_s)
    except BirdcageError:
        return None
    reach = TargetTrack.of(sky, mount).reached()
    limits = tuple(where_words(cause, mount.limits) for cause in reach.lost_s)
    return Day(sky, reach, limits, float(lift_deg(0.0, refraction)))
