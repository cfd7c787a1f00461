"""PEAK, GPIO, A3981, EE and LATLON: what they tell follows the sky, the mechanics and what was done before."""

from __future__ import annotations

import math
import re

import pytest
from birdcage.sim.almanac import geostationary

SLOT = -119.0


def entered(terminal, menu, options="az=0&el=58", prompt=""):
    dish = terminal(options)
    dish.ask(menu, prompt or f"{menu.upper()}>")
    return dish


def counts(reply):
    return [int(text) for text in re.search(r"Even_sig = (\d+), Odd_sig = (\d+)", reply).groups()]


def beside(d_az, d_el, more=""):
    az, el = geostationary(SLOT, 39.1, -95.7)
    return f"az={az - 360 + d_az:.3f}&el={el + d_el:.3f}{more}"


# --- PEAK


def test_both_polarisations_of_the_empty_sky_and_of_a_satellite(terminal):
    assert counts(entered(terminal, "peak").ask("rssits", "\nPEAK>")) == [
        pytest.approx(489, abs=4),
        pytest.approx(235, abs=4),
    ]
    dish = entered(terminal, "peak", beside(0, 0))
    even, odd = counts(dish.ask("rssits", "\nPEAK>"))
    assert even > 600
    assert odd > 350
    assert dish.device.board.tuner.lnb_volts == 18.0


def test_a_sweep_of_both_axes_ends_on_the_satellite(terminal):
    dish = entered(terminal, "peak", beside(1.6, -1.2))
    start = dish.now
    reply = dish.ask("pw", "\nPEAK>", within=60.0)
    assert dish.now - start > 0.5
    truth = dish.port.dish.truth()
    az, el = geostationary(SLOT, 39.1, -95.7)
    assert truth.az_deg == pytest.approx(az, abs=0.9)
    assert truth.el_deg == pytest.approx(el, abs=0.6)
    assert not truth.moving
    shown = [int(text) / 100 for text in re.findall(r"Angle:(\d+)", reply)]
    assert shown == [pytest.approx(truth.az_deg, abs=0.1), pytest.approx(truth.el_deg, abs=0.1)]


def test_one_axis_moves_and_the_other_does_not(terminal):
    dish = entered(terminal, "peak", beside(0, 1.5))
    before = dish.port.dish.truth()
    dish.type("pxy1 1\r")
    seen = []
    for _ in range(100):
        dish.clock.advance(0.03)
        seen.append(dish.port.dish.truth().el_deg)
    assert max(seen) - min(seen) == pytest.approx(4.0, abs=0.3)
    truth = dish.port.dish.truth()
    assert truth.cable_deg == before.cable_deg
    assert truth.el_deg == pytest.approx(geostationary(SLOT, 39.1, -95.7)[1], abs=0.6)


@pytest.mark.parametrize("el", [18.0, 65.0])
def test_a_sweep_stays_within_the_limits(terminal, el):
    dish = entered(terminal, "peak", f"az=20&el={el}&overshoot=0")
    dish.type("pw\r")
    for _ in range(200):
        dish.clock.advance(0.05)
        truth = dish.port.dish.truth()
        assert 18.0 - 0.02 <= truth.el_deg <= 65.0 + 0.02
        assert truth.cable_deg <= 23.34


@pytest.mark.parametrize("line", ["pw", "pxy1", "pxy1 1"])
def test_an_unhomed_dish_does_not_sweep(terminal, line):
    dish = entered(terminal, "peak", "unhomed=1")
    reply = dish.ask(line, "\nPEAK>")
    assert re.search(r"Step to Position (AZ|EL) angle error: 2147483647\r\n", reply)
    assert not dish.port.dish.truth().moving
    deadly = entered(terminal, "peak", "unhomed=1&unhomed_move=deadlock")
    deadly.ask(line)
    assert not deadly.port.dish.truth().shell_alive


def test_snr_at_the_peak(terminal):
    dish = entered(terminal, "peak", beside(0, 0, "&lock_polarity=0"))
    assert float(dish.ask("psnr", "\nPEAK>").split("SNR: ")[1].split()[0]) > 8


# --- GPIO


def test_there_are_92_pins(terminal):
    reply = entered(terminal, "gpio").ask("regs", "\nGPIO>")
    states = dict(re.findall(r"\b([A-E]\d+):([01])", reply))
    ports = [sum(pin[0] == port for pin in states) for port in "ABCDE"]
    assert ports == [26, 16, 20, 16, 14]
    assert len(states) == sum(ports) == 92
    absent = {f"A{n}" for n in range(20, 24)} | {f"B{n}" for n in range(12, 16)} | {"E29"}
    assert not states.keys() & absent
    assert reply.count("Unknown bit E29") == 1
    high = {pin for pin, state in states.items() if state == "1"}
    assert high == set(
        "E0 E1 E2 E4 E5 D10 D11 D12 D13 E24 E25 E26 E27 E28 B0 B1 B2 B3 B11 C10 C11 C12 C13 C18".split()  # noqa: SIM905
    )


@pytest.mark.parametrize(
    ("pin", "direction"),
    [("E0", "OUTPUT"), ("E4", "INPUT"), ("E5", "OUTPUT"), ("D11", "OUTPUT"), ("D12", "INPUT"), ("E25", "INPUT")],
)
def test_directions_of_the_pin_map(terminal, pin, direction):
    assert entered(terminal, "gpio").ask(f"dir {pin}", "\nGPIO>") == f"dir {pin}\r\n{direction}\r\nGPIO>"


def test_a_driven_output_holds_until_power_on_and_an_input_does_not_care(terminal):
    dish = entered(terminal, "gpio")
    dish.ask("w B3 0", "\nGPIO>")
    dish.ask("w E25 0", "\nGPIO>")
    assert dish.ask("r B3", "\nGPIO>") == "r B3\r\n0\r\nGPIO>"
    assert dish.ask("r E25", "\nGPIO>") == "r E25\r\n1\r\nGPIO>"
    dish.device.power_cycle()
    dish.listen(30.0)
    dish.ask("gpio", "GPIO>")
    assert dish.ask("r B3", "\nGPIO>") == "r B3\r\n1\r\nGPIO>"


def test_pins_of_tuner_and_lnb(terminal):
    dish = entered(terminal, "gpio")
    dish.device.board.tuner.lnb_volts = 13.0
    assert dish.ask("r C18", "\nGPIO>") == "r C18\r\n0\r\nGPIO>"
    dish.ask("w C18 1", "\nGPIO>")
    dish.ask("w D10 0", "\nGPIO>")
    assert (dish.device.board.tuner.lnb_volts, dish.device.board.tuner.on) == (18.0, False)
    apart = entered(terminal, "gpio", "pins_follow=0")
    apart.ask("w D10 0", "\nGPIO>")
    assert apart.ask("r D10", "\nGPIO>") == "r D10\r\n0\r\nGPIO>"
    assert apart.device.board.tuner.on


# --- A3981


def test_torque_follows_the_motors(terminal):
    dish = entered(terminal, "mot", prompt="MOT>")
    dish.ask("a 0 200", "\nMOT>")
    dish.ask("q", "TRK>")
    dish.ask("a3981", "A3981>")
    assert dish.ask("st", "\nA3981>") == "st\r\nAZ ST: HIGH EL ST: LOW\r\nA3981>"
    dish.clock.advance(10.0)
    assert dish.ask("st", "\nA3981>") == "st\r\nAZ ST: LOW EL ST: LOW\r\nA3981>"


def test_a_blocked_axis_is_a_fault_until_reset_and_again_when_driven(terminal):
    dish = entered(terminal, "a3981")
    dish.device.stall(1)
    assert "AZ DIAG: OK EL DIAG: FAULT\r\n" in dish.ask("diag", "\nA3981>")
    dish.ask("reset", "\nA3981>")
    assert "AZ DIAG: OK EL DIAG: OK\r\n" in dish.ask("diag", "\nA3981>")
    dish.device.board.dish.axes[1].retarget(dish.device.board.now_s, 30.0)
    assert "EL DIAG: FAULT\r\n" in dish.ask("diag", "\nA3981>")
    dish.device.stall(1, blocked=False)
    assert "EL DIAG: OK\r\n" in dish.ask("diag", "\nA3981>")
    quiet = entered(terminal, "a3981", "stall_faults=0")
    quiet.device.stall(0)
    assert "AZ DIAG: OK" in quiet.ask("diag", "\nA3981>")


# --- EE


def test_entries_outlast_reboot_and_power_cycle(terminal):
    dish = entered(terminal, "eeprom", prompt="EE>")
    dish.ask("ee 40 123", "\nEE>")
    dish.ask("inv 2", "\nEE>")
    for restart in (dish.device.reboot, dish.device.power_cycle):
        restart()
        dish.listen(30.0)
        dish.ask("eeprom", "EE>")
        assert "Index:40 Read value = 123\r\n" in dish.ask("ee 40", "\nEE>")
        assert "Failed to read eeprom index:2 val:65793\r\n" in dish.ask("ee 2", "\nEE>")
    dish.ask("def", "\nEE>")
    assert "Failed to read eeprom index:40 val:65793\r\n" in dish.ask("ee 40", "\nEE>")
    assert "Index:2 Read value = 0\r\n" in dish.ask("ee 2", "\nEE>")


# --- DIPSWITCH


def test_switches_may_be_told_by_the_settings_memory(terminal):
    dish = entered(terminal, "nvs", prompt="NVS>")
    for line in ("e 112 1", "e 113 202", "s"):
        dish.ask(line, "\nNVS>")
    dish.device.power_cycle()
    dish.listen(30.0)
    dish.ask("dipswitch", "\nDIPSWITCH>")
    assert dish.ask("dipswitch", "\nDIPSWITCH>") == "dipswitch\r\nval:ffffff01\r\napp_dipswitch:202\r\nDIPSWITCH>"


# --- LATLON


def look(slot, lat, lon):
    """Angles to a slot by vectors in Earth's own frame: the test's own oracle."""
    radius, orbit = 6378.14, 42164.17
    la, lo, sl = (math.radians(angle) for angle in (lat, lon, slot))
    up = (math.cos(la) * math.cos(lo), math.cos(la) * math.sin(lo), math.sin(la))
    east = (-math.sin(lo), math.cos(lo), 0.0)
    north = (-math.sin(la) * math.cos(lo), -math.sin(la) * math.sin(lo), math.cos(la))
    sat = (orbit * math.cos(sl), orbit * math.sin(sl), 0.0)
    line = [s - radius * u for s, u in zip(sat, up, strict=True)]
    e, n, u = (sum(a * b for a, b in zip(line, axis, strict=True)) for axis in (east, north, up))
    return math.degrees(math.atan2(e, n)) % 360.0, math.degrees(math.atan2(u, math.hypot(e, n)))


@pytest.mark.parametrize(
    ("place", "slots"),
    [
        ((39.1, -95.7), (-119.0, -110.0)),
        ((25.8, -80.2), (-119.0, -110.0)),
        ((49.3, -123.1), (-119.0, -61.5)),
        ((-33.9, 18.4), (28.2, 13.0)),
        ((-17.7, 178.1), (-177.0, 160.0)),
        ((0.5, -114.0), (-119.0, -110.0)),
    ],
)
@pytest.mark.parametrize("unit", ["deg", "cdeg"])
def test_it_finds_the_place_from_the_look_angles(terminal, place, slots, unit):
    dish = entered(terminal, "latlon", f"latlon_first={slots[0]}&latlon_second={slots[1]}&latlon_unit={unit}")
    angles = [angle for slot in slots for angle in look(slot, *place)]
    cdeg = [round(angle * 100) for angle in angles]
    given = cdeg if unit == "cdeg" else [f"{angle:.2f}" for angle in angles]
    reply = dish.ask("l " + " ".join(map(str, given)), "\nLATLON>")
    assert "anglesentered = {} {} {} {}\r\n".format(*cdeg) in reply
    lat, lon = (int(text) / 100 for text in re.search(r"Lat = (-?\d+) Lon = (-?\d+)\r\n", reply).groups())
    # Near the point below a satellite a hundredth of a degree of elevation is worth the same of the place, no more.
    assert (lat, lon) == (pytest.approx(place[0], abs=0.15), pytest.approx(place[1], abs=0.15))
