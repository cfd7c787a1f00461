"""A station that takes over the antenna of a script."""

from __future__ import annotations

import threading

import pytest
from birdcage.antenna.antenna import BirdcageAntenna
from birdcage.antenna.config import AntennaConfig
from birdcage.base.clock import VirtualClock
from birdcage.base.errors import WrongThread
from birdcage.link.link import Link
from birdcage.protocol import CarryoutG2Protocol
from birdcage.sim.port import SimPort, open_device
from birdcage.station.requests import Goto
from birdcage.station.session import Session
from birdcage.station.settings import StationSettings
from birdcage.station.state import LinkPhase
from birdcage.station.station import Station


def test_it_owns_the_antenna_from_the_first_step_and_drives_it():
    clock = VirtualClock()
    device = open_device("g2?seed=1", clock=clock)

    def dial(port, baud):
        return Link(SimPort(device, port, baud=baud), clock)

    antenna = BirdcageAntenna(CarryoutG2Protocol(), AntennaConfig("sim:test", min_elevation=30.0))
    antenna.attach(dial("sim:test", 115200), clock)
    assert antenna.get_position().azimuth >= 0.0
    station = Station.adopt(antenna, clock, StationSettings(port="sim:test", firmware="g2", open_link=dial))
    assert not antenna.is_connected
    session = Session(clock, station)
    session.step(4.0)
    assert station.state.link.state is LinkPhase.UP
    future = station.submit(Goto(170.0, 45.0, "you"))
    session.step(30.0)
    assert future.result(0).az_deg == pytest.approx(170.0, abs=0.1)

    caught = []

    def call():
        try:
            antenna.get_position()
        except WrongThread as wrong:
            caught.append(wrong)

    thread = threading.Thread(target=call)
    thread.start()
    thread.join()
    assert caught
    session.close()
    thread = threading.Thread(target=lambda: caught.append(antenna.is_connected))
    thread.start()
    thread.join()
    assert caught[-1] is False
