"""What a move would do, as far as can be said beforehand: which way, how long, and what forbids it.

The station judges again when it is asked, and its word counts.
"""

from __future__ import annotations

from dataclasses import dataclass

from birdcage.kinematics import plan_slew
from birdcage.station.known import speed_of
from birdcage.station.requests import Goto, Jog, Request, TurnSkew
from birdcage.station.state import Activity, StationState
from birdcage.station.turning import AzimuthWay, cable_limits, is_safe_at_any_turn
from birdcage.station.turning import way_to as azimuth_way_to

from birdcage_tui.goto.goto_text import GotoAim, wind_of
from birdcage_tui.shown.view import View

TOUCH_DEG = 0.005
"""Less than the last digit shown is no difference."""


@dataclass(frozen=True, slots=True)
class MovePath:
    """A move from where the dish is: signed degrees of each axis, clockwise and up positive."""

    az: AzimuthWay
    el_deg: float
    seconds: float | None
    """The longest that it takes, whichever way round."""


def turns_to(state: StationState, az_deg: float) -> tuple[float, ...]:
    """Return the turns of the cable that reach `az_deg`, nearest first; empty when none fits or it is not known."""
    way = azimuth_way_to(state, az_deg)
    return () if way is None else way.turns


def way_to(view: View, az_deg: float, el_deg: float) -> MovePath | None:
    """Return the way to a direction; None while the dish's own is not known."""
    state, position = view.state, view.state.position
    az = azimuth_way_to(state, az_deg)
    if position is None or az is None:
        return None
    el_way = el_deg - position.el_deg
    return MovePath(az, el_way, _seconds(state, az.longest_deg, el_way))


def _seconds(state: StationState, az_way: float, el_way: float) -> float | None:
    dish = state.dish
    if dish is None:
        return None
    spans = []
    for axis, way in ((dish.azimuth, az_way), (dish.elevation, el_way)):
        reading = state.readings.get(speed_of(axis.name))
        speed = reading.value if reading is not None and isinstance(reading.value, float) else axis.speed_deg_s
        if axis.times is not None:
            spans.append(axis.times.seconds(way))
        else:
            spans.append(plan_slew(0.0, way, speed, axis.acceleration_deg_s2).duration_s if speed > 0 else 0.0)
    return max(spans) if dish.axes_together else sum(spans)


def refusal_of(request: Request, state: StationState) -> str | None:
    """Return why the station would refuse a motion, if the app can tell; a pass that is followed is not left for it."""
    match request:
        case Goto():
            return forbidden(state, request.az_deg, request.el_deg)
        case Jog(d_az_deg, d_el_deg):
            here, az_deg, el_deg = state.position, state.target_az_deg, state.target_el_deg
            if here is not None:
                az_deg = here.az_deg if az_deg is None else az_deg
                el_deg = here.el_deg if el_deg is None else el_deg
            if az_deg is None or el_deg is None:
                return "The position is unknown, so no step is sent. Wait until it is read."
            return forbidden(state, (az_deg + d_az_deg) % 360.0, el_deg + d_el_deg)
        case TurnSkew(_, holder) if state.activity is Activity.SLEWING and state.holder != holder:
            return "The skew turns only while the dish rests. Wait until it rests, or stop it first."
    return None


def forbidden(state: StationState, az_deg: float, el_deg: float) -> str | None:
    """Return which limit the move would break, by how much, and what would do; None when none is known to.

    Of a machine with a mapping the station judges: its targets are the nearest that it reaches.
    """
    if state.dish is not None and (state.dish.no_direction or state.dish.mapping is not None):
        return state.dish.no_direction or None
    low, high = state.el_min_deg, state.el_max_deg
    span = "" if low is None or high is None else f" Type {low:.0f} to {high:.0f}."
    if low is not None and el_deg < low - TOUCH_DEG:
        return f"Elevation {el_deg:.2f}° is {low - el_deg:.2f}° below the floor of {low:.2f}°.{span}"
    if high is not None and el_deg > high + TOUCH_DEG:
        return f"Elevation {el_deg:.2f}° is {el_deg - high:.2f}° above the limit of {high:.2f}°.{span}"
    return _cable(state, az_deg) or _sector(state, az_deg, el_deg)


def _cable(state: StationState, az_deg: float) -> str | None:
    position, limits, way = state.position, cable_limits(state), azimuth_way_to(state, az_deg)
    if position is None or limits is None or state.dish is None or way is None:
        return None
    if position.cable_deg is None:
        to_deg = position.dish_az_deg + way.deg
        if not is_safe_at_any_turn(state.dish, position.dish_az_deg, to_deg, limits):
            return "The cable turn is unknown. Home the dish first (H)."
        return None
    if way.turns:
        return None
    nearest = position.cable_deg + way.deg
    limit = limits[0] if limits[0] - nearest > nearest - limits[1] else limits[1]
    return f"Azimuth {az_deg:.2f}° would turn the cable {abs(nearest - limit):.2f}° beyond its stop at {limit:+.0f}°."


def _sector(state: StationState, az_deg: float, el_deg: float) -> str | None:
    position, az = state.position, azimuth_way_to(state, az_deg)
    if position is None or az is None:
        return None
    lowest = min(position.el_deg, el_deg)
    if abs(az.deg) < TOUCH_DEG and el_deg >= position.el_deg:
        return None  # straight up is the way out of a sector
    for low_az, high_az, below, reason in state.no_go_sectors:
        width = (high_az - low_az) % 360.0
        for way in (az.deg,) if az.other_deg is None else (az.deg, az.other_deg):
            start = position.az_deg if way >= 0 else position.az_deg + way
            met = (start - low_az) % 360.0 <= width or (low_az - start) % 360.0 <= abs(way)
            if lowest < below and met:
                why = f" ({reason})" if reason else ""
                does = "passes" if way == az.deg else "may pass (cable turn unknown)"
                return (
                    f"The way {does} the no-go sector {low_az:.0f}° to {high_az:.0f}°{why}, {below - lowest:.2f}° too "
                    f"low. Go above {below:.0f}° first."
                )
    return None


def way_words(view: View, aim: GotoAim) -> str:
    """Return where an aim is, how far each axis goes, which way and how long: one line."""
    name = f"{aim.name}: " if aim.name else ""
    where = f"{name}az {aim.az_deg:.2f}° {wind_of(aim.az_deg)}, el {aim.el_deg:.2f}°"
    way = way_to(view, aim.az_deg, aim.el_deg)
    if way is None:
        return f"{where}   distance unknown"
    el_way = (
        "elevation stays"
        if abs(way.el_deg) < TOUCH_DEG
        else f"{abs(way.el_deg):.2f}° " + ("up" if way.el_deg > 0 else "down")
    )
    upto = "" if way.az.other_deg is None else "up to "
    takes = "" if way.seconds is None else f", {upto}{way.seconds:.1f} s"
    return f"{where}   {_turn_words(way.az)}, {el_way}{takes}"


def _turn_words(way: AzimuthWay) -> str:
    """Return how far it turns and which way round; both ways where the turn of the cable would tell, and is unknown."""
    if abs(way.deg) < TOUCH_DEG:
        return "azimuth stays"
    if way.other_deg is None:
        return f"{abs(way.deg):.2f}° {'clockwise' if way.deg > 0 else 'counterclockwise'}"
    return " or ".join(f"{abs(deg):.2f}° {'CW' if deg > 0 else 'CCW'}" for deg in (way.deg, way.other_deg))
