"""A subclass of `FirmwareProtocol` by a stranger who has only `docs/reference/published-interface.md`."""

from __future__ import annotations

from unittest.mock import Mock, call, create_autospec

import pytest
from birdcage.antenna import AntennaConfig, BirdcageAntenna
from birdcage.base.errors import BelowFloor, CommandRefused, Held, LinkError, MotionRefused
from birdcage.base.held import HeldFile, HeldNote
from birdcage.base.paths import Paths
from birdcage.link.identity import dish_folder, dish_identity
from birdcage.protocol import CarryoutG2Protocol, FirmwareProtocol, Position


class OwnPort(FirmwareProtocol):
    """Has a port of its own: nothing of ours is called. It does not call our `__init__` either."""

    def __init__(self):
        self.said = []
        self.open = False
        self.at = Position(180.0, 45.0)

    def connect(self, port, baudrate=9600):
        self.said.append(("connect", port, baudrate))
        self.open = True

    def disconnect(self):
        self.said.append(("disconnect",))
        self.open = False

    @property
    def is_connected(self):
        return self.open

    def reset_to_root(self):
        self.said.append(("root",))

    def initialize(self, callback=None):
        self.said.append(("initialize",))
        if callback:
            callback("ready")

    def enter_motor_menu(self):
        self.said.append(("menu",))

    def kill_search(self):
        self.said.append(("kill",))

    def get_position(self):
        return self.at

    def move_motor(self, motor_id, degrees):
        self.said.append(("move", motor_id, degrees))


def antenna(protocol=None, **config):
    return BirdcageAntenna(protocol or OwnPort(), AntennaConfig(**config))


def moves(of):
    return [said[1:] for said in of.protocol.said if said[0] == "move"]


def test_every_method_is_the_subclass_s_own():
    rig = antenna(port="/dev/ttyS7", leapfrog_enabled=False)
    assert not rig.is_connected
    rig.initialize()
    assert rig.is_connected
    assert rig.protocol.said == [("connect", "/dev/ttyS7", 9600), ("initialize",), ("menu",)]
    assert rig.get_position() == Position(180.0, 45.0)
    rig.move_to(190.0, 50.0)
    assert moves(rig) == [(0, 190.0), (1, 50.0)]
    rig.disconnect()
    assert rig.protocol.said[-1] == ("disconnect",)
    assert not rig.is_connected


def test_the_baud_rate_that_was_given_is_passed_on():
    rig = antenna(port="/dev/ttyS7", baudrate=57600)
    rig.connect()
    assert rig.protocol.said == [("connect", "/dev/ttyS7", 57600)]


def test_leapfrog_and_the_alternating_order_are_as_documented():
    rig = antenna()
    rig.connect()
    rig.move_to(190.0, 46.5)
    rig.protocol.at = Position(191.0, 47.0)
    rig.move_to(200.0, 44.0)
    assert moves(rig) == [(0, 191.0), (1, 47.0), (1, 43.0), (0, 201.0)]


@pytest.mark.parametrize(("az", "el"), [(400.0, 45.0), (-1.0, 45.0), (180.0, 90.5), (float("nan"), 45.0)])
def test_what_lies_outside_the_documented_ranges_is_refused(az, el):
    rig = antenna()
    rig.connect()
    with pytest.raises(MotionRefused):
        rig.move_to(az, el)
    with pytest.raises(BelowFloor):
        rig.move_to(180.0, 14.9)
    assert moves(rig) == []


def test_stop_aims_just_ahead_of_a_dish_that_moves_and_resets_the_order():
    rig = antenna(leapfrog_enabled=False)
    rig.connect()
    rig.stop()
    assert moves(rig) == []
    rig.move_to(300.0, 45.0)
    rig.protocol.said.clear()
    rig.protocol.at = Position(180.01, 45.0)
    rig.stop()
    [(_, az), elevation] = moves(rig)
    assert 180.0 <= az < 190.0
    assert elevation == (1, 45.0)
    rig.protocol.said.clear()
    rig.protocol.at = Position(az, 45.0)
    rig.move_to(100.0, 50.0)
    assert [motor for motor, _ in moves(rig)] == [0, 1]


def test_a_stop_that_the_class_refuses_is_not_reported_as_done():
    rig = antenna(leapfrog_enabled=False)
    rig.connect()
    rig.move_to(300.0, 45.0)

    def refuse(_motor, _degrees):
        raise CommandRefused("busy", reason="failed")

    rig.protocol.move_motor = refuse
    with pytest.raises(CommandRefused, match="busy"):
        rig.stop()


def test_nothing_is_known_of_it_but_what_the_document_says():
    facts = antenna().rotator.facts
    assert facts.cable is None
    assert (facts.azimuth.min_deg, facts.azimuth.max_deg) == (0.0, 360.0)
    assert (facts.elevation.min_deg, facts.elevation.max_deg) == (15.0, 90.0)
    assert {rung.means for rung in facts.stop_ladder if rung.proven} == {"end of move", "power"}


def test_its_port_that_fails_is_a_link_error_and_closing_that_one_is_none():
    rig = antenna(leapfrog_enabled=False)
    rig.connect()

    def gone(*_):
        raise OSError("Input/output error")

    rig.protocol.get_position = rig.protocol.disconnect = gone
    with pytest.raises(LinkError, match="Input/output error"):
        rig.move_to(190.0, 45.0)
    rig.disconnect()


def test_a_position_that_is_no_angle_is_never_taken_for_one():
    rig = antenna()
    rig.connect()
    rig.protocol.at = Position(float("nan"), 45.0)
    with pytest.raises(MotionRefused):
        rig.move_to(190.0, 45.0)
    assert moves(rig) == []


def test_a_dish_that_is_held_is_not_moved(tmp_path):
    port = tmp_path / "dish"
    port.touch()
    rig = antenna(port=str(port))
    rig.connect()
    HeldFile(dish_folder(Paths.default().state, dish_identity(str(port)))).write(HeldNote("anna", None))
    with pytest.raises(Held):
        rig.move_to(190.0, 46.0)
    assert moves(rig) == []


def test_a_class_with_a_connect_of_its_own_counts_as_connected_once_that_was_called():
    class Forgets(FirmwareProtocol):
        connects = 0

        def connect(self, port, baudrate=57600):
            self.connects += 1

        def initialize(self, callback=None):
            pass

        enter_motor_menu = kill_search = lambda self: None

        def get_position(self):
            return Position(180.0, 45.0)

        def move_motor(self, motor_id, degrees):
            pass

    rig = antenna(Forgets())
    assert not rig.is_connected
    rig.initialize()
    rig.initialize()
    rig.move_to(181.0, 46.0)
    assert rig.is_connected
    assert rig.protocol.connects == 1
    rig.disconnect()
    assert not rig.is_connected


@pytest.mark.parametrize("instance", [False, True])
@pytest.mark.parametrize("kind", [CarryoutG2Protocol, FirmwareProtocol])
def test_a_mock_of_a_protocol_is_driven(kind, instance):
    protocol = create_autospec(kind, instance=instance)
    protocol.get_position.return_value = Position(180.0, 45.0)
    rig = BirdcageAntenna(protocol, AntennaConfig())
    rig.move_to(181, 46)
    assert protocol.move_motor.mock_calls == [call(0, 181), call(1, 46)]
    assert rig.get_position() == Position(180.0, 45.0)
    assert rig.protocol is protocol
    assert rig.is_connected


@pytest.mark.parametrize("instance", [False, True])
def test_a_mock_leapfrogs_connects_and_is_let_go_as_documented(instance):
    protocol = create_autospec(CarryoutG2Protocol, instance=instance)
    protocol.get_position.return_value = Position(180.0, 45.0)
    protocol.is_connected = False
    rig = BirdcageAntenna(protocol, AntennaConfig(port="/dev/ttyS7", baudrate=115200))
    rig.initialize()
    protocol.connect.assert_called_once_with("/dev/ttyS7", baudrate=115200)
    protocol.initialize.assert_called_once()
    protocol.enter_motor_menu.assert_called_once_with()
    rig.move_to(190.0, 46.5)
    assert protocol.move_motor.mock_calls == [call(0, 191.0), call(1, 47.0)]
    rig.disconnect()
    protocol.disconnect.assert_called_once_with()


def test_methods_that_only_the_object_has_are_asked_as_well():
    class Plain(FirmwareProtocol):
        def initialize(self, callback=None):
            pass

        enter_motor_menu = kill_search = lambda self: None

    protocol = Plain()
    protocol.get_position = lambda: Position(180.0, 45.0)
    protocol.move_motor = Mock()
    antenna(protocol).move_to(181, 46)
    assert protocol.move_motor.mock_calls == [call(0, 181), call(1, 46)]
