"""What a simulated machine leaves to whoever drives it by sending it directions: the least error, in degrees RMS.

Only what no driver can avoid is in it, as a root sum square:

    slow    axes that are too slow for the pass (a keyhole): what the best course that the planner knows leaves
    steps   each axis stands at whole steps: step / sqrt(12); and, where its motor has to rest after each command, at an
            overshoot that is another one each time: how far that is from its mean
    stair   the target's way from one command of an axis to its next, the wire shared between both axes as is best

The stair is what is left of a cycle of period T = d / rate: a move over d, from rest to rest, that lasts as long as
was measured, or m = 2 sqrt(d / a), and a rest. For m = 0 it is d / sqrt(12), and less where the move takes part of the
cycle. T is one answer a command, or one for both axes where one command carries both; where moves wait for each other,
a command takes its move where that is longer.

Not in it, as a driver can avoid them: the mean of overshoot and dead-band, which can be learnt; all of the overshoot of
a motor that takes a speed, as it need not rest; a wait for an answer while a move is under way, a reading, and the
chance of a delay.
"""

from __future__ import annotations

import math
from functools import cache
from itertools import product

import numpy as np
from birdcage.rotator.axis import Axis
from birdcage.rotator.facts import Facts
from birdcage.tracking.plan import Plan

TURNS = tuple(pair for pair in product((1, 2, 3, 5), repeat=2) if math.gcd(*pair) == 1)
"""How many commands azimuth and elevation get in a cycle."""
EVERY = 50
"""One of so many samples is worked out."""


def limit_deg(free: Plan, facts: Facts, times: np.ndarray, answer_s: float, scatter_deg: float = 0.0) -> float:
    """Return it over some times, POSIX seconds. `free`: the plan of one that takes each command at once."""
    az, el = free.sky.sample(times)
    slow = 0.0
    if free.course is not None:
        on_az, on_el = free.course.sample(times)
        turn = (np.mod(on_az - az + 180.0, 360.0) - 180.0) * np.cos(np.radians(el))
        slow = float(np.mean(turn**2 + (on_el - el) ** 2))
    lift = np.cos(np.radians(el))
    steps = (facts.azimuth.step_deg**2 * float(np.mean(lift**2)) + facts.elevation.step_deg**2) / 12.0
    steps += scatter_deg**2 * (float(np.mean(lift**2)) + 1.0)
    rates = rates_deg_s(free, times)
    some = zip(rates[::EVERY], lift[::EVERY], strict=True)
    stairs = [stair_deg2(facts, each, answer_s, across) for each, across in some]
    return math.sqrt(slow + steps + float(np.mean(stairs)))


def rates_deg_s(plan: Plan, times: np.ndarray) -> np.ndarray:
    """Return how fast the target turns azimuth and elevation, a row a time."""
    az, el = plan.sky.sample(times)
    later_az, later_el = plan.sky.sample(times + 0.1)
    return np.abs(np.column_stack((np.mod(later_az - az + 180.0, 360.0) - 180.0, later_el - el))) / 0.1


def stair_deg2(facts: Facts, rates: np.ndarray, answer_s: float, lift: float = 1.0) -> float:
    """Return the mean square of the stair of both axes, in square degrees on the sky."""
    axes = facts.azimuth, facts.elevation
    scales = lift, 1.0
    if facts.sends_together:
        cycles = [((1, 1), answer_s)]
    else:
        cycles = [(turns, _cycle_s(facts, rates, turns, answer_s)) for turns in TURNS]
    return min(
        sum(
            left_deg2(axis, rate * cycle_s / count, cycle_s / count) * scale**2
            for axis, rate, count, scale in zip(axes, rates.tolist(), turns, scales, strict=True)
        )
        for turns, cycle_s in cycles
    )


def left_deg2(axis: Axis, way_deg: float, period_s: float) -> float:
    """Return the mean square error of an axis that goes `way_deg` in each period, and rests for what is left of it."""
    share = min(_move_s(axis, way_deg) / max(period_s, 1e-9), 1.0)
    return way_deg**2 * _left(round(share, 2))


def _move_s(axis: Axis, way_deg: float) -> float:
    """Return how long a short move takes from rest to rest: as it was measured, else by its acceleration."""
    if axis.times is not None:
        return axis.times.seconds(way_deg)
    return 2.0 * math.sqrt(way_deg / axis.acceleration_deg_s2)


def _cycle_s(facts: Facts, rates: np.ndarray, turns: tuple[int, int], answer_s: float) -> float:
    spent_s = answer_s * sum(turns)
    if not facts.moves_in_turn:
        return spent_s
    axes = facts.azimuth, facts.elevation
    for _ in range(30):
        spent_s = sum(
            count * max(answer_s, _move_s(axis, rate * spent_s / count))
            for axis, rate, count in zip(axes, rates.tolist(), turns, strict=True)
        )
    return spent_s


@cache
def _left(share: float) -> float:
    """Return the variance of a cycle of one degree of which the move, speeding up and then braking, takes a share."""
    t = (np.arange(400) + 0.5) / 400.0
    s = np.minimum(t / max(share, 1e-9), 1.0)
    gone = np.where(s < 0.5, 2.0 * s**2, 1.0 - 2.0 * (1.0 - s) ** 2)
    return float(np.var(gone - t))
