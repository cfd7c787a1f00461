"""The way of a machine whose own axes are not azimuth and elevation: along its arc, never straight across the sky."""

from __future__ import annotations

import math
from collections.abc import Iterator

from birdcage.antenna.motion import AxisMotion, DishMotion, plan_axis
from birdcage.base.geometry import shortest_turn
from birdcage.kinematics import Segment, Slew
from birdcage.rotator.facts import Facts
from birdcage.rotator.values import Position

APART_DEG = 0.5
"""How far its axes turn at most between two points of the way as it is modelled; straight in between."""


def _slews(facts: Facts, start: Position, az_deg: float, el_deg: float) -> dict[str, Slew]:
    """Return how each of its own axes turns, all at once. One that has less than half a step to go rests."""
    mapping = facts.mapping
    assert mapping is not None, "whoever asks has seen to that"
    here, there = mapping.to_axes(start.azimuth, start.elevation)[0], mapping.to_axes(az_deg, el_deg)[0]
    slews = {}
    for name, end_deg in there.items():
        axis = facts.named[name]
        rests = abs(end_deg - here[name]) < axis.step_deg / 2
        slews[name] = plan_axis(axis, here[name], here[name] if rests else end_deg)
    return slews


def mapped_s(facts: Facts, start: Position, az_deg: float, el_deg: float) -> float:
    """Return how long it takes between two directions that it can point to; mechanical seconds, 0 where it is there."""
    return max(slew.duration_s for slew in _slews(facts, start, az_deg, el_deg).values())


def mapped_points(facts: Facts, start: Position, az_deg: float, el_deg: float) -> Iterator[tuple[float, Position]]:
    """Return when it is where on its way: mechanical seconds, and azimuths that go on beyond 0..360."""
    mapping = facts.mapping
    assert mapping is not None, "whoever asks has seen to that"
    slews = _slews(facts, start, az_deg, el_deg)
    seconds = max(slew.duration_s for slew in slews.values())
    way_deg = max(abs(slew.end_deg - slew.at(0.0)[0]) for slew in slews.values())
    count = max(1, math.ceil(2.0 * way_deg / APART_DEG))
    az_before = start.azimuth
    for k in range(count + 1):
        t_s = seconds * k / count
        az, el = mapping.to_sky({name: slew.at(t_s)[0] for name, slew in slews.items()})
        az_before += shortest_turn(az_before, az)
        yield t_s, Position(az_before, el)


def mapped_motion(
    facts: Facts, start: Position, az_deg: float, el_deg: float, now: float, *, start_known: bool = True
) -> DishMotion:
    """Model its way from one direction to another that it can point to, beginning now."""
    points = list(mapped_points(facts, start, az_deg, el_deg))
    times = [t_s for t_s, _ in points]
    azimuth = _along(times, [point.azimuth for _, point in points])
    elevation = _along(times, [point.elevation for _, point in points])
    return DishMotion(
        AxisMotion(facts.azimuth, azimuth, now, start.azimuth, now),
        AxisMotion(facts.elevation, elevation, now, start.elevation, now),
        silent=True, longest_s=times[-1], together=True, start_known=start_known,
    )  # fmt: skip


def _along(times: list[float], angles: list[float]) -> Slew:
    segments = []
    for k in range(len(times) - 1):
        lasts_s = times[k + 1] - times[k]
        if lasts_s > 0.0:
            segments.append(Segment(lasts_s, angles[k], (angles[k + 1] - angles[k]) / lasts_s, 0.0))
    return Slew(angles[-1], tuple(segments))
