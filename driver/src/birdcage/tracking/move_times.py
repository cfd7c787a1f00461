"""Many moves at once, from rest to rest: how long each takes, and how far it has come at a time."""

from __future__ import annotations

import numpy as np

from birdcage.rotator.axis import Axis, MeasuredTimes
from birdcage.tracking.curve import Floats


def durations(axis: Axis, ways_deg: Floats) -> Floats:
    """Return the seconds that an axis takes over each way, as `antenna.motion.plan_axis` has them."""
    ways = np.abs(ways_deg)
    if axis.times is not None:
        return _measured(axis.times, ways)
    ramps = axis.speed_deg_s / axis.acceleration_deg_s2
    long = ways >= axis.speed_deg_s * ramps
    return np.where(long, ways / axis.speed_deg_s + ramps, 2.0 * np.sqrt(ways / axis.acceleration_deg_s2))


def _measured(times: MeasuredTimes, ways: Floats) -> Floats:
    """Return `times.seconds` of each way."""
    law = times.scale_s * np.log(times.per_deg * np.maximum(ways, times.from_deg)) - times.less_s
    last_deg, last_s = times.steps[-1]
    share = np.minimum((ways - last_deg) / (times.from_deg - last_deg), 1.0)
    found: Floats = last_s + (law - last_s) * share
    for longest, seconds in reversed(times.steps):
        found = np.where(ways <= longest, seconds, found)
    return np.where(ways == 0.0, 0.0, found)


def ramps(axis: Axis, lasting_s: Floats) -> Floats:
    """Return what part of each move is speeding up; the same part is slowing down. At most a half."""
    if axis.times is not None:
        return np.full_like(lasting_s, 0.5)
    return np.minimum(axis.speed_deg_s / axis.acceleration_deg_s2 / np.maximum(lasting_s, 1e-9), 0.5)


def progress(share: Floats, ramp: Floats) -> Floats:
    """Return how much of its way an axis has gone after a share of its time, where `ramp` of it is speeding up."""
    share = np.minimum(np.maximum(share, 0.0), 1.0)  # np.clip takes longer than all the rest
    near = np.minimum(share, 1.0 - share)
    speeding = near * near / (2.0 * ramp * (1.0 - ramp))
    steady = (near - ramp / 2.0) / (1.0 - ramp)
    gone = np.where(near < ramp, speeding, steady)
    return np.where(share < 0.5, gone, 1.0 - gone)
