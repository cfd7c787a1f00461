"""The classes of `docs/reference/published-interface.md`, driven as a script would, against the simulated dish."""

from __future__ import annotations

import threading

import pytest
from birdcage.antenna import AntennaConfig, BirdcageAntenna
from birdcage.antenna.alignment import Alignment
from birdcage.base.clock import VirtualClock
from birdcage.base.errors import BelowFloor, CommandRefused, MotionRefused, PositionUnknown, WrongThread
from birdcage.base.no_go import NoGoSector
from birdcage.link.link import Link
from birdcage.protocol import (
    FIRMWARE_REGISTRY,
    MOTOR_AZIMUTH,
    MOTOR_ELEVATION,
    CarryoutG2Protocol,
    FirmwareProtocol,
    Position,
    RssiReading,
    get_protocol,
)
from birdcage.rotator.ladder import StopBy, StopOrder
from birdcage.sim.port import SimPort, open_device


class Rig:
    def __init__(self, address="g2?seed=1", **config):
        self.clock = VirtualClock()
        self.device = open_device(address, clock=self.clock)
        self.antenna = BirdcageAntenna(get_protocol("g2"), AntennaConfig(**config))
        self.antenna.attach(Link(SimPort(self.device, "sim:g2"), self.clock), self.clock)
        self.protocol = self.antenna.protocol

    def wait(self, seconds):
        self.clock.advance(seconds)

    def lines(self):
        with self.device.lock:
            self.device.machine.run()
            return [line for _at, line in self.device.shell.received]


@pytest.fixture
def rig():
    rig = Rig()
    rig.antenna.initialize()
    return rig


def test_names_and_defaults():
    config = AntennaConfig()
    assert (config.port, config.baudrate, config.min_elevation, config.leapfrog_enabled) == (
        "/dev/ttyUSB0", 57600, 15.0, True,
    )  # fmt: skip
    assert (MOTOR_AZIMUTH, MOTOR_ELEVATION) == (0, 1)
    assert FIRMWARE_REGISTRY["g2"] is CarryoutG2Protocol
    assert issubclass(CarryoutG2Protocol, FirmwareProtocol)
    assert Position(1.0, 2.0).skew is None
    with pytest.raises(KeyError, match="known: carryout, g2"):
        get_protocol("g9")


def test_position(rig):
    position = rig.antenna.get_position()
    assert isinstance(position, Position)
    assert position.elevation == pytest.approx(45, abs=0.1)


def test_move_to_leapfrogs_as_documented_from_a_position_that_was_read():
    rig = Rig(leapfrog_enabled=True)
    rig.antenna.initialize()
    rig.antenna.move_to(90.0, 45.0)
    rig.wait(8)
    rig.antenna.move_to(180.0, 45.0)
    assert "a 0 181.00" in rig.lines()
    assert "a 1 45.00" in rig.lines()
    rig.wait(5)
    rig.antenna.move_to(181.5, 45.0)
    assert "a 0 181.50" in rig.lines()


def test_leapfrog_never_leaves_the_limits():
    rig = Rig(leapfrog_enabled=True)
    rig.antenna.initialize()
    rig.antenna.move_to(180.0, 64.8)
    assert "a 1 65.00" in rig.lines()


def test_axis_order_alternates(rig):
    rig.antenna.move_to(100.0, 40.0)
    rig.wait(5)
    rig.antenna.move_to(120.0, 50.0)
    rig.wait(5)
    axes = [line.split()[1] for line in rig.lines() if line.startswith("a ")]
    assert axes == ["0", "1", "1", "0"]


def test_floor_the_higher_one_counts(rig):
    with pytest.raises(BelowFloor):
        rig.antenna.move_to(180.0, 17.0)
    high = Rig(min_elevation=40.0)
    high.antenna.initialize()
    with pytest.raises(ValueError, match="floor"):
        high.antenna.move_to(180.0, 39.0)


def test_the_floor_is_true_as_all_that_a_script_asks_for():
    leaning = Rig(min_elevation=40.0, leapfrog_enabled=False)
    leaning.antenna.align(Alignment(el_offset_deg=2.0))
    leaning.antenna.initialize()
    with pytest.raises(BelowFloor, match=r"below the floor of 40\.00°"):
        leaning.antenna.move_to(180.0, 39.5)
    leaning.antenna.move_to(180.0, 40.5)
    assert "a 1 38.50" in leaning.lines()


def test_a_single_motor_passes_the_same_gate(rig):
    for motor, angle in ((0, float("nan")), (0, 361.0), (1, 70.0), (1, 5.0)):
        before = rig.lines()
        with pytest.raises(MotionRefused):
            rig.protocol.move_motor(motor, angle)
        assert [line for line in rig.lines()[len(before) :] if line.startswith("a ")] == []
    with pytest.raises(KeyError):
        rig.protocol.move_motor(2, 10.0)
    rig.protocol.move_motor(MOTOR_AZIMUTH, 90.0)
    rig.wait(5)
    assert rig.antenna.get_position().azimuth == pytest.approx(90, abs=0.1)


def test_an_unhomed_dish():
    rig = Rig("g2?seed=1&unhomed=1")
    with pytest.raises(PositionUnknown) as unknown:
        rig.antenna.get_position()
    assert unknown.value.reason == "unhomed"
    with pytest.raises(PositionUnknown):
        rig.antenna.move_to(100.0, 45.0)
    rig.protocol.home_motor(0)
    rig.protocol.home_motor(1)
    assert rig.antenna.get_position() is not None


def test_a_command_whose_answer_is_unknown_is_never_reported_as_done():
    rig = Rig("g2?seed=1&second_move=refuse")
    rig.antenna.initialize()
    rig.antenna.point(200.0, 45.0)
    rig.wait(0.3)
    taken = rig.protocol.move_motor(0, 100.0)
    assert not taken.sure
    assert "busy" in taken.said


def test_stop_brings_it_to_rest_and_resets_the_order(rig):
    rig.antenna.point(170.0, 45.0)
    rig.wait(1.0)
    rig.antenna.stop()
    rig.wait(2.0)
    truth = rig.device.truth()
    assert not truth.moving
    assert abs((truth.az_deg - 170.0 + 180) % 360 - 180) > 10
    rig.antenna.point(160.0, 40.0)
    assert [line for line in rig.lines() if line.startswith("a ")][-2].startswith("a 0")


def test_signal_and_lna(rig):
    rig.protocol.enter_dvb_menu()
    rig.protocol.enable_lna()
    reading = rig.protocol.get_rssi(10)
    assert isinstance(reading, RssiReading)
    assert reading.reads == 10
    assert 390 < reading.average < 600
    rig.wait(10)
    rig.protocol.quit_submenu()
    assert rig.protocol.console.place == "root"


def test_tv_search_is_switched_off_by_nvs_20_and_back():
    rig = Rig("g2?seed=1&nvs20=0")
    lines = []
    rig.protocol.initialize(lines.append)
    assert "NVS 20 is FALSE" in lines[-1]
    rig.wait(10)
    rig.protocol.kill_search()
    assert rig.protocol.read_nvs(20).saved == "TRUE"
    rig.protocol.restore_search()
    assert rig.protocol.read_nvs(20).saved == "FALSE"


def test_disconnect_leaves_the_dish_at_its_root_and_closes(rig):
    rig.wait(10)
    rig.antenna.get_position()
    rig.antenna.disconnect()
    assert not rig.antenna.is_connected
    assert rig.device.truth().shell_alive
    assert rig.device.truth().menu == "root"


def test_an_adopted_antenna_belongs_to_one_thread(rig):
    rig.antenna.adopt(threading.Thread())
    with pytest.raises(WrongThread):
        rig.antenna.get_position()


def test_initialize_waits_for_a_boot_and_tells():
    rig = Rig("g2?seed=1&boot=1")
    lines = []
    rig.protocol.initialize(lines.append)
    assert any("no prompt yet" in line for line in lines)
    assert rig.protocol.console.place == "mot"


def test_a_stop_that_the_dish_refuses_is_not_reported_as_done():
    rig = Rig("g2?seed=1&second_move=refuse")
    rig.antenna.initialize()
    rig.antenna.point(300.0, 45.0)
    rig.wait(0.3)
    with pytest.raises(CommandRefused):
        rig.antenna.stop()


def test_stop_sends_no_axis_beyond_its_limit():
    """An axis may rest, or be seen on its way, a little beyond where it may be sent."""
    rig = Rig("g2?seed=1&az=-180", leapfrog_enabled=False)
    rig.antenna.initialize()
    rig.antenna.get_position()
    rig.antenna.gate.see(Position(180.0, 65.05))
    rig.antenna.steer(MOTOR_AZIMUTH, 250.0)
    assert rig.antenna.stop_aim.order().aim_deg["elevation"] == 65.0
    now = rig.clock.monotonic()
    for seen, limit in ((64.9, 65.0), (18.1, 18.0)):
        before = Position(180.0, seen - 3.0 if limit == 65.0 else seen + 3.0)
        order = rig.antenna.stop_aim.order_seen(before, now - 0.1, Position(180.0, seen), now)
        assert order == StopOrder(StopBy.RETARGET, {"azimuth": 180.0, "elevation": limit})
    before, later = Position(100.0, 45.0), Position(104.0, 45.0)
    # 40 deg/s: 4 deg until STOP is taken, and 2 to brake from there.
    assert rig.antenna.stop_aim.order_seen(before, now - 0.1, later, now).aim_deg["azimuth"] == pytest.approx(110.0)


def test_where_only_the_overshoot_leads_into_a_sector_the_target_itself_is_sent():
    rig = Rig("g2?seed=1&az=-260", leapfrog_enabled=True)
    rig.antenna.initialize()
    rig.antenna.gate.update(sectors=(NoGoSector(150.5, 170.0, 60.0),))
    rig.antenna.move_to(150.0, 45.0)
    assert [line for line in rig.lines() if line.startswith("a 0 ")] == ["a 0 150.00"]
