"""Which way round the dish will turn, for whoever tells it before it moves."""

from __future__ import annotations

from birdcage.antenna.turning import AzimuthWay, azimuth_way, is_safe_at_any_turn
from birdcage.station.state import StationState

__all__ = ["AzimuthWay", "cable_limits", "is_safe_at_any_turn", "way_to"]


def cable_limits(state: StationState) -> tuple[float, float] | None:
    """Return how far the cable may turn, as the station has it; None if there is no such limit."""
    if state.cable_min_deg is not None and state.cable_max_deg is not None:
        return state.cable_min_deg, state.cable_max_deg
    cable = state.dish.cable if state.dish is not None else None
    return None if cable is None else (cable.min_deg, cable.max_deg)


def way_to(state: StationState, az_deg: float) -> AzimuthWay | None:
    """Return how the azimuth will turn to a true direction; None while the dish's own is not known."""
    position, dish = state.position, state.dish
    if position is None or dish is None or state.position_lost is not None:
        return None
    there_deg = position.dish_az_deg + az_deg - position.az_deg
    return azimuth_way(dish, position.dish_az_deg, there_deg, position.cable_deg, cable_limits(state))
