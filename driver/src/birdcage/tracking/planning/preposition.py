"""Where the dish waits for its target, and when it leaves for there."""

from __future__ import annotations

from birdcage.tracking.curve import Curve
from birdcage.tracking.plan import Preposition
from birdcage.tracking.planning.routes import Route, route
from birdcage.tracking.planning.target_track import TargetTrack

_STOP_S = 1.0
"""For each stop on the way: the command, and until it is seen that the dish has come there."""


def preposition(track: TargetTrack, course: Curve, before_s: float, now_s: float) -> Preposition | None:
    """Return the first point of the course and the way there; None if no way is safe.

    `before_s`: how long before the first leg the dish is to be in place. While the position is not known the way has
    one stop, and begins early enough for the longest slew there is.
    """
    az, el = course.at(course.start_s)
    true_az, true_el = track.mount.alignment.to_true(az, el)
    model, standing = track.mount.model, track.mount.standing
    if standing is None:
        low, high = track.bounds.cable or (0.0, 360.0)
        longest = route(track.bounds, model, (az - (high - low), track.bounds.low_el_deg), (az, el))
        taken: Route | None = Route((az, el), ((az, el),), 60.0 if longest is None else longest.seconds)
    else:
        taken = route(track.bounds, model, (standing.az_deg, standing.el_deg), (az, el))
    if taken is None:
        return None
    leave_s = course.start_s - before_s - taken.seconds - _STOP_S * len(taken.stops)
    return Preposition(az, el, true_az % 360.0, true_el, taken.stops, max(leave_s, now_s), taken.seconds)
