"""A station without a port: lost, quiet, and ready to be told one."""

from birdcage.base.clock import VirtualClock
from birdcage.link.link import Link
from birdcage.sim.port import SimPort, open_device
from birdcage.station.requests import Connect
from birdcage.station.session import Session
from birdcage.station.settings import StationSettings
from birdcage.station.state import LinkPhase as LinkNow
from birdcage.station.station import Station


def test_nothing_is_opened_or_looked_for_before_a_port_is_chosen():
    clock = VirtualClock()
    device = open_device("g2?seed=1", clock=clock)
    opened, sought = [], []

    def open_port(port, _baud):
        opened.append(port)
        return Link(SimPort(device, port), clock)

    def find(port):
        sought.append(port)
        return port

    station = Station(clock, StationSettings(port="", firmware="g2", open_link=open_port, find_port=find))
    session = Session(clock, station)
    session.step(60)
    assert station.state.link.state is LinkNow.LOST
    assert "Choose a port in Setup" in station.state.link.detail
    assert (opened, sought) == ([], [])
    station.submit(Connect("/dev/ttyUSB0"))
    session.step(5)
    assert station.state.link.state is LinkNow.UP
    assert set(opened) == {"/dev/ttyUSB0"}
