"""Ways of the whole dish from where it stands now: over no-go sectors, and in steps that leave it no choice."""

from __future__ import annotations

from dataclasses import dataclass

from birdcage.base.geometry import shortest_turn
from birdcage.rotator.facts import Facts
from birdcage.tracking.planning.bounds import PlanBounds
from birdcage.tracking.planning.routes import Point, route

MARGIN_S = 0.5
"""What each stop takes beyond the motion itself: two lines, and the proof that the dish rests."""


@dataclass(frozen=True, slots=True)
class WaypointRoute:
    """Every stop, the last one too, and about how long it takes to be there."""

    stops: tuple[Point, ...]
    seconds: float


def way(bounds: PlanBounds, model: Facts, here: Point, to: Point, *, turn_known: bool) -> WaypointRoute:
    """Return the way, in the turns of `to`; azimuth goes the short way unless the turn of the cable is known.

    `turn_known`: whether the turns of `to` tell that of the cable; it counts while the dish still knows its own.

    Where a no-go sector closes every way it is the straight one, which the gate refuses, and says why.
    """
    turn = to[0] - here[0] if turn_known and bounds.turn_known else shortest_turn(here[0], to[0])
    found = route(bounds, model, (to[0] - turn, here[1]), to)
    return (
        WaypointRoute((to,), 0.0)
        if found is None
        else WaypointRoute(found.stops, found.seconds + MARGIN_S * len(found.stops))
    )


def nearest_turn(here_az: float, az_deg: float, cable: tuple[float, float] | None) -> float:
    """Return the azimuth on the turn nearest to where the dish is that the cable allows; as it is where none does."""
    nearest = here_az + shortest_turn(here_az, az_deg)
    if cable is None:
        return nearest
    fits = [turn for k in (-2, -1, 0, 1, 2) if cable[0] <= (turn := nearest + 360.0 * k) <= cable[1]]
    return min(fits, key=lambda turn: abs(turn - here_az), default=nearest)
