"""What a plan has to know of the dish, from what the station knows now."""

from __future__ import annotations

from typing import TYPE_CHECKING

from birdcage.base.errors import BirdcageError
from birdcage.base.reason import Reason
from birdcage.rotator.facts import Facts
from birdcage.rotator.feature import speed_of
from birdcage.rotator.own import with_speeds
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
        raise BirdcageError("The dish is not known yet. Choose its firmware first.", reason=Reason.UNKNOWN)
    offset_deg = state.alignment.el_offset_deg
    return Mount(
        _in_force(state.dish, state),
        reach_limits_of(state, settings),
        state.alignment,
        _standing(state),
        None if state.el_min_deg is None else state.el_min_deg - offset_deg,
        None if state.el_max_deg is None else state.el_max_deg - offset_deg,
        state.beam,
    )


def _in_force(model: Facts, state: StationState) -> Facts:
    """Return the model with the speeds that were read or set; without those that a pursuit changes as it follows."""
    read = {
        axis.index: float(told.value)
        for axis in (model.azimuth, model.elevation)
        if (told := state.readings.get(speed_of(axis.name))) is not None and not isinstance(told.value, str)
    }
    return with_speeds(model, read | dict(state.speeds_lent))


def _standing(state: StationState) -> Standing | None:
    here = state.position
    if here is None or state.position_lost is not None:
        return None
    return Standing(here.dish_az_deg if here.cable_deg is None else here.cable_deg, here.dish_el_deg)
