"""Where a target stands over time: a dense curve of true directions, lifted by refraction."""

from __future__ import annotations

import math
from datetime import UTC, datetime

import numpy as np

from birdcage.base.errors import BirdcageError
from birdcage.sky.observer import Observer
from birdcage.sky.propagate import track
from birdcage.sky.targets.model import NoPosition, Satellite, Target
from birdcage.tracking.curve import Curve, Floats
from birdcage.tracking.planning.refraction import Refraction, lift_deg

_STEP_S = 0.25
_POINTS = 3000
"""Points of a long curve, where that makes steps longer than `_STEP_S`."""
_FINE_S = 0.05
_SWEEPS_DEG_S = 2.0
"""Where the azimuth turns faster than this, near the zenith, steps are fine."""
_NODES = 12
_NODES_AN_HOUR = 3.0
"""Nodes of a Chebyshev series through what turns with the sky: good to a millionth of a degree."""
_TABLE_S = 20.0
_ZENITH_DEG = 80.0
"""Above this a body, too, sweeps in azimuth."""


def sky_path(
    target: Target,
    observer: Observer,
    start_s: float,
    end_s: float,
    *,
    refraction: Refraction = "radio",
    time_offset_s: float = 0.0,
) -> Curve:
    """Return where a target stands from one time to another (POSIX seconds), azimuth unrolled.

    `time_offset_s` is how much later than computed it comes, beyond what the target itself says. BirdcageError where
    a position is not known, ValueError for a span that is none.
    """
    if not (math.isfinite(start_s) and math.isfinite(end_s) and end_s > start_s):
        raise ValueError("a path begins before it ends")
    if isinstance(target, Satellite):
        t, az, el = _satellite(target, observer, start_s, end_s, time_offset_s)
    elif target.kind in ("slot", "fixed"):
        seen = target.look(observer, datetime.fromtimestamp(start_s, UTC))
        t = np.linspace(start_s, end_s, 4)
        az, el = np.full(4, seen.az_deg), np.full(4, seen.el_deg)
    else:
        t, az, el = _turning(target, observer, start_s, end_s)
    # A curve begins in 0..360, as the turns of the cable are counted from there.
    return Curve(t, np.unwrap(az, period=360.0), np.minimum(el + lift_deg(el, refraction), 90.0))


def _satellite(
    target: Satellite, observer: Observer, start_s: float, end_s: float, time_offset_s: float
) -> tuple[Floats, Floats, Floats]:
    offset_s = target.time_offset_s + time_offset_s
    count = max(4, math.ceil((end_s - start_s) / max(_STEP_S, (end_s - start_s) / _POINTS)) + 1)
    t = np.linspace(start_s, end_s, count)
    seen = track(target.elements, observer, t, offset_s)
    if np.isnan(seen.el_deg).any():
        raise NoPosition(
            f"The elements of {target.name} (epoch {target.elements.epoch:%Y-%m-%d}) give no position for all of "
            "that time: it decays, or they are damaged."
        )
    az = np.unwrap(seen.az_deg, period=360.0)
    sweeping = np.flatnonzero(np.abs(np.diff(az) / np.diff(t)) > _SWEEPS_DEG_S)
    if not len(sweeping):
        return t, az, seen.el_deg
    fine = [
        np.arange(t[max(part[0] - 8, 0)], t[min(part[-1] + 9, count - 1)], _FINE_S)
        for part in np.split(sweeping, np.flatnonzero(np.diff(sweeping) > 1) + 1)
    ]
    t = np.unique(np.round(np.concatenate([t, *fine]), 4))
    t = np.concatenate([t[:1], t[1:][np.diff(t) > _FINE_S / 10.0]])
    seen = track(target.elements, observer, t, offset_s)
    return t, seen.az_deg, seen.el_deg


def _turning(target: Target, observer: Observer, start_s: float, end_s: float) -> tuple[Floats, Floats, Floats]:
    """Return what turns with the sky: looked up at a few nodes, and a series through its direction between them."""
    span_s = end_s - start_s
    count = math.ceil(_NODES + _NODES_AN_HOUR * span_s / 3600.0)
    nodes = np.cos(np.pi * (np.arange(count) + 0.5) / count)
    looks = [
        target.look(observer, datetime.fromtimestamp(float(start_s + span_s * (x + 1.0) / 2.0), UTC)) for x in nodes
    ]
    az, el = (np.radians([getattr(look, name) for look in looks]) for name in ("az_deg", "el_deg"))
    if not np.isfinite(el).all():
        raise BirdcageError(f"Where {target.name} stands is not known for all of that time.")
    vectors = np.stack([np.sin(az) * np.cos(el), np.cos(az) * np.cos(el), np.sin(el)], axis=1)
    series = np.polynomial.chebyshev.chebfit(nodes, vectors, count - 1)
    step_s = _TABLE_S if np.degrees(el).max() < _ZENITH_DEG else 1.0
    t = np.linspace(start_s, end_s, max(4, math.ceil(span_s / step_s) + 1))
    east, north, up = np.polynomial.chebyshev.chebval(2.0 * (t - start_s) / span_s - 1.0, series)
    return t, np.degrees(np.arctan2(east, north)) % 360.0, np.degrees(np.arctan2(up, np.hypot(east, north)))
