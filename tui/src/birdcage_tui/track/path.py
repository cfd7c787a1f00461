"""A plan as points to draw: where the target goes, where the dish is to stand, true degrees; worked out once a plan."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from birdcage.base.geometry import separation, shortest_turn

from birdcage_tui.drawing.canvas import Braille
from birdcage_tui.drawing.polar import Polar, WayDot, draw_way
from birdcage_tui.shown.pursuit import to_true
from birdcage_tui.shown.view import View

if TYPE_CHECKING:
    from birdcage.tracking.plan import Plan

STEPS = 240
"""Pieces that a path is drawn in."""
APART_DEG = 0.4
"""From how far on the dish's way is drawn beside the target's: less is not to be seen."""
TICKS_S = (30.0, 60.0, 120.0, 300.0, 600.0, 1800.0)
MOST_TICKS = 8


@dataclass(frozen=True, slots=True)
class Spot:
    """One moment of a plan."""

    t_s: float
    az_deg: float
    """Of the target, unrolled."""
    el_deg: float
    held: bool
    """Whether the dish can follow there."""
    course: tuple[float, float] | None
    """Where the dish is to stand, azimuth unrolled next to the target's; None outside its legs."""


class Points:
    """Keeps the points of the last plan."""

    def __init__(self) -> None:
        self._kept: tuple[Plan, float, tuple[Spot, ...]] | None = None

    def of(self, plan: Plan, view: View) -> tuple[Spot, ...]:
        """Return the points, in order of time."""
        turn = to_true(view, 0.0, 0.0)[0]
        if self._kept is None or self._kept[0] is not plan or abs(self._kept[1] - turn) > 0.05:
            self._kept = (plan, turn, tuple(_spots(plan, view)))
        return self._kept[2]


def _spots(plan: Plan, view: View) -> list[Spot]:
    spans = [(one.start.timestamp(), one.end.timestamp()) for one in plan.reach.intervals]
    start_s, end_s, found = plan.sky.start_s, plan.sky.end_s, []
    for step in range(STEPS + 1):
        t_s = start_s + (end_s - start_s) * step / STEPS
        az_deg, el_deg = plan.sky.at(t_s)
        course = None
        if plan.course is not None and any(leg.start_s <= t_s <= leg.end_s for leg in plan.legs):
            true_az, true_el = to_true(view, *plan.course.at(t_s))
            course = az_deg + shortest_turn(az_deg, true_az), true_el
        found.append(Spot(t_s, az_deg, el_deg, any(a <= t_s <= b for a, b in spans), course))
    return found


def draw_path(canvas: Braille, polar: Polar, spots: tuple[Spot, ...], now_s: float) -> None:
    """Draw the way of the target, past dotted, bright in reach; beside it that of the dish where it differs."""
    draw_way(
        canvas,
        (WayDot(polar.dot(spot.az_deg, max(spot.el_deg, 0.0)), spot.held, spot.t_s < now_s) for spot in spots),
    )
    for spot in spots:
        if spot.course is not None and separation(*spot.course, spot.az_deg, spot.el_deg) > APART_DEG:
            canvas.dot(*polar.dot(*spot.course), "accent")


def ticks(spots: tuple[Spot, ...], now_s: float) -> list[tuple[float, float, float]]:
    """Return round moments to come while it is in reach, with azimuth and elevation: few enough to be written."""
    if not spots:
        return []
    start_s, end_s = max(spots[0].t_s, now_s), spots[-1].t_s
    every = next((each for each in TICKS_S if (end_s - spots[0].t_s) / each <= MOST_TICKS), TICKS_S[-1])
    found, at_s, index = [], (start_s // every + 1) * every, 0
    while at_s < end_s:
        while spots[index].t_s < at_s:
            index += 1
        if spots[index].el_deg > 2.0:
            found.append((at_s, spots[index].az_deg, spots[index].el_deg))
        at_s += every
    return found
