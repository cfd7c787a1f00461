"""What a move would do, as far as can be said beforehand: which way, how long, and what forbids it.

The station judges again when it is asked, and its word counts.
"""

from __future__ import annotations

from dataclasses import dataclass

from birdcage.base.geometry import shortest_turn
from birdcage.kinematics import plan_slew
from birdcage.station.state import StationState

from birdcage_tui.goto_text import Aim, wind_of
from birdcage_tui.view import View

TOUCH_DEG = 0.005
"""Less than the last digit shown is no difference."""


@dataclass(frozen=True, slots=True)
class Way:
    """A move from where the dish is: signed degrees of each axis, clockwise and up positive."""

    az_deg: float
    el_deg: float
    cable_deg: float | None
    """The turn of the cable at its end; None when it is not known."""
    seconds: float | None


def cable_limits(state: StationState) -> tuple[float, float] | None:
    """Return how far the cable may turn, as the station has it; None where there is no such limit."""
    if state.cable_min_deg is not None and state.cable_max_deg is not None:
        return state.cable_min_deg, state.cable_max_deg
    cable = state.dish.cable if state.dish is not None else None
    return None if cable is None else (cable.min_deg, cable.max_deg)


def turns_to(state: StationState, az_deg: float) -> tuple[float, ...]:
    """Return the turns of the cable that reach `az_deg`, nearest first; empty when none fits or it is not known."""
    position, limits = state.position, cable_limits(state)
    if position is None or position.cable_deg is None or limits is None:
        return ()
    cable = position.cable_deg
    nearest = cable + shortest_turn(position.az_deg, az_deg)
    fits = [turn for k in (-2, -1, 0, 1, 2) if limits[0] <= (turn := nearest + 360.0 * k) <= limits[1]]
    return tuple(sorted(fits, key=lambda turn: abs(turn - cable)))


def way_to(view: View, az_deg: float, el_deg: float) -> Way | None:
    """Return the way to a direction; None while the dish's own is not known."""
    state, position = view.state, view.state.position
    if position is None:
        return None
    turns = turns_to(state, az_deg)
    az_way = shortest_turn(position.az_deg, az_deg)
    if turns and position.cable_deg is not None:
        az_way = turns[0] - position.cable_deg
    el_way = el_deg - position.el_deg
    return Way(az_way, el_way, turns[0] if turns else None, _seconds(state, az_way, el_way))


def _seconds(state: StationState, az_way: float, el_way: float) -> float | None:
    dish = state.dish
    if dish is None:
        return None
    spans = []
    for axis, way in ((dish.azimuth, az_way), (dish.elevation, el_way)):
        reading = state.readings.get(f"speed.{axis.index}")
        speed = reading.value if reading is not None and isinstance(reading.value, float) else axis.speed_deg_s
        if axis.times is not None:
            spans.append(axis.times.seconds(way))
        else:
            spans.append(plan_slew(0.0, way, speed, axis.acceleration_deg_s2).duration_s if speed > 0 else 0.0)
    return max(spans) if dish.axes_together else sum(spans)


def forbidden(state: StationState, az_deg: float, el_deg: float) -> str | None:
    """Return which limit the move would break, by how much, and what would do; None when none is known to."""
    low, high = state.el_min_deg, state.el_max_deg
    span = "" if low is None or high is None else f" Type {low:.0f} to {high:.0f}."
    if low is not None and el_deg < low - TOUCH_DEG:
        return f"Elevation {el_deg:.2f}° is {low - el_deg:.2f}° below the floor of {low:.2f}°.{span}"
    if high is not None and el_deg > high + TOUCH_DEG:
        return f"Elevation {el_deg:.2f}° is {el_deg - high:.2f}° above the limit of {high:.2f}°.{span}"
    return _cable(state, az_deg) or _sector(state, az_deg, el_deg)


def _cable(state: StationState, az_deg: float) -> str | None:
    position, limits = state.position, cable_limits(state)
    if position is None or limits is None:
        return None
    if position.cable_deg is None:
        if limits[1] - limits[0] < 360.0:
            return "The turn of the cable is not known: home the dish first (H), so that it is counted."
        return None
    if turns_to(state, az_deg):
        return None
    nearest = position.cable_deg + shortest_turn(position.az_deg, az_deg)
    limit = limits[0] if limits[0] - nearest > nearest - limits[1] else limits[1]
    return f"Azimuth {az_deg:.2f}° would turn the cable {abs(nearest - limit):.2f}° beyond its stop at {limit:+.0f}°."


def _sector(state: StationState, az_deg: float, el_deg: float) -> str | None:
    position = state.position
    if position is None:
        return None
    turns = turns_to(state, az_deg)
    way = shortest_turn(position.az_deg, az_deg)
    if turns and position.cable_deg is not None:
        way = turns[0] - position.cable_deg
    start = position.az_deg if way >= 0 else position.az_deg + way
    lowest = min(position.el_deg, el_deg)
    if abs(way) < TOUCH_DEG and el_deg >= position.el_deg:
        return None  # straight up is the way out of a sector
    for low_az, high_az, below, reason in state.no_go_sectors:
        width = (high_az - low_az) % 360.0
        met = (start - low_az) % 360.0 <= width or (low_az - start) % 360.0 <= abs(way)
        if lowest < below and met:
            why = f" ({reason})" if reason else ""
            return (
                f"The way passes the no-go sector {low_az:.0f}° to {high_az:.0f}°{why}, {below - lowest:.2f}° too low: "
                f"go above {below:.0f}° first."
            )
    return None


def way_words(view: View, aim: Aim) -> str:
    """Return where an aim is, how far each axis goes, which way and how long: one line."""
    name = f"{aim.name}: " if aim.name else ""
    where = f"{name}az {aim.az_deg:.2f}° {wind_of(aim.az_deg)}, el {aim.el_deg:.2f}°"
    way = way_to(view, aim.az_deg, aim.el_deg)
    if way is None:
        return f"{where}   how far is not known"
    turn = "clockwise" if way.az_deg > 0 else "counterclockwise"
    az_way = "azimuth stays" if abs(way.az_deg) < TOUCH_DEG else f"{abs(way.az_deg):.2f}° {turn}"
    el_way = (
        "elevation stays"
        if abs(way.el_deg) < TOUCH_DEG
        else f"{abs(way.el_deg):.2f}° " + ("up" if way.el_deg > 0 else "down")
    )
    takes = "" if way.seconds is None else f", {way.seconds:.1f} s"
    return f"{where}   {az_way}, {el_way}{takes}"
