"""Axes by name and by role: what a machine declares, and how the antenna finds azimuth and elevation in it."""

from __future__ import annotations

from dataclasses import replace

import pytest
from birdcage.antenna.antenna import BirdcageAntenna
from birdcage.base.clock import VirtualClock
from birdcage.protocol.g2.model import CARRYOUT_G2
from birdcage.protocol.hal.model import TRAVLER
from birdcage.rotator.axis import Axis, Role
from birdcage.rotator.hooks import Hooks
from birdcage.rotator.plain import PlainLine, PlainRotator
from birdcage.rotator.values import Look, Position, Taken

PAN = Axis("pan", Role.AZ, 0.0, 360.0, 5.0, 5.0, 0.1)
TILT = Axis("tilt", Role.EL, 0.0, 90.0, 5.0, 5.0, 0.1)


@pytest.mark.parametrize(
    ("axes", "said"),
    [
        ((), "one to three axes"),
        ((PAN, replace(TILT, name="pan")), "a name of its own"),
        ((PAN, TILT, replace(PAN, name="second pan")), "the same role"),
        ((*TRAVLER.axes, replace(PAN, name="fourth")), "one to three axes"),
    ],
)
def test_axes_that_nothing_could_go_by_are_no_facts(axes, said):
    with pytest.raises(ValueError, match=said):
        replace(CARRYOUT_G2, axes=axes)


def test_axes_are_found_by_role_in_whatever_order():
    facts = replace(CARRYOUT_G2, axes=(TILT, PAN))
    assert (facts.azimuth, facts.elevation, facts.skew) == (PAN, TILT, None)
    assert TRAVLER.skew is not None
    assert TRAVLER.numbered[2] is TRAVLER.skew is TRAVLER.named["skew"]
    with pytest.raises(KeyError):
        facts.named["azimuth"]
    slower = facts.with_axes(replace(PAN, speed_deg_s=1.0))
    assert slower.azimuth.speed_deg_s == 1.0
    assert slower.elevation is TILT


class PanTilt(PlainRotator):
    facts = replace(CARRYOUT_G2, axes=(TILT, PAN), features={})

    def __init__(self):
        self.line, self.sent, self.is_open = PlainLine(), [], False
        self.angles = {"tilt": 30.0, "pan": 100.0}

    def open(self, address, baud, clock, hooks):
        self.clock, self.is_open = clock, True

    def look(self, *, hurry=False, busy_s=0.0):
        return Look(self.angles)

    def send(self, to, *, hurry=False, busy_s=0.0):
        self.sent.append(dict(to))
        return Taken(True, "", 0.0)


def test_the_machine_is_spoken_to_by_the_names_of_its_axes():
    machine = PanTilt()
    antenna = BirdcageAntenna(machine)
    antenna.rotator.open("somewhere", None, VirtualClock(), Hooks())
    assert antenna.get_position() == Position(100.0, 30.0)
    antenna.point(120.0, 30.0)
    antenna.point(120.0, 40.0)
    assert machine.sent == [{"pan": 120.0}, {"tilt": 30.0}, {"tilt": 40.0}]
    assert antenna.stop_aim.order().aim_deg.keys() == {"pan", "tilt"}


def test_one_call_names_all_axes_that_change_where_a_machine_takes_them_so():
    machine = PanTilt()
    machine.facts = replace(PanTilt.facts, sends_together=True)
    antenna = BirdcageAntenna(machine)
    antenna.rotator.open("somewhere", None, VirtualClock(), Hooks())
    antenna.point(120.0, 40.0)
    antenna.point(120.0, 45.0)
    assert machine.sent == [{"pan": 120.0, "tilt": 40.0}, {"tilt": 45.0}]
