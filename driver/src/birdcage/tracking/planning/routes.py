"""Routes from one direction to another: by stops that leave the dish no choice, and over no-go sectors, not through."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from birdcage.antenna.motion import plan_axis
from birdcage.rotator.facts import Facts
from birdcage.tracking.curve import Floats
from birdcage.tracking.planning.bounds import PlanBounds

HOP_DEG = 170.0
"""The longest turn between two stops: under half a turn, by more than a dish may lag behind where it was planned."""
SLOW = 1.1
"""How much longer than its kinematics say an axis may take over a way: it is slower, or speeds up less, than known."""
STOP_S = 1.0
"""What each stop takes beyond the motion itself at the most: two lines on a slow wire, and the proof of rest."""
_STILL_DEG = 1e-6
_SAMPLE_S = 0.1

Point = tuple[float, float]


@dataclass(frozen=True, slots=True)
class Route:
    """Stops and how long they take, at rest at each of them."""

    start: Point
    stops: tuple[Point, ...]
    seconds: float

    @property
    def worst_s(self) -> float:
        """How long they take at the most: until then nothing may be planned that needs the dish."""
        return SLOW * self.seconds + STOP_S * len(self.stops)


def route(bounds: PlanBounds, model: Facts, start: Point, end: Point, *, either_way: bool = False) -> Route | None:
    """Return the way of a dish that rests, azimuths unrolled; None if a no-go sector closes it.

    Up first, across, then down where a no-go sector stands between. `either_way`: the dish may turn the other way
    round, which only it knows.
    """
    turn = end[0] - start[0]
    across = abs(turn) > _STILL_DEG
    met = [keepout for keepout in bounds.keepouts if across and (either_way or keepout.swept(start[0], turn))]
    if all(min(start[1], end[1]) >= keepout.below_deg for keepout in met):
        stops = _hops(start, end)
    else:
        over = max(start[1], end[1], *(keepout.below_deg for keepout in met))
        if over > bounds.high_el_deg:
            return None
        stops = _hops((start[0], over), (end[0], over))
        if over > start[1]:
            stops.insert(0, (start[0], over))
        if end[1] < over:
            stops.append(end)
    points = [start, *stops]
    return Route(start, tuple(stops), sum(_seconds(model, a, b) for a, b in zip(points, stops, strict=False)))


def sampled(taken: Route, model: Facts, start_s: float) -> tuple[Floats, Floats, Floats]:
    """Return times, azimuths and elevations along a route that begins at `start_s`; both axes together or in turn."""
    times: list[Floats] = []
    angles: list[Floats] = []
    at, here = start_s, taken.start
    for stop in taken.stops:
        az, el = plan_axis(model.azimuth, here[0], stop[0]), plan_axis(model.elevation, here[1], stop[1])
        delay = 0.0 if model.axes_together else az.duration_s
        length = max(az.duration_s, delay + el.duration_s)
        if length <= 0.0:
            continue
        t = np.linspace(0.0, length, max(8, math.ceil(length / _SAMPLE_S)) + 1)[1:]
        angles.append(np.array([(az.at(x)[0], el.at(x - delay)[0]) for x in t.tolist()]))
        times.append(at + t)
        at, here = at + length, stop
    if not times:
        return np.empty(0), np.empty(0), np.empty(0)
    points = np.concatenate(angles)
    return np.concatenate(times), points[:, 0], points[:, 1]


def _hops(start: Point, end: Point) -> list[Point]:
    count = max(1, math.ceil(abs(end[0] - start[0]) / HOP_DEG))
    between = [
        (start[0] + (end[0] - start[0]) * n / count, start[1] + (end[1] - start[1]) * n / count)
        for n in range(1, count)
    ]
    return [*between, end]


def _seconds(model: Facts, start: Point, end: Point) -> float:
    az_s, el_s = (
        plan_axis(axis, a, b).duration_s
        for axis, a, b in ((model.azimuth, start[0], end[0]), (model.elevation, start[1], end[1]))
    )
    return max(az_s, el_s) if model.axes_together else az_s + el_s
