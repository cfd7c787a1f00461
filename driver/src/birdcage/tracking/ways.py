"""Ways of the whole dish from one place to another, in steps that it can only take the way round that was meant."""

from __future__ import annotations

import math

from birdcage.antenna.motion import plan_axis
from birdcage.base.geometry import shortest_turn
from birdcage.protocol.model import DishModel

LONGEST_STEP_DEG = 170.0
"""Of azimuth at a time: half a turn or more may be gone either way round."""
MARGIN_S = 0.5
"""What a slew takes beyond the motion itself: two lines, and the proof that it rests."""

Place = tuple[float, float]
"""Azimuth and elevation of the dish."""


def way(here: Place, to: Place, *, turn_known: bool) -> tuple[Place, ...]:
    """Return the stops on the way, the last one `to`; azimuth goes the short way unless the turn is known."""
    turn = to[0] - here[0] if turn_known else shortest_turn(here[0], to[0])
    steps = max(1, math.ceil(abs(turn) / LONGEST_STEP_DEG))
    climb = to[1] - here[1]
    stops = [(to[0] - turn * (1 - k / steps), here[1] + climb * k / steps) for k in range(1, steps)]
    return (*stops, to)


def seconds(model: DishModel, here: Place, to: Place, *, turn_known: bool) -> float:
    """Return about how long that way takes."""
    turn = to[0] - here[0] if turn_known else shortest_turn(here[0], to[0])
    az_s, el_s = (
        plan_axis(axis, 0.0, deg).duration_s
        for axis, deg in ((model.azimuth, turn), (model.elevation, to[1] - here[1]))
    )
    return (max(az_s, el_s) if model.axes_together else az_s + el_s) + MARGIN_S


def nearest_turn(here_az: float, az_deg: float, cable: tuple[float, float] | None) -> float:
    """Return the azimuth on the turn nearest to where the dish is that the cable allows; as it is where none does."""
    nearest = here_az + shortest_turn(here_az, az_deg)
    if cable is None:
        return nearest
    fits = [turn for k in (-2, -1, 0, 1, 2) if cable[0] <= (turn := nearest + 360.0 * k) <= cable[1]]
    return min(fits, key=lambda turn: abs(turn - here_az), default=nearest)
