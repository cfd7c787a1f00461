"""A station drives a class that has only the published methods, and a port of its own."""

from __future__ import annotations

import pytest
from birdcage.base.clock import VirtualClock
from birdcage.base.errors import LinkError, Stopped
from birdcage.protocol import FirmwareProtocol, Position
from birdcage.rotator import machines
from birdcage.station.requests import Goto
from birdcage.station.session import Session
from birdcage.station.settings import StationSettings
from birdcage.station.state import LinkPhase
from birdcage.station.station import Station

SPEED_DEG_S = 10.0
EXCHANGE_S = 0.02


class OwnPort(FirmwareProtocol):
    """A dish that goes at an even speed, and takes a new target while it does."""

    clock: VirtualClock
    gone = False

    def __init__(self):
        self.moves = []
        self.open = False
        self.ways = {0: (180.0, 180.0, 0.0), 1: (45.0, 45.0, 0.0)}

    def connect(self, port, baudrate=57600):
        self.open = True

    def disconnect(self):
        self.open = False

    @property
    def is_connected(self):
        return self.open

    def initialize(self, callback=None):
        pass

    def enter_motor_menu(self):
        if self.gone:
            raise OSError("Input/output error")

    def kill_search(self):
        pass

    def angle(self, motor):
        start, end, began = self.ways[motor]
        way = min(abs(end - start), (self.clock.monotonic() - began) * SPEED_DEG_S)
        return round(start + (way if end > start else -way), 2)

    def get_position(self):
        if self.gone:
            raise OSError("Input/output error")
        self.clock.advance(EXCHANGE_S)
        return Position(self.angle(0), self.angle(1))

    def move_motor(self, motor_id, degrees):
        self.moves.append((motor_id, degrees))
        self.clock.advance(EXCHANGE_S)
        self.ways[motor_id] = self.angle(motor_id), degrees, self.clock.monotonic()


class Rig:
    def __init__(self):
        self.clock = OwnPort.clock = VirtualClock()
        self.station = Station(self.clock, StationSettings(port="own:1", firmware="own", open_link=self.never))
        self.session = Session(self.clock, self.station)
        self.session.step(3)

    def never(self, port, baud):
        raise AssertionError("the class opens its own port")

    @property
    def state(self):
        return self.station.state

    def where(self):
        return self.state.position.az_deg, self.state.position.el_deg


@pytest.fixture
def made(monkeypatch):
    """The machines that were made."""
    made = []

    class Made(OwnPort):
        def __init__(self):
            super().__init__()
            made.append(self)

    monkeypatch.setattr(machines, "class_of", {"own": Made}.__getitem__)
    return made


def test_a_go_to_arrives(made):
    rig = Rig()
    assert rig.state.link.state is LinkPhase.UP
    future = rig.station.submit(Goto(230.0, 50.0, "you"))
    rig.session.step(10)
    assert future.done()
    assert rig.where() == (230.0, 50.0)
    assert made[0].moves == [(0, 230.0), (1, 50.0)]


def test_stop_is_confirmed_by_sight(made):
    rig = Rig()
    future = rig.station.submit(Goto(100.0, 50.0, "you"))
    rig.session.step(2)
    rig.station.stop("you")
    rig.session.step(10)
    assert isinstance(future.exception(), Stopped)
    assert rig.state.last_stop.confirmed
    assert rig.where()[0] == made[0].angle(0) > 130.0
    motors = [motor for motor, _ in made[0].moves]
    assert motors[:2] == [0, 1]
    assert sorted(motors[2:4]) == [0, 1]


def test_a_port_that_fails_is_told_and_found_again(made):
    rig = Rig()
    made[0].gone = True
    future = rig.station.submit(Goto(230.0, 50.0, "you"))
    rig.session.step(5)
    assert isinstance(future.exception(), LinkError)
    assert made[0].moves == []
    assert rig.state.link.state is not LinkPhase.UP
    assert "Input/output error" in rig.state.link.detail
    made[0].gone = False
    rig.session.step(30)
    assert rig.state.link.state is LinkPhase.UP
