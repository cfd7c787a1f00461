"""Where the motors have to be so that the shafts are on the target: the play of the gear, less the overshoot.

The shaft lags the motor by half the play, whichever way it turns, and a motor that comes to rest past its target
carries it on. So the course of a motor is the target's with the difference added in the direction in which the axis
turns; it changes sides where the axis turns back (decision 0035).
"""

from __future__ import annotations

from functools import lru_cache
from typing import TypeAlias

import numpy as np

from birdcage.rotator.facts import Facts
from birdcage.tracking.curve import Curve, Floats

Pair: TypeAlias = tuple[float, float]


def course_of_motors(
    course: Curve, model: Facts, az_span: tuple[float, float] | None = None,
    el_span: tuple[float, float] | None = None,
) -> Curve:  # fmt: skip
    """Return the course of the motors that keeps the shafts on `course`; itself where nothing is known of the gear.

    It goes beyond what `course` asks for only within the spans (least and greatest angle that may be commanded).
    """
    leads = tuple((axis.lead_deg(1.0), axis.lead_deg(-1.0)) for axis in (model.azimuth, model.elevation))
    return _shifted(course, leads, (az_span, el_span)) if any(map(any, leads)) else course


@lru_cache(maxsize=4)
def _shifted(course: Curve, leads: tuple[Pair, ...], spans: tuple[Pair | None, ...]) -> Curve:
    az_deg, el_deg = (
        _led(course.t_s, deg, lead, span)
        for deg, lead, span in zip((course.az_deg, course.el_deg), leads, spans, strict=True)
    )
    return Curve(course.t_s, az_deg, el_deg)


def _led(t_s: Floats, deg: Floats, leads: Pair, span: Pair | None) -> Floats:
    low, high = float(deg.min()), float(deg.max())
    if span is not None:
        low, high = min(low, span[0]), max(high, span[1])
    rate = np.gradient(deg, t_s)
    lead = np.where(rate > 0.0, leads[0], np.where(rate < 0.0, leads[1], 0.0))
    led: Floats = np.clip(deg + lead, low, high)
    return led
