"""Step 5: safeguarded Newton on the interpolated orbits, for all events of all satellites at once."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from birdcage.sky.frames import Floats
from birdcage.sky.passes import quintic
from birdcage.sky.passes.brackets import Brackets
from birdcage.sky.passes.ground import Course, ObserverTrack
from birdcage.sky.passes.nodes import Intervals

_TURN_STEPS = 3
_CROSSING_STEPS = 2


def crossing_step(course: Course, sin_mask: float, rising: NDArray[np.bool_]) -> Floats:
    """Return the time to where the elevation's second-order Taylor series crosses the mask in the right direction.

    Of the parabola's two roots it is the one with the right slope, so that a grazing pass does not lose its rise to
    its set. Where the parabola misses the mask, the time to its turning point.
    """
    above = course.sine - sin_mask
    reach = course.rate * course.rate - 2.0 * above * course.bend
    slope = np.where(rising, 1.0, -1.0) * np.sqrt(np.maximum(reach, 0.0))
    with np.errstate(divide="ignore", invalid="ignore"):
        # The same root in two forms, each where it does not take the difference of two near numbers.
        step = np.where(
            course.rate * slope > 0.0, -2.0 * above / (course.rate + slope), (slope - course.rate) / course.bend
        )
        step = np.where(reach < 0.0, -course.rate / course.bend, step)
    return np.where(np.isfinite(step), step, 0.0)


def turning_step(course: Course) -> Floats:
    """Return the time to where the elevation stops rising or sinking."""
    with np.errstate(divide="ignore", invalid="ignore"):
        step = -course.turn / course.turn_rate
    return np.where(np.isfinite(step), step, 0.0)


@dataclass(frozen=True, slots=True)
class Turns:
    """Turning points on the interpolated orbits."""

    s: Floats
    above: Floats
    """The sine of the elevation over the mask's."""


def turning_points(
    ground: ObserverTrack, intervals: Intervals, brackets: Brackets, highest: NDArray[np.bool_]
) -> Turns:
    """Return the turning point in each bracket: a maximum where `highest`, else a minimum."""
    begin, h = intervals.begin_s[brackets.interval], intervals.length_s[brackets.interval]
    c = intervals.c[:, :, brackets.interval]
    low, high, s = brackets.low, brackets.high, brackets.guess
    for _ in range(_TURN_STEPS):
        course = ground.course(begin + s * h, *quintic.at(c, h, s))
        before = (course.turn > 0.0) == highest
        low, high = np.where(before, s, low), np.where(before, high, s)
        s = _inside(s + turning_step(course) / h, low, high)
    course = ground.course(begin + s * h, *quintic.at(c, h, s))
    return Turns(s, course.sine - ground.sin_mask)


def crossings(ground: ObserverTrack, intervals: Intervals, brackets: Brackets, rising: NDArray[np.bool_]) -> Floats:
    """Return where in its interval (0 to 1) each bracket's crossing of the mask is."""
    begin, h = intervals.begin_s[brackets.interval], intervals.length_s[brackets.interval]
    c = intervals.c[:, :, brackets.interval]
    low, high, s = brackets.low, brackets.high, brackets.guess
    for _ in range(_CROSSING_STEPS):
        course = ground.course(begin + s * h, *quintic.at(c, h, s))
        before = (course.sine < ground.sin_mask) == rising
        low, high = np.where(before, s, low), np.where(before, high, s)
        s = _inside(s + crossing_step(course, ground.sin_mask, rising) / h, low, high)
    return s


def _inside(wanted: Floats, low: Floats, high: Floats) -> Floats:
    """Return Newton's next point where it lies in the bracket, else the bracket's middle."""
    return np.where((wanted >= low) & (wanted <= high), wanted, 0.5 * (low + high))
