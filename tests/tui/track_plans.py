"""Plans to show: on great circles, with the error to believe of dish and elements."""

from __future__ import annotations

import math
from dataclasses import replace
from datetime import UTC, datetime, timedelta
from itertools import pairwise

import numpy as np
import sky_stand_in
from birdcage.base.beam import Beam
from birdcage.sky.age import expected_error
from birdcage.sky.downlinks import Downlink
from birdcage.sky.element_error import ElementError
from birdcage.sky.elements import ElementSet
from birdcage.sky.passes.model import Pass
from birdcage.sky.reach_model import LossReason, Lost, PassReach, Stretch
from birdcage.tracking.curve import Curve
from birdcage.tracking.day import Day
from birdcage.tracking.plan import Forecast, Incident, Keyhole, Plan, PlanLeg, PlanPart, PlanTarget, Preposition
from birdcage.tracking.pointing_error import pointing_error

NOON = sky_stand_in.NOON
LRPT = Downlink(
    "METEOR-M2 4", 137.9e6, 137.9e6, "LRPT", "RHCP", True, "a test", "2026-03", symbol_rate_baud=72e3,
    pipeline="meteor_m2-x_lrpt",
)  # fmt: skip


def utc(t_s):
    return datetime.fromtimestamp(t_s, UTC)


def way(start_s, length_s, from_az, to_az, top_deg):
    """A path of the sky, azimuth unrolled."""
    path = sky_stand_in.path_of(start_s, length_s, from_az, to_az, top_deg)
    times = np.array(path.t_s)
    return Curve(times, np.degrees(np.unwrap(np.radians(path.az_deg))), np.array(path.el_deg)), path


def reach_of(path):
    found = sky_stand_in.reach_of(path)
    return replace(found, intervals=tuple(replace(one, turn=0) for one in found.intervals))


def plan(name="METEOR-M2 4", number=59051, minutes=-4.0, length=14.0, from_az=341, to_az=158, top=71.0, *,
         keyhole=None, frequency_hz=137.9e6, offset_s=0.0, age_days=0.25):  # fmt: skip
    """A plan of a pass that rises so many minutes after noon."""
    start_s = NOON + minutes * 60.0
    sky, path = way(start_s, length * 60.0, from_az, to_az, top)
    reach = reach_of(path)
    highest = int(np.argmax(sky.el_deg))
    passing = Pass(name, number, utc(start_s), utc(path.t_s[highest]), utc(path.t_s[-1]), float(from_az),
                   float(path.az_deg[highest]), float(to_az), top)  # fmt: skip
    spans = [(one.start.timestamp(), one.end.timestamp()) for one in reach.intervals]
    legs = tuple(PlanLeg(PlanPart.FOLLOW, a, b, sky.at(a)[0], sky.at(b)[0], 0) for a, b in spans)
    times = np.linspace(spans[0][0], spans[-1][1], 200)
    az, el = sky.sample(times)
    errors = 0.02 + 0.02 * np.abs(np.sin(times / 40.0))
    holes, incidents = (), [Incident(spans[0][0], "reach", "in reach")]
    if keyhole is not None:
        middle = passing.tca.timestamp()
        holes = (Keyhole(middle - keyhole, middle + keyhole, 3.1, 2.2),)
        bump = np.clip(1 - np.abs(times - middle) / keyhole, 0, None)
        errors = errors + 3.1 * bump
        az = az + 14.0 * np.sin(np.clip((times - middle) / keyhole, -1, 1) * math.pi) * (bump > 0)
        incidents.append(Incident(middle - keyhole, "keyhole", "keyhole, up to 3.1° off"))
    for first, second in pairwise(spans):
        incidents.append(Incident(first[1], "unreach", "above the 65° ceiling"))
        incidents.append(Incident(second[0], "reach", "in reach"))
    incidents += [Incident(passing.tca.timestamp(), "tca", "highest"),
                  Incident(spans[-1][1], "unreach", "below the 18° floor"),
                  Incident(path.t_s[-1], "los", "sets")]  # fmt: skip
    first = sky.at(spans[0][0])
    dish = Forecast(times, errors, 12.0 * (errors / 2.6) ** 2, float(np.sqrt(np.mean(errors**2))), float(errors.max()))
    aged = elements_of(number, passing, age_days)
    return Plan(
        PlanTarget(name, "satellite", number, frequency_hz, offset_s,
        downlink=LRPT if frequency_hz == 137.9e6 else None),
        utc(NOON - 600.0), passing, reach, sky,
        Curve(times, az, el), legs,
        Preposition(first[0], first[1], first[0] % 360.0, first[1], (first,), spans[0][0] - 68.0, 8.0), holes,
        dish, tuple(sorted(incidents, key=lambda each: each.at_s)),
        ("Above the 65° ceiling for 2.7 min.",) if len(spans) > 1 else (),
        elements=aged, pointing=pointing_error(dish, aged, Beam(2.6, 2.6)),
    )  # fmt: skip


def elements_of(number, passing, age_days):
    """What elements that old mean for a pass, nearest in its middle."""
    epoch = passing.tca - timedelta(days=age_days)
    elements = ElementSet("", number, epoch, 98.7, 0, 0.0001, 0, 0, 14.2, mean_motion_dot=2e-6)
    closest = expected_error(elements, passing.tca, 1000.0)
    times = np.linspace(passing.aos.timestamp(), passing.los.timestamp(), 121)
    shape = 1.0 / (1.0 + 9.0 * np.linspace(-1.0, 1.0, 121) ** 2)
    if closest.pointing_median_deg is None:
        return ElementError(elements, closest, times, None, None)
    return ElementError(
        elements, closest, times, closest.pointing_median_deg * shape, closest.pointing_p90_deg * shape
    )  # fmt: skip


def believed(of, t_s, error):
    """The error to believe at a time of a plan."""
    return error if of.pointing is None else of.pointing.at(t_s, error)


def moon():
    """A plan of what does not pass."""
    times = np.linspace(NOON, NOON + 3600.0, 61)
    sky = Curve(times, 171.0 + (times - NOON) / 200.0, 42.0 + (times - NOON) / 900.0)
    reach = PassReach((Stretch(utc(NOON), utc(NOON + 3600.0), 0),), (), 46.0)
    dish = Forecast(times, np.full(61, 0.02), None, 0.02, 0.03)
    return Plan(
        PlanTarget("Moon", "body"), utc(NOON), None, reach, sky, sky,
        (PlanLeg(PlanPart.FOLLOW, NOON, NOON + 3600.0, 171.0, 189.0, 0),),
        Preposition(171.0, 42.0, 171.0, 42.0, ((171.0, 42.0),), NOON, 3.0), (),
        dish, (), pointing=pointing_error(dish, None, None),
    )  # fmt: skip


def geo(name="110.0°W EchoStar", *, az_deg=190.0, el_deg=40.0, drift_deg=0.0, limit="", number=None):
    """A plan of what is always up; with a `limit` that keeps it out of reach."""
    times = np.linspace(NOON, NOON + 86400.0, 145)
    turn = np.sin((times - NOON) / 86400.0 * 2.0 * math.pi)
    day_sky = Curve(times, az_deg + 0.1 * drift_deg * turn, el_deg + 0.5 * drift_deg * turn)
    whole = Stretch(utc(NOON), utc(NOON + 86400.0), 0)
    lost = Lost(utc(NOON), utc(NOON + 86400.0), LossReason.FLOOR)
    day_reach = PassReach((), (lost,), None) if limit else PassReach((whole,), (), el_deg)
    sky = Curve(times[:7], day_sky.az_deg[:7], day_sky.el_deg[:7])
    end_s = NOON + 3600.0
    dish = Forecast(times[:7], np.full(7, 0.03), None, 0.03, 0.06)
    bare = Plan(
        PlanTarget(name, "slot" if number is None else "satellite", number), utc(NOON), None,
        PassReach((), (Lost(utc(NOON), utc(end_s), LossReason.FLOOR),), None), sky, None, (), None, (), None, (),
        (f"Always up, out of reach: {limit}.",), day=Day(day_sky, day_reach, (limit,) if limit else ()),
    )  # fmt: skip
    if limit:
        return bare
    return replace(
        bare, reach=PassReach((Stretch(utc(NOON), utc(end_s), 0),), (), el_deg), course=sky, notes=(),
        legs=(PlanLeg(PlanPart.FOLLOW, NOON, end_s, az_deg, az_deg, 0),),
        preposition=Preposition(az_deg, el_deg, az_deg, el_deg, ((az_deg, el_deg),), NOON, 3.0),
        forecast=dish, pointing=pointing_error(dish, None, None),
    )  # fmt: skip
