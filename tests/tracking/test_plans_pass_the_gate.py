"""What a controller makes of any plan passes the real gate, as it is printed on the wire."""

from __future__ import annotations

import pytest
from birdcage.antenna.gate import MotionBounds, MotionGate
from birdcage.base.errors import MotionRefused
from birdcage.base.geometry import wrap_360
from birdcage.base.no_go import NoGoSector
from birdcage.kinematics import Slew
from birdcage.rotator.values import Position
from birdcage.tracking.plan import PlanPart
from birdcage.tracking.planning.planner import plan_pass
from birdcage.tracking.steering.choice import controller_for
from birdcage.tracking.steps import ReadPosition, Send
from hypothesis import given, settings

from .orbits import PLACE, g2, mount, plan_of, travler
from .rig import Rig
from .test_planner_properties import cases


class Wire:
    """The gate as the antenna asks it: from the last reading to where both axes are then sent."""

    def __init__(self, on):
        floor, ceiling = on.el_min_deg, on.el_max_deg
        self.gate = MotionGate(on.model, MotionBounds(floor, ceiling, sectors=tuple(
            on.alignment.sector_to_dish(one.az_from_deg, one.az_to_deg, one.el_below_deg) for one in on.limits.no_go
        )))  # fmt: skip
        self.sent = [None, None]
        self.looks = 0

    def see(self, rig):
        az, el = rig.at(0), rig.at(1)
        self.gate.see(Position(round(az % 360.0, 2) % 360.0, round(el, 2)))

    def take(self, rig, step):
        if isinstance(step, ReadPosition):
            self.see(rig)
        elif isinstance(step, Send):
            self.sent[step.axis] = round(wrap_360(step.deg), 2) % 360.0 if step.axis == 0 else round(step.deg, 2)
            try:
                self.gate.check(*self.sent)
            except MotionRefused as refused:
                if refused.reason != "sector":
                    raise
                # As `Pursuing` does: the last reading may be a second old.
                self.looks += 1
                self.see(rig)
                self.gate.check(*self.sent)


def follow(plan, on, *, seconds=None):
    _name, controller = controller_for(on.model)
    queues = on.model.moves_in_turn
    wire = Wire(on)
    for leg in plan.legs:
        if leg.part is not PlanPart.FOLLOW:
            continue
        rig = Rig(plan.course, on.model, mode="queue" if queues else "retarget")
        az, el = plan.course.at(leg.start_s)
        rig.now, rig.ways = (
            leg.start_s,
            {0: [(leg.start_s - 9.0, Slew(az, ()))], 1: [(leg.start_s - 9.0, Slew(el, ()))]},
        )
        wire.gate.position, wire.sent = None, [None, None]
        wire.see(rig)
        wire.gate.cable_deg = rig.at(0) if on.limits.turn_known else None
        until_s = leg.end_s if seconds is None else min(leg.end_s, leg.start_s + seconds)
        rig.run(controller, each=wire.take, until_s=until_s)
    return wire


@settings(max_examples=6, deadline=None, derandomize=True)
@given(cases())
def test_of_any_plan(case):
    target, passing, on, now = case
    plan = plan_pass(target, PLACE, on, now, passing=passing)
    if plan.course is not None:
        follow(plan, on, seconds=40.0)


def test_at_its_ceiling():
    on = mount(g2(), tolerance_deg=4.0)
    plan = plan_of(2.5, on)
    assert plan.course.el_deg.max() == pytest.approx(65.0, abs=1e-6)
    follow(plan, on, seconds=200.0)


MAST = NoGoSector(100.0, 120.0, 50.0, "mast")
NORTH = {"inclination_deg": 51.6, "height_km": 420.0}


def crossing_north(*, known, no_go=(MAST,)):
    """A pass from west over north to east on a Trav'ler, far off the mast as long as the dish goes the short way."""
    on = mount(travler(5.0), at=(270.0, 30.0), known=known, no_go=no_go)
    return plan_of(-6.0, on, orbit=NORTH), on


def test_a_plan_leaves_out_what_the_gate_refuses_while_the_turn_is_not_known():
    (known, on), (unknown, doubtful) = crossing_north(known=True), crossing_north(known=False)
    (leg,) = known.legs
    assert leg.from_az_deg < 360.0 < leg.to_az_deg
    assert not any("Home the dish" in note for note in known.notes)
    follow(known, on, seconds=30.0)
    before, after = unknown.legs
    assert before.to_az_deg < 359.0
    assert after.from_az_deg > 361.0
    assert min(el for _az, el in after.waypoints[:-1]) > 50.0, "over the mast, whichever way round"
    assert any("swing through a no-go sector. Home the dish" in note for note in unknown.notes)
    follow(unknown, doubtful, seconds=30.0)
    gate = Wire(doubtful).gate
    here = unknown.course.at(before.end_s)
    for az, el in after.waypoints:
        gate.see(Position(here[0] % 360.0, here[1]))
        gate.check(az % 360.0, el)
        here = az, el


def test_without_a_sector_an_unknown_turn_costs_nothing_at_north():
    plan, _on = crossing_north(known=False, no_go=())
    assert len(plan.legs) == 1
