"""`BirdcageAntenna` on a dish whose moves queue, as a script drives it (document 003)."""

from __future__ import annotations

import pytest
from birdcage.antenna import AntennaConfig, BirdcageAntenna
from birdcage.base.clock import VirtualClock
from birdcage.base.errors import CommandRefused
from birdcage.link.link import Link
from birdcage.protocol import get_protocol
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
