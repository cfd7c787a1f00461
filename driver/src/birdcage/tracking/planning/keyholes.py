"""The keyholes of a plan: where it leaves its target because the azimuth cannot keep up."""

from __future__ import annotations

import numpy as np

from birdcage.base.beam import Beam
from birdcage.tracking.curve import Curve
from birdcage.tracking.plan import Forecast, Keyhole
from birdcage.tracking.planning.course import limit_deg
from birdcage.tracking.planning.forecast import saw_tooth_deg, separations_deg
from birdcage.tracking.planning.itinerary import TrackSegment
from birdcage.tracking.planning.target_track import TargetTrack

_SEEN_DEG = 0.03
"""A course that is off by less than this follows its target: three steps of a motor."""
_NEAR_S = 5.0


def keyholes(
    track: TargetTrack, stretches: tuple[TrackSegment, ...], course: Curve, beam: Beam | None
) -> tuple[Keyhole, ...]:
    """Return where the course leads or lags in azimuth."""
    t = course.t_s
    az, el = track.dish.sample(t)
    el = np.clip(el, *track.elevations(t))
    off = separations_deg(course.az_deg, course.el_deg, az, el)
    inside = np.zeros(len(t), dtype=np.bool_)
    for one in stretches:
        inside |= (t >= one.start_s) & (t <= one.end_s)
    where = np.flatnonzero(inside & (off > _SEEN_DEG))
    if not len(where):
        return ()
    found = []
    peaks = np.hypot(off, saw_tooth_deg(track.mount.model, course, t, stretches)[1])
    for part in np.split(where, np.flatnonzero(np.diff(t[where]) > _NEAR_S) + 1):
        start, end = float(t[part[0]]), float(t[part[-1]])
        worst = float(peaks[part].max())
        limit = limit_deg(track, stretches, start, end)
        found.append(Keyhole(start, end, worst, limit, None if beam is None else beam.most_loss_db(worst)))
    return tuple(found)


def simulated(holes: tuple[Keyhole, ...], forecast: Forecast, beam: Beam | None) -> tuple[Keyhole, ...]:
    """Return the keyholes with the errors that a simulation of the pass has shown."""
    found = []
    for hole in holes:
        inside = (forecast.t_s >= hole.start_s) & (forecast.t_s <= hole.end_s)
        error = float(forecast.error_deg[inside].max()) if inside.any() else hole.max_error_deg
        loss = None if beam is None else beam.most_loss_db(error)
        found.append(Keyhole(hole.start_s, hole.end_s, error, hole.limit_deg, loss))
    return tuple(found)
