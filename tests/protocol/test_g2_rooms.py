"""Each menu's methods, on the documented literals and on other forms that a dish may print them in."""

from __future__ import annotations

import pytest
from birdcage.base.errors import CommandRefused, LinkError, NoReply
from birdcage.protocol.g2 import CarryoutG2Protocol
from birdcage.protocol.g2.scan import ScanPoint, parse_scan_point


def axes(name, azimuth, elevation):
    """Return what is told of both axes, as features."""
    return {f"{name}.azimuth": azimuth, f"{name}.elevation": elevation}


VALUES = [
    ("a3981", "diag", "AZ DIAG: OK EL DIAG: OK", lambda g: g.drivers.faults(), axes("driver", "OK", "OK")),
    ("a3981", "diag", "AZ DIAG: OK\nEL DIAG: FAULT", lambda g: g.drivers.faults(), axes("driver", "OK", "FAULT")),
    ("a3981", "cm", "AZ: AUTO EL: HiZ", lambda g: g.drivers.current_mode(), axes("current_mode", "AUTO", "HiZ")),
    ("a3981", "cm", "AZ/EL AUTO", lambda g: g.drivers.current_mode(), axes("current_mode", "AUTO", "AUTO")),
    ("a3981", "cm", "AZ CM: LoZ\nEL CM: auto", lambda g: g.drivers.current_mode(), axes("current_mode", "LoZ", "AUTO")),
    ("a3981", "sm", "AZ SM: AUTO EL SM: FULL", lambda g: g.drivers.step_mode(), axes("step_mode", "AUTO", "FULL")),
    ("a3981", "ss", "1", lambda g: g.drivers.step_size(), axes("step_size", 1, 1)),
    ("a3981", "ss", "AZ: 16\nEL: 1", lambda g: g.drivers.step_size(), axes("step_size", 16, 1)),
    ("a3981", "st", "AZ: HIGH EL: LOW", lambda g: g.drivers.torque(), axes("torque", "HIGH", "LOW")),
    ("a3981", "reset", "", lambda g: g.drivers.clear_faults(), None),
    ("adc", "bdid", "STATIONARY", lambda g: g.adc.board_id(), "STATIONARY"),
    ("adc", "bdid", "Board ID: STATIONARY", lambda g: g.adc.board_id(), "STATIONARY"),
    ("adc", "bdrevid", "A", lambda g: g.adc.board_revision(), "A"),
    ("adc", "rssi", "235", lambda g: g.adc.rssi_counts(), 235),
    ("adc", "rssi", "RSSI: 235 (12 bits)", lambda g: g.adc.rssi_counts(), 235),
    (
        "dipswitch", "dipswitch", "val:ffffff01\napp_dipswitch:101",
        lambda g: g.dipswitch.read(), {
            "dip_switches": "0xffffff01", "dip_code": 101,
            "dip_meaning": "all switches up (off); code 101: DISH at 110, 119 and 129° west",
        },
    ),
    ("eeprom", "ee 3", "Index:3 Read value = 0", lambda g: g.eeprom.read(3), 0),
    ("eeprom", "ee 3", "Failed to read eeprom index:3 val:65793", lambda g: g.eeprom.read(3), None),
    ("gpio", "dir B0", "INPUT", lambda g: g.gpio.direction("B0"), "INPUT"),
    ("gpio", "dir E29", "Unknown bit E29", lambda g: g.gpio.direction("E29"), None),
    ("gpio", "r E29", "Unknown bit E29", lambda g: g.gpio.read("E29"), None),
    ("gpio", "r B0", "1", lambda g: g.gpio.read("B0"), 1),
    ("gpio", "r E12", "E12 = 0", lambda g: g.gpio.read("E12"), 0),
    (
        "gpio", "regs", "A0: 1 A1: 0\nE28 = 1\nUnknown bit E29", lambda g: g.gpio.registers(),
        {"A0": 1, "A1": 0, "E28": 1, "E29": None},
    ),
    ("peak", "rssits", "Even_sig = 489, Odd_sig = 235", lambda g: g.peak.rssi(), (489, 235)),
    ("peak", "ts", "SW Status: 0b0101 5", lambda g: g.peak.switch_status(), 5),
    ("step", "pid", "Kp=250 Kv=50", lambda g: g.stepper.gains(),
        axes("step_kp", 250.0, 250.0) | axes("step_kv", 50.0, 50.0)),
    (
        "mot", "pid", "AZ: Kp=250 Kv=50, EL: Kp=200 Kv=40", lambda g: g.motors.gains(),
        axes("kp", 250.0, 200.0) | axes("kv", 50.0, 40.0),
    ),
    (
        "mot", "pid", "PID[0] Kp=250 Kv=50 Ki=1\nPID[1] Kp=200 Kv=40 Ki=0", lambda g: g.motors.gains(),
        axes("kp", 250.0, 200.0) | axes("kv", 50.0, 40.0) | axes("ki", 1.0, 0.0),
    ),
    (
        "mot", "elminmaxhome", "Min: 18.00 Max: 65.00 Home: 65.00",
        lambda g: g.motors.elevation_limits(), {"floor": 18.0, "ceiling": 65.0, "home.elevation": 65.0},
    ),
    (
        "mot", "mv", "Max Vel [0] = 65.00 / Max Vel [1] = 45.00",
        lambda g: g.motors.max_velocities(), axes("speed", 65.0, 45.0),
    ),
    (
        "mot", "v", "Velocity[0] = 0.00\nVelocity[1] = -3.50",
        lambda g: g.motors.velocities(), axes("velocity", 0.0, -3.5),
    ),
    ("mot", "v", "Velocity[0] = 0\nVelocity[1] = 3", lambda g: g.motors.velocities(), {}),
    ("mot", "pid", "AZ: K?p=250 Kv=50, EL: Kp=200 Kv=40", lambda g: g.motors.gains(),
        {"kp.elevation": 200.0, "kv.elevation": 40.0}),
    ("mot", "p", "Pos[0] = -20000\nPos[1] = 2147483647", lambda g: g.motors.steps(), {"steps.azimuth": -20000}),
    (
        "mot", "l", "0=AZIMUTH 1=ELEVATION", lambda g: g.motors.states(), {},
    ),
    (
        "mot", "l", "0=AZIMUTH HOLDING\n1=ELEVATION MOVING",
        lambda g: g.motors.states(), axes("motor", "HOLDING", "MOVING"),
    ),
    ("mot", "ela2s 45.00", "3120", lambda g: g.motors.elevation_to_steps(45.0), 3120),
    ("mot", "ela2s 45.00", "Angle = 4500 Steps = 3120", lambda g: g.motors.elevation_to_steps(45.0), 3120),
    ("mot", "els2a 3120", "Angle = 45.00", lambda g: g.motors.steps_to_elevation(3120), 45.0),
    ("mot", "els2a 3120", "Steps: 3120 Angle: 4500", lambda g: g.motors.steps_to_elevation(3120), 45.0),
    ("mot", "els2a 3120", "45.00", lambda g: g.motors.steps_to_elevation(3120), 45.0),
    ("mot", "els2a 9999999", "Overflow", lambda g: g.motors.steps_to_elevation(9999999), None),
    ("mot", "life", "AZ moves: 12", lambda g: g.motors.life(), ("AZ moves: 12",)),
    ("mot", "motorlife", "AZ: 12 EL: 3", lambda g: g.motors.life_details(), ("AZ: 12 EL: 3",)),
]  # fmt: skip


@pytest.mark.parametrize(("menu", "line", "answer", "question", "value"), VALUES)
def test_a_reply_becomes_a_value(ask, menu, line, answer, question, value):
    assert ask(menu, line, answer, question) == value


@pytest.mark.parametrize(
    ("menu", "line", "answer", "question"),
    [
        ("a3981", "diag", "AZ DIAG: OK", lambda g: g.drivers.faults()),
        ("a3981", "cm", "AZ: 7 EL: 8", lambda g: g.drivers.current_mode()),
        ("a3981", "ss", "AZ: 3 EL: 1", lambda g: g.drivers.step_size()),
        ("adc", "rssi", "235 17", lambda g: g.adc.rssi_counts()),
        ("adc", "bdid", "", lambda g: g.adc.board_id()),
        ("dipswitch", "dipswitch", "val:ffffff01", lambda g: g.dipswitch.read()),
        ("eeprom", "ee 3", "Index:4 Read value = 0", lambda g: g.eeprom.read(3)),
        ("gpio", "r B0", "B1 = 1", lambda g: g.gpio.read("B0")),
        ("gpio", "r B0", "7", lambda g: g.gpio.read("B0")),
        ("gpio", "dir B0", "7", lambda g: g.gpio.direction("B0")),
        ("gpio", "regs", "nothing", lambda g: g.gpio.registers()),
        ("latlon", "l 1.00 2.00 3.00 4.00", "Lat = ", lambda g: g.latlon.triangulate(1, 2, 3, 4)),
        ("peak", "rssits", "Even_sig = 489", lambda g: g.peak.rssi()),
        ("peak", "ts", "SW Status: 0b0101 6", lambda g: g.peak.switch_status()),
        ("step", "pid", "250 50", lambda g: g.stepper.gains()),
        ("mot", "elminmaxhome", "Min: 1800 Max: 6500 Home: 6500", lambda g: g.motors.elevation_limits()),
        ("mot", "p", "Pos[0] = 20000", lambda g: g.motors.steps()),
        ("mot", "ela2s 45.00", "4500 3120", lambda g: g.motors.elevation_to_steps(45.0)),
        ("mot", "els2a 3120", "Angle: 450000", lambda g: g.motors.steps_to_elevation(3120)),
        ("mot", "l", "two motors", lambda g: g.motors.states()),
        ("os", "id", "NXP Kinetis", lambda g: g.system.identity()),
        ("dvb", "rrto", "", lambda g: g.tuner.diseqc.reply_timeout_ms()),
        ("dvb", "rssi 10", "RSSI 403 402", lambda g: g.tuner.rssi()),
    ],
)  # fmt: skip
def test_what_makes_no_sense_is_no_value(ask, menu, line, answer, question):
    with pytest.raises(NoReply) as raised:
        ask(menu, line, answer, question)
    assert raised.value.reason == "garbage"


PRINTED = ("life", "motorlife", "l", "bdid", "bdrevid")
"""Their words are handed on as printed."""


@pytest.mark.parametrize(
    ("menu", "line", "answer", "question", "value"), [row for row in VALUES if row[1] not in PRINTED and row[2]]
)
def test_noise_in_a_reply_brings_no_wrong_value(ask, menu, line, answer, question, value):
    for at in range(len(answer) + 1):
        try:
            found = ask(menu, line, f"{answer[:at]}\xff{answer[at:]}", question)
        except (NoReply, CommandRefused):
            continue
        if isinstance(value, dict):
            assert found.items() <= value.items(), answer[:at]
        else:
            assert found in (value, None), answer[:at]


def test_a_refusal_is_told_from_garbage(ask):
    with pytest.raises(CommandRefused) as raised:
        ask("gpio", "dir E29", "Invalid parameter", lambda g: g.gpio.direction("E29"))
    assert raised.value.reason == "bad_parameter"


def test_a_failure_is_a_refusal_unless_it_speaks_of_an_entry_never_written(ask):
    with pytest.raises(CommandRefused):
        ask("peak", "ts", "Failed to read switch", lambda g: g.peak.switch_status())


@pytest.mark.parametrize("call", [lambda g: g.gpio.read("b0;w B0 1"), lambda g: g.gpio.direction("F1"),
                                  lambda g: g.tuner.rssi(0), lambda g: g.tuner.select(-1)])  # fmt: skip
def test_what_is_no_argument_never_leaves(play, call):
    g2, port = play([])
    with pytest.raises(ValueError, match=r".+"):
        call(g2)
    assert port.written == b""


def test_without_a_port_each_room_says_so():
    with pytest.raises(LinkError):
        _ = CarryoutG2Protocol().tuner


def test_triangulation(ask):
    place = ask(
        "latlon", "l 180.00 45.00 200.50 40.00", "anglesentered = 18000 4500 20050 4000\nLat = 3910 Lon = -9570",
        lambda g: g.latlon.triangulate(180.0, 45.0, 200.5, 40.0),
    )  # fmt: skip
    assert place == (39.1, -95.7)


def test_a_calculator_that_took_other_angles_is_not_believed(ask):
    with pytest.raises(CommandRefused) as raised:
        ask(
            "latlon", "l 180.00 45.00 200.50 40.00", "anglesentered = 180 45 200 40\nLat = 3910 Lon = -9570",
            lambda g: g.latlon.triangulate(180.0, 45.0, 200.5, 40.0),
        )  # fmt: skip
    assert raised.value.reason == "bad_parameter"


def test_accelerations_of_the_stepper_are_in_degrees(ask):
    found = ask("step", "ma", "Accel[0] = 44 / Accel[1] = 28", lambda g: g.stepper.max_accelerations())
    assert found == pytest.approx(axes("acceleration", 396.0, 403.8), abs=0.1)


@pytest.mark.parametrize(
    ("line", "point"),
    [
        ("Motor:0 Angle:18000 RSSI:523 Lock:0 SNR:0 Scan Delta:100", ScanPoint(0, 180.0, 523, False, 0.0, 1.0)),
        ("Motor:0 Angle:18200 RSSI:547 Lock:1 SNR:8.5 Scan Delta:-50", ScanPoint(0, 182.0, 547, True, 8.5, -0.5)),
        ("Motor:0 Angle:2147483647 RSSI:1 Lock:0 SNR:0 Scan Delta:100", ScanPoint(0, None, 1, False, 0.0, 1.0)),
        ("Motor:0 Angle:18000 RSSI:523 Lock:0 SNR:0", None),
        ("Motor:0 Angle:18000 RSSI: Lock:0 SNR:0 Scan Delta:100", None),
        ("Motor:0 Angle:180x0 RSSI:523 Lock:0 SNR:0 Scan Delta:100", None),
        ("scanning", None),
    ],
)
def test_a_point_of_a_sweep(line, point):
    assert parse_scan_point(line) == point
