"""How fast the axes of a dish can follow, all the time and in turn."""

from __future__ import annotations

import numpy as np

from birdcage.rotator.axis import Axis
from birdcage.rotator.facts import Facts
from birdcage.tracking.curve import Floats

FIRST_SHARE = 0.9
"""What part of its time the azimuth gets at first, where the axes move in turn: the best of its neighbours in
three rehearsals of four."""
SHARES = (0.85, 0.9, 0.95, 1.0)
HOLDS = (0.0, 1.3, 2.3)
"""How far below the top the elevation may stay in a keyhole, in units of its physical limit: 2.6 is the goal."""
_TURN_DEG = 90.0
"""Where only times of moves are known, the rate is the mean over a move of this length: half a keyhole's turn."""
_MARGIN = 0.98
"""What of its speed is planned with, where the axes move together: speeding up takes time as well."""
_LEAST = 0.05
_STILL = 0.95
"""What part of its time the azimuth gets while the elevation stays: nothing changes over, but it does speed up."""


def mean_rate_deg_s(axis: Axis) -> float:
    """Return how fast an axis turns on a way that matters in the keyhole, as `reach` takes it."""
    return axis.speed_deg_s if axis.times is None else _TURN_DEG / axis.times.seconds(_TURN_DEG)


def azimuth_rates_deg_s(model: Facts, t_s: Floats, el_deg: Floats, share: float | None) -> Floats:
    """Return how fast the azimuth can be turned at each time while the elevation follows.

    Axes that move in turn leave the azimuth what the elevation does not take, times `share`.
    """
    rate = mean_rate_deg_s(model.azimuth)
    if share is None:
        return np.full(len(t_s), rate * _MARGIN)
    busy = np.abs(np.gradient(el_deg, t_s)) / mean_rate_deg_s(model.elevation)
    shares = np.where(busy > 0.0, share, max(share, _STILL))
    rates: Floats = rate * np.maximum((1.0 - busy) * shares, _LEAST)
    return rates
