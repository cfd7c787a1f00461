"""What stops the motion under way, and how soon: said before it is needed (DESIGN section 5)."""

from __future__ import annotations

from dataclasses import dataclass

from birdcage.antenna.motion import DishMotion, stop_power_s
from birdcage.rotator.facts import Facts


@dataclass(frozen=True, slots=True)
class StopPower:
    """As on `Motion`: how long STOP takes, by what, and when a move ends that STOP must wait for."""

    seconds: float
    means: str
    rests_at: float | None = None


def stop_power(model: Facts, motion: DishMotion | None, rate: float) -> StopPower:
    """Return what STOP can do about this motion; without one, about the first that may begin."""
    if not model.tells_at_rest:
        return StopPower(0.0, "none")
    if motion is None or not model.moves_in_turn:
        return StopPower(stop_power_s(model), model.stop_ladder[0].name)
    if motion.silent:
        return StopPower(stop_power_s(model), "abort")
    rests_at = motion.eta(rate)
    return StopPower(rests_at - motion.azimuth.started, "end of move", rests_at)
