"""A dish that a person has stopped is HELD for a script that drives it without a station."""

from __future__ import annotations

from datetime import UTC, datetime

import pytest
from birdcage.antenna import AntennaConfig, BirdcageAntenna
from birdcage.base.clock import VirtualClock
from birdcage.base.errors import Held
from birdcage.base.held import HeldFile, HeldNote
from birdcage.base.paths import Paths
from birdcage.link.identity import dish_folder, dish_identity
from birdcage.link.link import Link
from birdcage.protocol import get_protocol
from birdcage.sim.port import SimPort, open_device


@pytest.fixture
def port(tmp_path):
    device = tmp_path / "ttyUSB0"
    device.touch()
    return str(device)


@pytest.fixture
def rig(port):
    clock = VirtualClock()
    device = open_device("g2?seed=1&az=-180", clock=clock)
    antenna = BirdcageAntenna(get_protocol("g2"), AntennaConfig(leapfrog_enabled=False))
    antenna.attach(Link(SimPort(device, port), clock), clock)
    antenna.initialize()
    antenna.get_position()
    return antenna, device


def test_a_script_moves_nothing_that_a_person_holds(rig, port):
    antenna, device = rig
    file = HeldFile(dish_folder(Paths.default().state, dish_identity(port)))
    file.write(HeldNote("anna", datetime(2026, 11, 22, tzinfo=UTC)))
    moves = [
        lambda: antenna.move_to(200.0, 45.0),
        lambda: antenna.move_to(200.0, 5.0),
        lambda: antenna.steer(0, 200.0),
        lambda: antenna.protocol.move_motor(0, 200.0),
        lambda: antenna.protocol.home_motor(0),
    ]
    for move in moves:
        with pytest.raises(Held, match=r"HELD by .*anna.*`birdcage release` lets it move again"):
            move()
    assert antenna.motion is None
    antenna.stop()
    device.machine.run()
    assert [line for _, line in device.shell.received if line.startswith(("a ", "h "))] == []
    file.remove()
    antenna.move_to(200.0, 45.0)
    device.machine.run()
    assert "a 0 200.00" in [line for _, line in device.shell.received]
