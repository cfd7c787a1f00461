"""How long a dish that follows has nothing to do: then its tuner may be read."""

from __future__ import annotations

from birdcage.base.geometry import shortest_turn
from birdcage.tracking.controller_input import ControllerInput
from birdcage.tracking.planning.routes import Point

HEAR_EVERY_S = 8.5
"""How often the tuner is read while the dish stands still: two visits and the positions between would be too much
for the wire within 10 s (`station.watches`)."""
HAIR_DEG = 1e-6
AHEAD_S = (0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 12.0, 16.0, 24.0, 32.0, 64.0, 128.0, 256.0, 512.0)
"""What is looked at. A target that is as slow as that over one of these spans is so within it, too."""


def still_until(guide: ControllerInput, place: Point, now_s: float) -> float:
    """Return until when the course stays as near to a place as not to be worth a command; `now_s`: not even now.

    `place`: where the motors were sent, as the course counts it. Times in POSIX seconds.
    """
    course, until_s = guide.course(), now_s
    axes = guide.model.azimuth, guide.model.elevation
    # Half a step more: it was sent to whole steps.
    bands = tuple(guide.least_way_deg(axis) + axis.step_deg / 2.0 + HAIR_DEG for axis in axes)
    for ahead_s in AHEAD_S:
        at_s = min(now_s + ahead_s, guide.until_s)
        az_deg, el_deg = course.at(at_s)
        if abs(shortest_turn(place[0], az_deg)) > bands[0] or abs(place[1] - el_deg) > bands[1]:
            break
        until_s = at_s
        if at_s >= guide.until_s:
            break
    return until_s
