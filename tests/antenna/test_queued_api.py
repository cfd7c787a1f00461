"""`BirdcageAntenna` on a dish whose moves queue, as a script drives it (`docs/reference/published-interface.md`)."""

from __future__ import annotations

import pytest
from birdcage.antenna import AntennaConfig, BirdcageAntenna
from birdcage.antenna.leg_sender import LegSender
from birdcage.base.clock import VirtualClock
from birdcage.base.errors import CommandRefused, MotionRefused
from birdcage.link.link import Link
from birdcage.protocol import get_protocol
from birdcage.rotator.values import MOTOR_AZIMUTH
from birdcage.sim.port import SimPort, open_device


class Rig:
    def __init__(self, address="hal205?seed=1"):
        self.clock = VirtualClock()
        self.device = open_device(address, clock=self.clock)
        self.antenna = BirdcageAntenna(get_protocol("hal205"), AntennaConfig(leapfrog_enabled=False))
        self.antenna.attach(Link(SimPort(self.device, "sim:hal205"), self.clock), self.clock)
        self.antenna.initialize()

    def moves(self):
        with self.device.lock:
            self.device.machine.run()
            return [line for _at, line in self.device.shell.received if line.startswith(("a 0", "a 1", "g "))]


def test_both_axes_are_sent_and_take_turns_in_going_first():
    rig = Rig()
    rig.antenna.move_to(200.0, 40.0)
    rig.clock.advance(40)
    rig.antenna.move_to(210.0, 50.0)
    rig.clock.advance(40)
    assert rig.moves() == ["a 0 200.00", "a 1 40.00", "a 1 50.00", "a 0 210.00"]
    assert rig.antenna.get_position().azimuth == pytest.approx(210, abs=0.05)


def test_a_stop_that_can_do_nothing_says_so_and_sends_nothing():
    rig = Rig()
    rig.antenna.move_to(200.0, 40.0)
    rig.clock.advance(2)
    before = rig.moves()
    with pytest.raises(CommandRefused, match="ends in") as refused:
        rig.antenna.stop()
    assert refused.value.reason == "queued"
    assert rig.moves() == before
    rig.clock.advance(40)
    rig.antenna.stop()
    rig.antenna.move_to(210.0, 40.0)
    assert rig.moves()[len(before) :] == ["a 0 210.00"]  # the elevation stands where it was sent


@pytest.mark.parametrize(("az_deg", "el_deg"), [(4.0, 4.0), (90.0, 0.0)], ids=["in legs", "in one slew"])
def test_each_leg_is_judged_once_more_just_before_it_goes_out(az_deg, el_deg):
    """A limit may be set between the plan and its last leg."""
    rig = Rig()
    here = rig.antenna.get_position()
    sender = LegSender(rig.antenna)
    way = sender.plan(here.azimuth + az_deg, here.elevation + el_deg)
    rig.antenna.gate.update(el_max_deg=here.elevation - 1.0)
    before = rig.moves()
    leg = next(leg for leg in way.legs if leg.motor != MOTOR_AZIMUTH)
    with pytest.raises(MotionRefused, match="above the limit"):
        sender.send(leg)
    assert rig.moves() == before
    assert rig.antenna.motion is None
