"""What a stream asks of a dish whose moves queue: whether it lags behind, and how far the next command leads."""

from __future__ import annotations

from birdcage.antenna.antenna import BirdcageAntenna
from birdcage.antenna.motion import DishMotion
from birdcage.base.geometry import shortest_turn
from birdcage.station.mover import ARRIVED_DEG, POLL_S
from birdcage.station.state import Pointing
from birdcage.station.unsure_move import over_at
from birdcage.tracking.steps import Send


def lags(here: Pointing, motion: DishMotion, rate: float) -> bool:
    """Return whether an axis was not yet where it must have come to rest before this reading."""
    az_deg, el_deg = motion.rest
    offs = (
        (motion.azimuth, abs(shortest_turn(az_deg, here.dish_az_deg))),
        (motion.elevation, abs(el_deg - here.dish_el_deg)),
    )
    return any(over_at(axis, rate) + POLL_S < here.told_at and off > ARRIVED_DEG for axis, off in offs)


def way_deg(antenna: BirdcageAntenna, step: Send) -> float:
    """Return how far a command turns its axis; 0 where it is not known where the dish is."""
    position, motion = antenna.gate.position, antenna.motion
    if position is None:
        return 0.0
    az_deg, el_deg = (position.azimuth, position.elevation) if motion is None else motion.rest
    if step.axis == antenna.model.elevation.index:
        return abs(step.deg - el_deg)
    return abs(shortest_turn(az_deg, step.deg))
