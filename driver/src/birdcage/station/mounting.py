"""What a plan has to know of the dish, from what the station knows now."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from birdcage.base.errors import BirdcageError
from birdcage.protocol.model import Axis, DishModel
from birdcage.station.reach_limits import reach_limits_of
from birdcage.station.state import StationState
from birdcage.tracking.mount import Mount, Standing

if TYPE_CHECKING:
    from birdcage.base.config import Settings


def mount_of(state: StationState, settings: Settings) -> Mount:
    """Return the mount at this moment; the horizon mask comes from the settings.

    BirdcageError (`unknown`) for a state without a dish, which no station has.
    """
    if state.dish is None:
        raise BirdcageError("No dish is known yet: choose its firmware first.", reason="unknown")
    offset_deg = state.alignment.el_offset_deg
    return Mount(
        _in_force(state.dish, state),
        reach_limits_of(state, settings),
        state.alignment,
        _standing(state),
        None if state.el_min_deg is None else state.el_min_deg - offset_deg,
        None if state.el_max_deg is None else state.el_max_deg - offset_deg,
        state.beam_deg,
        state.beam_at_hz,
    )


def _in_force(model: DishModel, state: StationState) -> DishModel:
    """Return the model with the speeds that were read or set; without those that a pursuit changes as it follows."""
    return replace(
        model, azimuth=_at_speed(model.azimuth, state), elevation=_at_speed(model.elevation, state)
    )  # fmt: skip


def _at_speed(axis: Axis, state: StationState) -> Axis:
    lent = state.speeds_lent.get(axis.index)
    if lent is not None:
        return replace(axis, speed_deg_s=lent)
    told = state.readings.get(f"speed.{axis.index}")
    return axis if told is None or isinstance(told.value, str) else replace(axis, speed_deg_s=float(told.value))


def _standing(state: StationState) -> Standing | None:
    here = state.position
    if here is None or state.position_lost is not None:
        return None
    return Standing(here.dish_az_deg if here.cable_deg is None else here.cable_deg, here.dish_el_deg)
