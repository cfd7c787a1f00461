"""Every method of every menu against the simulated dish, as it comes out of the box."""

from __future__ import annotations

import pytest
from birdcage.base.errors import CommandRefused, NoReply
from birdcage.protocol.g2.scan import parse_scan_point

AXES = ("azimuth", "elevation")


def axes(name, azimuth, elevation):
    """Return what is told of both axes, as features."""
    return dict(zip((f"{name}.{axis}" for axis in AXES), (azimuth, elevation), strict=True))


@pytest.fixture(
    params=["", "&line_end=lf", "&line_end=cr&stream_key=keep", "&stream_s=0.9&latency_min=0.3&latency_max=0.4"]
)
def g2(simulated, request):
    """A G2 in front of a dish out of the box, and of dishes that differ in what no source tells."""
    return simulated(f"seed=1&az=-180&el=45&overshoot=0{request.param}")


def test_drivers(g2):
    assert g2.drivers.faults() == axes("driver", "OK", "OK")
    assert g2.drivers.current_mode() == axes("current_mode", "AUTO", "AUTO")
    assert g2.drivers.step_mode() == axes("step_mode", "AUTO", "AUTO")
    assert g2.drivers.step_size() == axes("step_size", 1, 1)
    assert g2.drivers.torque() == axes("torque", "LOW", "LOW")
    g2.drivers.clear_faults()


def test_torque_is_high_while_it_moves(simulated, clock):
    g2 = simulated("seed=1&az=-180&el=45&az_speed=5")
    g2.move_motor(0, 350.0)
    assert g2.drivers.torque() == axes("torque", "HIGH", "LOW")
    clock.advance(60.0)
    assert g2.drivers.torque() == axes("torque", "LOW", "LOW")


def test_board_and_raw_levels(g2):
    assert (g2.adc.board_id(), g2.adc.board_revision()) == ("STATIONARY", "A")
    assert 200 < g2.adc.rssi_counts() < 300
    counts = g2.adc.monitor(5)
    assert len(counts) == 5
    assert all(200 < count < 300 for count in counts)


def test_switches_and_pins(g2):
    assert g2.dipswitch.read() == {
        "dip_switches": "0xffffff01",
        "dip_code": 101,
        "dip_meaning": "all switches up (off); code 101: DISH at 110, 119 and 129° west",
    }
    pins = g2.gpio.registers()
    assert pins["E29"] is None
    assert pins["D11"] == 1
    assert set(pins.values()) == {0, 1, None}
    assert len(pins) in (92, 93)  # 92 pins; whether E29 is one of them is not told
    assert g2.gpio.read("D11") == 1
    assert (g2.gpio.direction("E24"), g2.gpio.direction("E25")) == ("OUTPUT", "INPUT")
    assert g2.gpio.read("E29") is None


def test_memory(g2):
    values = [g2.eeprom.read(index) for index in (0, 250)]
    assert values[1] is None
    assert values[0] in (0, None)


def test_place_from_two_satellites(g2):
    lat_deg, lon_deg = g2.latlon.triangulate(199.2, 42.9, 213.8, 37.5)
    assert -90.0 < lat_deg < 90.0
    assert -180.0 < lon_deg < 180.0


def test_peak(g2):
    even, odd = g2.peak.rssi()
    assert even > odd > 100
    assert g2.peak.switch_status() == 0


def test_motors_at_rest(g2):
    assert g2.motors.states() == axes("motor", "HOLDING", "HOLDING")
    assert g2.motors.steps()["steps.elevation"] == pytest.approx(45.0 / 360.0 * 24960, abs=2)
    assert g2.motors.velocities() == axes("velocity", 0.0, 0.0)
    assert g2.motors.max_velocities() == axes("speed", 65.0, 45.0)
    assert g2.motors.max_accelerations()["acceleration.azimuth"] == pytest.approx(400.0, abs=10.0)
    assert g2.motors.elevation_limits() == {"floor": 18.0, "ceiling": 65.0, "home.elevation": 65.0}
    assert g2.motors.elevation_to_steps(45.0) == 3120
    assert g2.motors.steps_to_elevation(3120) == pytest.approx(45.0)
    assert g2.motors.steps_to_elevation(2**30) is None
    assert set(g2.motors.gains()) == {f"{name}.{axis}" for name in ("kp", "kv", "ki") for axis in AXES}
    assert g2.motors.life()
    assert g2.motors.life_details()


def test_motors_that_move(g2, clock):
    g2.move_motor(0, 350.0)
    clock.advance(0.5)
    assert abs(g2.motors.velocities()["velocity.azimuth"]) > 10.0


def test_an_unhomed_axis_has_no_steps(simulated):
    assert simulated("seed=1&unhomed=1").motors.steps() == {}


def test_homing_both(g2):
    g2.enter_motor_menu()
    g2.home_motor(1)
    g2.home_motor(0)
    assert g2.get_position().elevation == pytest.approx(65.0, abs=0.1)


def test_stepper(g2):
    assert g2.stepper.max_speeds_deg_s()[0] == pytest.approx(65.0, abs=0.01)
    assert g2.stepper.max_accelerations()["acceleration.azimuth"] == pytest.approx(396.0)
    assert g2.stepper.gains() == axes("step_kp", 250.0, 250.0) | axes("step_kv", 50.0, 50.0)


def test_settings(g2):
    table = g2.nvs.table()
    assert table[20].value is True
    assert table[0].value == 7
    assert table[38].value == 420
    assert table[81].value == 400.0
    assert table[26].value == 0
    assert g2.nvs.read(101).saved_value == 18.0
    with pytest.raises((NoReply, CommandRefused)):
        g2.nvs.read(5)
    assert g2.nvs.write_and_save(38, "500").saved_value == 500
    assert g2.nvs.read(38).default_value == 420


def test_identity(g2):
    assert g2.system.identity() == {
        "version": "02.02.48", "system_id": "TWELINCH", "antenna_id": "12-IN G2",
        "mcu_package": "144-pin", "mcu_revision": "2.4", "mcu_mask_set": "4N22D",
        "mcu_flash": 512, "mcu_ram": 128, "mcu_core_clock": 96, "mcu_bus_clock": 48,
        "flash_base": 65536, "flash_size": 458752,
    }  # fmt: skip


def test_a_tuner_that_hears_nothing(g2):
    assert g2.tuner.network() == "none"
    assert g2.tuner.snr_db() < 3.0
    assert g2.tuner.lnb_volts() == pytest.approx(18.0, abs=0.5)
    g2.tuner.supply_13_volts()
    assert g2.tuner.lnb_volts() == pytest.approx(13.0, abs=0.5)
    assert 350 < g2.tuner.rssi(10).average < 600
    (reading,) = g2.tuner.agc()
    assert reading["network"] == "none"
    assert reading.keys() == {"rf_agc", "if_agc", "snr", "network"}


def test_the_tuner_itself(g2):
    found = g2.tuner.identity()
    assert (found["tuner_chip"], found["tuner_revision"], found["tuner_firmware"]) == ("0x4515", "B0", "113.37")
    channel = g2.tuner.channel()
    assert 900.0 < channel["frequency"] < 2200.0
    assert channel["symbol_rate"] == 20000.0
    assert channel["polarisation"] in ("H", "V")
    locked = g2.tuner.lock_status()
    assert locked["lock"] is False
    assert locked["tuner_reads"] >= locked["tuner_no_signal"] >= 0
    assert locked["tuner_glitches"] >= 0
    assert g2.tuner.quick_lock_status() == {"lock": False}
    assert g2.tuner.statistics()
    assert g2.tuner.diagnostics()
    assert g2.tuner.frequencies()
    before = channel["frequency"]
    g2.tuner.select(5)
    assert g2.tuner.channel()["frequency"] != before
    assert g2.tuner.build_table()
    assert g2.tuner.build_table(extended=True)


def test_diseqc(g2):
    bus = g2.tuner.diseqc
    assert (bus.address(), bus.pre_transmit_ms(), bus.reply_timeout_ms()) == ("0x11", 15, 210)
    assert bus.tone_threshold_counts() == 110
    assert bus.lnb_status() is None
    assert bus.lnb_identity() is None
    assert bus.switch_status() is None
    assert bus.lnb_config() in (None, ("3 21180544 238 <4.5",))
    assert bus.send(bytes.fromhex("E01038F0")) == ("Tx: E0 10 38 F0",)
    assert bus.send(bytes.fromhex("E21038")) is None


def test_lines_of_a_sweep(g2):
    g2.console.enter("adc")
    points = [parse_scan_point(line) for line in g2.console.run("adc", "scan", takes_s=120.0).lines]
    assert points
    assert all(point is not None and point.motor == 0 for point in points)
    assert points[-1].angle_deg != points[0].angle_deg


def test_a_tuner_on_a_satellite(simulated):
    g2 = simulated("seed=1&az=-158&el=42")  # DISH at 110 W
    assert g2.tuner.network() == "none"  # its transponder is vertical, the LNB horizontal
    g2.tuner.supply_13_volts()
    assert g2.tuner.network() == "0x1002"
    assert 3.0 < g2.tuner.snr_db() < 20.0
    assert g2.tuner.quick_lock_status() == {"lock": True}
    readings = g2.tuner.agc(3)
    assert len(readings) == 3
    assert all(reading["network"] == "0x1002" and reading["snr"] > 3.0 for reading in readings)
