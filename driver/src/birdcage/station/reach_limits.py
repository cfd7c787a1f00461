"""What keeps this dish from pointing somewhere, for `birdcage.sky.reach`: from the settings, or from a live dish."""

from __future__ import annotations

from typing import TYPE_CHECKING

from birdcage.base.beam import Beam, beam_of
from birdcage.rotator.axis import Axis
from birdcage.rotator.facts import CableTurn, Facts
from birdcage.sky.horizon import HorizonMask
from birdcage.sky.reach_limits import DEFAULT_TOLERANCE_DEG, ReachLimits
from birdcage.station.settings import rules_from

if TYPE_CHECKING:
    from birdcage.base.config import Settings
    from birdcage.station.state import StationState

_KEYHOLE_TURN_DEG = 90.0
"""Where only times of moves are known, the rate is the mean over a move of this length: half a keyhole's turn."""


def reach_limits(settings: Settings, model: Facts | None, *, turn_known: bool = True) -> ReachLimits:
    """Return the limits of a dish that is not connected: its model's, narrowed by `birdcage.toml`.

    `turn_known`: whether it is expected to be homed by then, so that its cable is counted. Without a model only the
    settings limit anything.
    """
    rules = rules_from(settings)
    floor, ceiling = rules.min_elevation_deg, rules.max_elevation_deg
    low, high = rules.cable_min_deg, rules.cable_max_deg
    if model is not None:
        floor = model.elevation.min_deg if floor is None else max(floor, model.elevation.min_deg)
        ceiling = model.elevation.max_deg if ceiling is None else min(ceiling, model.elevation.max_deg)
        if model.cable is None:
            low, high = _of_unknown_cable(model)
        else:
            low = model.cable.min_deg if low is None else max(low, model.cable.min_deg)
            high = model.cable.max_deg if high is None else min(high, model.cable.max_deg)
    plus = rules.alignment.el_offset_deg
    return ReachLimits(
        follows=model is None or not model.no_following,
        el_floor_deg=max(0.0, 0.0 if floor is None else floor + plus),
        el_ceiling_deg=min(90.0, 90.0 if ceiling is None else ceiling + plus),
        horizon=_horizon(settings),
        no_go=rules.sectors,
        cable_min_deg=low if high is not None else None,
        cable_max_deg=high if low is not None else None,
        az_offset_deg=rules.alignment.az_offset_deg,
        turn_known=turn_known,
        az_rate_deg_s=None if model is None else _rate(model.azimuth),
        el_rate_deg_s=None if model is None else _rate(model.elevation),
        tolerance_deg=_tolerance(beam_of(rules.feed, None if model is None else model.reflector)),
    )


def reach_limits_of(state: StationState, settings: Settings) -> ReachLimits:
    """Return the limits of the dish as the station knows it now; what it does not know limits nothing."""
    model = state.dish
    low, high = state.cable_min_deg, state.cable_max_deg
    if model is not None and model.cable is None:
        low, high = _of_unknown_cable(model)
    return ReachLimits(
        follows=model is None or not model.no_following,
        el_floor_deg=max(0.0, state.el_min_deg if state.el_min_deg is not None else 0.0),
        el_ceiling_deg=min(90.0, state.el_max_deg if state.el_max_deg is not None else 90.0),
        horizon=_horizon(settings),
        no_go=state.no_go_sectors,
        cable_min_deg=low,
        cable_max_deg=high,
        az_offset_deg=state.az_offset_deg,
        turn_known=state.turn is not CableTurn.UNKNOWN or (model is not None and not model.cable_known),
        az_rate_deg_s=None if model is None else _rate(model.azimuth),
        el_rate_deg_s=None if model is None else _rate(model.elevation),
        tolerance_deg=_tolerance(state.beam),
    )


def _of_unknown_cable(model: Facts) -> tuple[float | None, float | None]:
    """Return what a plan keeps to where no cable is known: if that is no proof that there is none, one circle.

    Across its end the dish may go all the way round, so it is led round there.
    """
    return (None, None) if model.cable_known else (model.azimuth.min_deg, model.azimuth.max_deg)


def _rate(axis: Axis) -> float:
    """Return how fast an axis turns on a way that matters in the keyhole."""
    return axis.speed_deg_s if axis.times is None else _KEYHOLE_TURN_DEG / axis.times.seconds(_KEYHOLE_TURN_DEG)


def _tolerance(beam: Beam | None) -> float:
    return DEFAULT_TOLERANCE_DEG if beam is None else beam.narrow_deg / 2.0


def _horizon(settings: Settings) -> HorizonMask | None:
    mask = HorizonMask(settings.place.horizon)
    return mask if mask.is_line else None
