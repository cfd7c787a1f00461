"""How long a Trav'ler takes for a move: the only measured figures there are (`docs/reference/travler.md`, *Times*).

t = 0.3 s below 0.5 degrees, 0.5 s up to 1 degree, else 3.23 ln(0.84 d) - 0.48 seconds. Between 1 and 2 degrees the
source takes the absolute value of a sum that changes its sign there; here a straight line joins the two ends.
The same for azimuth and elevation; for skew (assumed).
"""

from __future__ import annotations

import math

LINE_DEG = 1.0, 2.0


def move_time(turn_deg: float) -> float:
    """Return the seconds that a turn of so many degrees takes, from rest to rest."""
    if turn_deg <= 0.0:
        return 0.0
    if turn_deg < 0.5:
        return 0.3
    start, end = LINE_DEG
    if turn_deg <= start:
        return 0.5
    if turn_deg < end:
        return 0.5 + (turn_deg - start) / (end - start) * (_law(end) - 0.5)
    return _law(turn_deg)


def rate_for(turn_deg: float, accel_deg_s2: float) -> float:
    """Return the highest rate of the trapezoid that takes `move_time`; inf when speeding up takes longer than that."""
    time_s = move_time(turn_deg)
    room = (accel_deg_s2 * time_s) ** 2 - 4.0 * accel_deg_s2 * turn_deg
    if time_s == 0.0 or room <= 0.0:
        return math.inf
    return (accel_deg_s2 * time_s - math.sqrt(room)) / 2.0


def _law(turn_deg: float) -> float:
    return 3.23 * math.log(0.84 * turn_deg) - 0.48
