"""A proposed horizon, put into the mask of a place: what a person accepted, and around it what stood there before."""

from __future__ import annotations

from collections.abc import Collection, Sequence

from birdcage.base.geometry import shortest_turn, wrap_360
from birdcage.sky.horizon import HorizonMask
from birdcage.skymap.horizon_lesson import HorizonEdge

BESIDE_DEG = 1.0
"""So far beside the last accepted point the mask is what it was."""
NEAREST_DEG = 1.0
"""A typed azimuth means the proposed point that is no further away."""


def with_accepted(mask: HorizonMask, proposed: Sequence[HorizonEdge], accepted: Collection[int]) -> HorizonMask:
    """Return the mask with those of the proposed points whose index was accepted.

    Points of the mask between two neighbours that were both accepted give way; all others stay. A direction that is
    clear lowers the mask, and never raises it: the map tells nothing of what lies below.
    """
    chosen = [(proposed[index], index + 1 in accepted) for index in sorted(set(accepted))]
    if not chosen:
        return mask
    new: list[tuple[float, float]] = []
    points = list(mask.points)
    runs: list[list[HorizonEdge]] = [[]]
    for edge, goes_on in chosen:
        el_deg = min(mask.at(edge.az_deg), edge.el_deg) if edge.is_clear else edge.el_deg
        new.append((edge.az_deg, round(el_deg, 2)))
        runs[-1].append(edge)
        if not goes_on:
            runs.append([])
    for run in filter(None, runs):
        left, right = run[0].az_deg, run[-1].az_deg
        width = wrap_360(right - left)
        points = [point for point in points if wrap_360(point[0] - left) > width]
        for az_deg in (left - BESIDE_DEG, right + BESIDE_DEG):
            if not any(abs(shortest_turn(az_deg, other)) < BESIDE_DEG / 2.0 for other, _el in new):
                points.append((wrap_360(az_deg), mask.at(az_deg)))
    merged = HorizonMask(points)
    for az_deg, el_deg in new:
        merged = merged.insert(az_deg, el_deg)
    return merged


def chosen_by(proposed: Sequence[HorizonEdge], azimuths: Sequence[float]) -> list[int]:
    """Return the indices of the points at these azimuths. LookupError, with a sentence, for one where none is."""
    found = []
    for az_deg in azimuths:
        near = min(range(len(proposed)), key=lambda index: abs(shortest_turn(az_deg, proposed[index].az_deg)))
        if abs(shortest_turn(az_deg, proposed[near].az_deg)) > NEAREST_DEG:
            raise LookupError(f"No point is proposed within {NEAREST_DEG:g}° of {az_deg:g}°.")
        found.append(near)
    return found
