"""Predictive overshoot for streams of targets (`docs/reference/published-interface.md`, *Leapfrog*)."""

from __future__ import annotations

from birdcage.base.geometry import shortest_turn, wrap_360

FULL_TURN_DEG = 360.0


def overshoot(delta_deg: float) -> float:
    """Return how far beyond the target to aim: 1 deg for more than 2, 0.5 for more than 1, else 0, with the sign."""
    size = 1.0 if abs(delta_deg) > 2.0 else 0.5 if abs(delta_deg) > 1.0 else 0.0
    return size if delta_deg > 0 else -size


def apply_leapfrog(target_az: float, target_el: float, current_az: float, current_el: float) -> tuple[float, float]:
    """Apply predictive overshoot to compensate for mechanical lag.

    `current_*` must be a position that was read, never an assumed one. Within one turn, azimuth takes the shorter way
    round and is returned in [0, 360). Where either azimuth is beyond 360, both count turns, as on a dish whose azimuth
    goes on to 455: the way is their plain difference, and the turn is kept. Elevation is not limited here. All in
    degrees.
    """
    adjusted_el = target_el + overshoot(target_el - current_el)
    if max(target_az, current_az) > FULL_TURN_DEG:
        return target_az + overshoot(target_az - current_az), adjusted_el
    turn = shortest_turn(current_az, target_az)
    return wrap_360(target_az + overshoot(turn)) if abs(turn) > 1.0 else target_az, adjusted_el
