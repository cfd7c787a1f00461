"""A subclass with the three published methods (`docs/reference/published-interface.md`) and no more, over the
console that it inherits."""

from __future__ import annotations

import pytest
from birdcage.antenna import AntennaConfig, BirdcageAntenna
from birdcage.base.clock import VirtualClock
from birdcage.base.errors import CommandRefused, PositionUnknown
from birdcage.link.link import Link
from birdcage.protocol import CarryoutG2Protocol, FirmwareProtocol, HAL205Protocol, Position
from birdcage.protocol.documented import DocumentedRotator
from birdcage.protocol.generic import position_in
from birdcage.protocol.menu_rotator import MenuRotator
from birdcage.rotator.adapting import as_rotator
from birdcage.rotator.readings import UnreadablePosition
from birdcage.sim.port import SimPort, open_device


class Three(FirmwareProtocol):
    MENU = "mot"

    def initialize(self, callback=None):
        self.console.synchronize()

    def enter_motor_menu(self):
        self.console.enter(self.MENU)

    def kill_search(self):
        pass


class ThreeInMotor(Three):
    MENU = "motor"


class Rig:
    def __init__(self, kind, address):
        self.clock = VirtualClock()
        self.device = open_device(address, clock=self.clock)
        self.antenna = BirdcageAntenna(kind(), AntennaConfig(leapfrog_enabled=False))
        self.antenna.attach(Link(SimPort(self.device, "sim:any"), self.clock), self.clock)

    def moves(self):
        with self.device.lock:
            self.device.machine.run()
            return [line for _at, line in self.device.shell.received if line.startswith(("a 0", "a 1", "g "))]


BOTH = pytest.mark.parametrize(("kind", "address"), [(Three, "g2?seed=1&az=-180"), (ThreeInMotor, "hal205?seed=1")])


@BOTH
def test_three_methods_drive_a_dish_of_the_family(kind, address):
    rig = Rig(kind, address)
    rig.antenna.initialize()
    start = rig.antenna.get_position()
    rig.antenna.move_to(start.azimuth + 10.0, 40.0)
    assert sorted(line.split()[1] for line in rig.moves()) == ["0", "1"]
    rig.clock.advance(60)
    there = rig.antenna.get_position()
    assert (there.azimuth, there.elevation) == pytest.approx((start.azimuth + 10.0, 40.0), abs=0.1)
    rig.antenna.disconnect()
    assert rig.device.truth().shell_alive
    assert not rig.antenna.is_connected


def test_its_stop_is_a_new_target_just_ahead():
    rig = Rig(Three, "g2?seed=1&az=-180")
    rig.antenna.initialize()
    rig.antenna.move_to(300.0, 45.0)
    rig.clock.advance(0.5)
    rig.antenna.stop()
    rig.clock.advance(3.0)
    truth = rig.device.truth()
    assert not truth.moving
    assert abs(rig.antenna.get_position().azimuth - 300.0) > 20.0


def test_an_unhomed_dish_has_no_position():
    rig = Rig(Three, "g2?seed=1&unhomed=1")
    rig.antenna.initialize()
    with pytest.raises(PositionUnknown):
        rig.antenna.move_to(100.0, 45.0)
    assert rig.moves() == []


def test_what_it_lacks_is_refused_in_words():
    for deed in (lambda dish: dish.home_motor(0), lambda dish: dish.stow(), lambda dish: dish.get_rssi()):
        with pytest.raises(CommandRefused, match="The dish has no command for") as refused:
            deed(Three())
        assert refused.value.reason == "unsupported"


def test_exactly_three_methods_are_abstract():
    assert FirmwareProtocol.__abstractmethods__ == {"initialize", "enter_motor_menu", "kill_search"}


class SaysWhere(CarryoutG2Protocol):
    def get_position(self):
        return Position(1.0, 20.0)


class HomesOtherwise(CarryoutG2Protocol):
    def home_motor(self, motor_id):
        pass


@pytest.mark.parametrize(
    ("kind", "rotator"),
    [
        (CarryoutG2Protocol, MenuRotator),
        (HAL205Protocol, MenuRotator),
        (Three, MenuRotator),
        (HomesOtherwise, MenuRotator),
        (SaysWhere, DocumentedRotator),
    ],
)
def test_what_a_class_replaces_decides_how_it_is_asked(kind, rotator):
    assert type(as_rotator(kind())) is rotator


def test_a_method_that_is_replaced_is_the_one_that_counts():
    rig = Rig(SaysWhere, "g2?seed=1&az=-180")
    rig.antenna.initialize()
    assert rig.antenna.get_position() == Position(1.0, 20.0)
    rig.antenna.move_to(2.0, 21.0)
    assert rig.moves() == ["a 0 2.00", "a 1 21.00"]


@pytest.mark.parametrize(
    ("printed", "position"),
    [
        (["AZ = 180.00 EL = 45.00 SK = 90.00"], Position(180.0, 45.0, 90.0)),
        (["AZ =  180.00", "EL =   45.00", "SK =   90.00  0"], Position(180.0, 45.0, 90.0)),
        (["Angle[0] = 180.00", "Angle[1] = 45.00"], Position(180.0, 45.0)),
        (["Angle[0] = -0.50", "Angle[1] = 18"], Position(-0.5, 18.0)),
    ],
)
def test_both_forms_of_the_family_are_read(printed, position):
    assert position_in(printed) == position


@pytest.mark.parametrize(
    "printed", [[], ["AZ = 180.00"], ["Angle[0] = 18 0.00", "Angle[1] = 45.00"], ["AZ = 9999.00 EL = 45.00"], ["busy"]]
)
def test_what_is_no_position_is_not_taken_for_one(printed):
    with pytest.raises(UnreadablePosition):
        position_in(printed)


def test_a_class_that_only_connects_in_its_own_way_speaks_over_the_console_that_it_opens():
    clock = VirtualClock()
    device = open_device("g2?seed=1&az=-180", clock=clock)

    class OpensOtherwise(Three):
        def connect(self, port, baudrate=57600):
            self.attach(Link(SimPort(device, port), clock), clock)

    antenna = BirdcageAntenna(OpensOtherwise(), AntennaConfig(leapfrog_enabled=False))
    antenna.initialize()
    antenna.move_to(190.0, 40.0)
    clock.advance(20)
    assert antenna.get_position().azimuth == pytest.approx(190.0, abs=0.1)
    antenna.disconnect()
    assert not antenna.is_connected
    assert device.truth().menu == "root"
