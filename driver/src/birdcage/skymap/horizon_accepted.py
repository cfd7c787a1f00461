"""A proposed horizon, put into the mask of a place: what a person accepted, and around it what stood there before."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator, Sequence
from itertools import pairwise

from birdcage.base.geometry import shortest_turn, wrap_360
from birdcage.sky.horizon import HorizonMask
from birdcage.skymap.horizon_lesson import HorizonEdge

BESIDE_DEG = 1.0
"""So far beside the last accepted point the mask is what it was."""
NEAREST_DEG = 1.0
"""A typed azimuth means the proposed point that is no further away."""
CLOSES_DEG = 5.0
"""Where the last proposed point comes so near to the first one, the map goes all round, and they are neighbours."""

Points = list[tuple[float, float]]


def with_accepted(mask: HorizonMask, proposed: Sequence[HorizonEdge], accepted: Collection[int]) -> HorizonMask:
    """Return the mask with those of the proposed points whose index was accepted.

    Points of the mask between two neighbours that were both accepted give way; all others stay. Where both are clear,
    the mask becomes the lower one of what it was and the line between them: a direction that is clear never raises it,
    as the map tells nothing of what lies below.
    """
    chosen = sorted(set(accepted))
    spans = [(proposed[one], proposed[other]) for one, other in _neighbours(proposed) if {one, other} <= set(chosen)]
    points = [each for each in mask.points if not any(_is_within(each[0], *span) for span in spans)]
    new = []
    for edge in (proposed[index] for index in chosen):
        el_deg = min(mask.at(edge.az_deg), edge.el_deg) if edge.is_clear else edge.el_deg
        new.append((edge.az_deg, round(el_deg, 2)))
    for span in spans:
        points += _lower(mask, *span) if mask.is_line and span[0].is_clear and span[1].is_clear else []
    begins, ends = {left.az_deg for left, _right in spans}, {right.az_deg for _left, right in spans}
    for az_deg, _el in new:
        beside = [az_deg - BESIDE_DEG] * (az_deg not in ends) + [az_deg + BESIDE_DEG] * (az_deg not in begins)
        for at_deg in beside:
            near = any(abs(shortest_turn(at_deg, other)) < BESIDE_DEG / 2.0 for other, _el in new)
            if not near and not any(_is_within(at_deg, *span) for span in spans):
                points.append((wrap_360(at_deg), mask.at(at_deg)))
    merged = HorizonMask(points) if new else mask
    for az_deg, el_deg in new:
        merged = merged.insert(az_deg, el_deg)
    return merged


def _neighbours(proposed: Sequence[HorizonEdge]) -> Iterator[tuple[int, int]]:
    """Return the indices of points side by side; the last one and the first one where the map goes all round."""
    yield from pairwise(range(len(proposed)))
    if len(proposed) > 1 and wrap_360(proposed[0].az_deg - proposed[-1].az_deg) <= CLOSES_DEG:
        yield len(proposed) - 1, 0


def _is_within(az_deg: float, left: HorizonEdge, right: HorizonEdge) -> bool:
    return wrap_360(az_deg - left.az_deg) <= wrap_360(right.az_deg - left.az_deg)


def _lower(mask: HorizonMask, left: HorizonEdge, right: HorizonEdge) -> Points:
    """Return the points of the mask that lie below the line between two clear points, and where it crosses that."""
    width = wrap_360(right.az_deg - left.az_deg)
    inside = [(wrap_360(az - left.az_deg), el) for az, el in mask.points if _is_within(az, left, right)]
    ways = [(0.0, mask.at(left.az_deg)), *sorted(inside, key=lambda each: each[0]), (width, mask.at(right.az_deg))]
    over = [(along, el - left.el_deg - along / width * (right.el_deg - left.el_deg), el) for along, el in ways]
    kept: Points = []
    for (along, above, el_deg), (then, above_then, el_then) in pairwise(over):
        if above < 0.0:
            kept.append((along, el_deg))
        if above * above_then < 0.0:
            share = above / (above - above_then)
            kept.append((along + share * (then - along), el_deg + share * (el_then - el_deg)))
    return [
        (wrap_360(round(left.az_deg + along, 4)), round(el_deg, 4)) for along, el_deg in kept if 0.0 < along < width
    ]


def chosen_by(proposed: Sequence[HorizonEdge], azimuths: Sequence[float]) -> list[int]:
    """Return the indices of the points at these azimuths. LookupError, with a sentence, for one where none is."""
    found = []
    for az_deg in azimuths:
        if not math.isfinite(az_deg):
            raise LookupError(f"{az_deg:g} is no azimuth. Type all, or 160,175.5.")
        near = min(range(len(proposed)), key=lambda index: abs(shortest_turn(az_deg, proposed[index].az_deg)))
        if abs(shortest_turn(az_deg, proposed[near].az_deg)) > NEAREST_DEG:
            raise LookupError(f"No point is proposed within {NEAREST_DEG:g}° of {az_deg:g}°.")
        found.append(near)
    return found
