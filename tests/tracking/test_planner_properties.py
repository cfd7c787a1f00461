"""Whatever the pass, the dish, the mask, the sectors and the turn: a plan never asks for what must not be."""

from __future__ import annotations

import itertools
from dataclasses import replace

import numpy as np
from birdcage.antenna.alignment import Alignment
from birdcage.antenna.gate import MotionBounds, MotionGate
from birdcage.base.no_go import NoGoSector
from birdcage.protocol.hal.model import TRAVLER
from birdcage.rotator.values import Position
from birdcage.sky.horizon import HorizonMask
from birdcage.tracking.plan import PlanPart
from birdcage.tracking.planning.planner import plan_pass
from birdcage.tracking.planning.rates import mean_rate_deg_s
from hypothesis import given, settings
from hypothesis import strategies as st

from .orbits import NOW, PLACE, g2, mount, overhead, travler

MODELS = (g2(), g2(88.0), travler(5.0), travler(3.0), TRAVLER)

sectors = st.builds(
    lambda az, width, below: NoGoSector(float(az), float((az + width) % 360), float(below), "mast"),
    st.integers(0, 359), st.integers(2, 90), st.sampled_from([20, 30, 50, 64, 70, 91]),
)  # fmt: skip
masks = st.lists(st.tuples(st.integers(0, 359), st.integers(0, 50)), max_size=5).map(
    lambda points: HorizonMask([(float(az), float(el)) for az, el in points]) or None
)
passes = st.tuples(
    st.sampled_from([-12.0, -6.0, -2.0, -0.4, 0.07, 0.4, 1.5, 3.0, 6.0, 12.0]),
    st.sampled_from([(420.0, 51.6), (550.0, 64.5), (820.0, 98.7)]),
    st.booleans(),
)


@st.composite
def cases(draw):
    aside, (height_km, inclination_deg), northbound = draw(passes)
    target, passing = overhead(aside, height_km=height_km, inclination_deg=inclination_deg, northbound=northbound)
    model = draw(st.sampled_from(MODELS))
    low, high = model.cable.min_deg, model.cable.max_deg
    at = draw(st.none() | st.tuples(st.floats(low + 1.0, high - 1.0), st.floats(model.elevation.min_deg, 60.0)))
    known = draw(st.booleans())
    if at is not None and not known:
        at = at[0] % 360.0, at[1]
    alignment = draw(st.sampled_from([Alignment(), Alignment(77.0), Alignment(-140.0, 1.0, 0.4, 1.2, -0.8)]))
    on = mount(
        model, at=at, known=known, alignment=alignment, az_offset_deg=alignment.az_offset_deg,
        no_go=tuple(draw(st.lists(sectors, max_size=3))), horizon=draw(masks),
    )  # fmt: skip
    begin = draw(st.sampled_from(["before", "amid"]))
    return target, passing, on, NOW if begin == "before" else passing.tca


def blocked(on, az_deg, el_deg):
    """Whether any of some directions, in the dish's degrees, lies in a no-go sector."""
    true = np.array([on.alignment.to_true(az % 360.0, el) for az, el in zip(az_deg, el_deg, strict=True)])
    inside = np.zeros(len(true), dtype=bool)
    for sector in on.limits.no_go:
        width = (sector.az_to_deg - sector.az_from_deg) % 360.0
        inside |= ((true[:, 0] - sector.az_from_deg) % 360.0 <= width) & (true[:, 1] < sector.el_below_deg)
    return inside


def assert_gate_passes(on, start, stops):
    """The gate of the station lets the dish go from stop to stop, and by the turns that are meant."""
    gate = MotionGate(on.model, MotionBounds(
        sectors=tuple(
            on.alignment.sector_to_dish(one.az_from_deg, one.az_to_deg, one.el_below_deg) for one in on.limits.no_go
        )
    ))  # fmt: skip
    gate.see(Position(start[0] % 360.0, start[1]))
    gate.cable_deg = start[0]
    for az, el in stops:
        gate.check(az % 360.0, el)
        assert abs(gate.cable_turns(az % 360.0)[0] - az) < 1e-6
        gate.see(Position(az % 360.0, el))
        assert abs(gate.cable_deg - az) < 1e-6


def assert_sound(plan, on):
    model, limits = on.model, on.limits
    course = plan.course
    times = np.unique(np.concatenate([course.t_s, np.arange(course.start_s, course.end_s, 0.1), [course.end_s]]))
    az, el = course.sample(times)
    assert el.min() >= model.elevation.min_deg - 2e-3
    assert el.max() <= model.elevation.max_deg + 2e-3
    if limits.turn_known:
        assert az.min() >= limits.cable_min_deg
        assert az.max() <= limits.cable_max_deg
    assert not on.limits.no_go or not blocked(on, az[::3], el[::3]).any()
    for before, after in zip(plan.legs, plan.legs[1:], strict=False):
        assert before.end_s <= after.start_s
        if before.part is after.part is PlanPart.FOLLOW:
            assert before.turn == after.turn
    for leg in plan.legs:
        if leg.part is PlanPart.REWIND:
            assert [one.at_s for one in plan.incidents if one.what == "rewind"].count(leg.start_s) == 1
        within = (times >= leg.start_s) & (times <= leg.end_s)
        slow = leg.part is PlanPart.FOLLOW
        for angles, axis in ((az, model.azimuth), (el, model.elevation)):
            most = mean_rate_deg_s(axis) if slow else max(axis.speed_deg_s, 25.0) * 2.0
            way = np.abs(np.diff(angles[within]))
            assert (way <= most * np.diff(times[within]) * 1.03 + 5e-3).all()
    if plan.preposition is not None and on.standing is not None:
        place = plan.preposition
        points = [(on.standing.az_deg, on.standing.el_deg), *place.waypoints]
        assert all(abs(b[0] - a[0]) < 180.0 for a, b in itertools.pairwise(points))
        if limits.turn_known and not blocked(on, np.array([points[0][0]]), np.array([points[0][1]])).any():
            assert_gate_passes(on, points[0], place.waypoints)
    for before, leg in zip(plan.legs, plan.legs[1:], strict=False):
        if leg.waypoints and limits.turn_known:
            assert_gate_passes(on, course.at(before.end_s), leg.waypoints)


@settings(max_examples=150, deadline=None, derandomize=True)
@given(cases())
def test_no_plan_breaks_a_limit(case):
    target, passing, on, now = case
    plan = plan_pass(target, PLACE, on, now, passing=passing)
    if plan.course is None:
        assert not plan.legs
        return
    assert_sound(plan, on)
    assert all(one.start_s >= now.timestamp() for one in plan.legs)
    if now is not NOW:
        return  # in mid-pass it is also where the dish stands that decides what it still gets
    wider = plan_pass(
        target, PLACE, replace(on, limits=replace(on.limits, no_go=(), horizon=None)), now, passing=passing
    )
    # Where a rewind must be, a plan may rather lose more seconds of low elevation than fewer overhead.
    assert wider.rewinds or followed_s(plan) <= followed_s(wider) + 3.0


def followed_s(plan):
    return sum(leg.end_s - leg.start_s for leg in plan.legs if leg.part is PlanPart.FOLLOW)
