"""How far an axis may turn to and fro about where it stands: asked of the gate, degree by degree, both ways."""

from __future__ import annotations

from copy import copy
from dataclasses import replace

from birdcage.antenna.gate import MotionGate
from birdcage.base.errors import MotionRefused
from birdcage.base.geometry import wrap_360
from birdcage.tracking.steps import FindWay, StepResult

GRID_DEG = 0.5
ELSEWHERE_DEG = 15.0
"""How far apart the places lie that are tried where the azimuth has no room."""
KEEP_OFF_DEG = 0.5
"""How far the way ends before what the gate refuses: an axis overshoots."""


def clear_way(gate: MotionGate, step: FindWay, now_s: float) -> StepResult:
    """Return the way of at most `longest_deg` that lies as evenly about the dish as its limits let it.

    Each angle of it may be reached from its start, and left for it: limits, cable and no-go sectors are the gate's.
    Where the azimuth has no such room, the nearest place that has is taken. The azimuth counts on the scale of
    `StepResult.az_deg`. No way and the gate's sentence where there is no room at all.
    """
    gate.require_position()
    assert gate.position is not None, "it was asked for just now"
    if step.axis != gate.model.azimuth.index:
        first = gate.nearest_el_deg(gate.position.elevation)
        way, refused = _about(gate, first, step.longest_deg, azimuth=False)
        return StepResult(now_s, way_deg=way, refused=refused)
    here = gate.position.azimuth if gate.cable_deg is None else gate.cable_deg
    best, why = _about(gate, here, step.longest_deg, azimuth=True)
    for count in range(1, int(180.0 / ELSEWHERE_DEG) + 1):
        for first in (here + count * ELSEWHERE_DEG, here - count * ELSEWHERE_DEG):
            if _length(best) < step.longest_deg - 2.0 * KEEP_OFF_DEG and _may_go(gate, first):
                way, refused = _about(gate, first, step.longest_deg, azimuth=True)
                if way is not None and _length(way) > _length(best) and _may_go(gate, way[0]):
                    best, why = way, refused
    return StepResult(now_s, way_deg=best, refused=why)


def _length(way: tuple[float, float] | None) -> float:
    return 0.0 if way is None else way[1] - way[0]


def _may_go(gate: MotionGate, az_deg: float) -> bool:
    """Return whether the dish may go there from where it stands, whichever way round it goes."""
    if gate.cable_deg is not None and abs(gate.way_to(wrap_360(az_deg)).deg - (az_deg - gate.cable_deg)) > GRID_DEG:
        return False
    try:
        gate.check(wrap_360(az_deg), None)
    except MotionRefused:
        return False
    return True


def _about(
    gate: MotionGate, first: float, longest_deg: float, *, azimuth: bool
) -> tuple[tuple[float, float] | None, str]:
    """Return the way that lies as evenly about an angle as can be, None for none; and what ends it, if anything."""
    low, low_refused = _reach(gate, first, first - longest_deg, azimuth=azimuth)
    high, high_refused = _reach(gate, first, first + longest_deg, azimuth=azimuth)
    low += KEEP_OFF_DEG if low_refused else 0.0
    high -= KEEP_OFF_DEG if high_refused else 0.0
    refused = low_refused or high_refused
    if high <= low:
        return None, refused
    way_deg = min(longest_deg, high - low)
    begin = min(max(first - way_deg / 2.0, low), high - way_deg)
    return (begin, begin + way_deg), refused


def _reach(gate: MotionGate, first: float, furthest: float, *, azimuth: bool) -> tuple[float, str]:
    """Return how far the axis may go towards an angle and come back from there, and why not further."""
    reached, sign = first, 1.0 if furthest > first else -1.0
    for count in range(1, int(abs(furthest - first) / GRID_DEG) + 1):
        deg = first + sign * count * GRID_DEG
        refused = _refusal(gate, first, deg, azimuth=azimuth) or _refusal(gate, deg, first, azimuth=azimuth)
        if refused:
            return reached, refused
        reached = deg
    return reached, ""


def _refusal(gate: MotionGate, start: float, end: float, *, azimuth: bool) -> str:
    """Return why the gate, were the dish at `start`, would not let the axis turn straight to `end`; empty if it would.

    An azimuth that may turn the other way round is refused: only the straight way was judged.
    """
    there = copy(gate)
    assert gate.position is not None, "the caller has asked for it"
    if azimuth:
        there.position = replace(gate.position, azimuth=wrap_360(start))
        there.cable_deg = None if gate.cable_deg is None else start
    else:
        there.position = replace(gate.position, elevation=start)
    try:
        there.check(wrap_360(end) if azimuth else None, None if azimuth else end)
    except MotionRefused as refused:
        return str(refused)
    if azimuth:
        way = there.way_to(wrap_360(end))
        if way.other_deg is not None or way.deg * (end - start) <= 0.0:
            return "The azimuth may turn the other way round from there."
    return ""
