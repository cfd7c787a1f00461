"""The stepper and analogue menus, `stow`, and what `?` lists."""

from __future__ import annotations

import re

import pytest
from birdcage.sim.g2.firmware import menus


def entered(terminal, menu, options=""):
    dish = terminal(options)
    dish.ask(menu, f"{menu.upper()}>")
    return dish


def test_every_command_of_every_menu_is_listed_and_known(terminal):
    for name, menu in menus(terminal().device.board).items():
        listed = {line.split()[0] for line in menu.help_lines if not line.startswith("Enter")}
        assert listed == set(menu.commands) - {"?"}, name
        for word in set(menu.commands) - {"q", "reboot", "h", "?"}:
            dish = terminal()
            if name != "root":
                dish.ask(name)
            assert "Invalid command." not in dish.ask(word), f"{name}: {word}"


def test_help_of_the_root_lists_the_menus_that_there_are(terminal):
    listed = re.findall(r"Enter <(\w+)>", terminal().ask("?"))
    assert listed == sorted(set(menus(terminal().device.board)) - {"root"})


def test_speeds_in_microsteps(terminal):
    dish = entered(terminal, "step")
    assert dish.ask("mv", "STEP>") == "mv\r\nMax Vel [0] = 7222\r\nMax Vel [1] = 3120\r\nSTEP>"
    assert "Max Vel [0] = 1111\r\n" in dish.ask("mv 0 1111", "STEP>")
    dish.ask("q", "TRK>")
    dish.ask("mot", "MOT>")
    assert "Max Vel [0] = 10.00\r\n" in dish.ask("mv", "MOT>")
    start = dish.now
    dish.ask("a 0 300", "MOT>")  # 60 degrees the short way, at 10 deg/s
    while dish.port.dish.truth().moving:
        dish.clock.advance(0.1)
    assert 6.0 < dish.now - start < 6.3


def test_speeds_last_until_a_reboot(terminal):
    dish = entered(terminal, "step")
    dish.ask("mv 1 500", "STEP>")
    dish.device.power_cycle()
    dish.listen(30.0)
    dish.ask("step", "STEP>")
    assert "Max Vel [1] = 3120\r\n" in dish.ask("mv", "STEP>")


@pytest.mark.parametrize("line", ["mv 0", "mv 2 500", "mv 0 -5", "mv 0 0", "mv 0 x", "ma 0 0", "p 0", "v", "pid 0 1"])
def test_bad_numbers_in_the_stepper_menu(terminal, line):
    assert "Invalid parameter." in entered(terminal, "step").ask(line, "STEP>")


def test_accelerations_and_gains(terminal):
    dish = entered(terminal, "step")
    assert dish.ask("ma", "STEP>") == "ma\r\nAccel[0] = 44\r\nAccel[1] = 28\r\nSTEP>"
    assert "Accel[0] = 22\r\n" in dish.ask("ma 0 22", "STEP>")
    assert dish.ask("pid", "STEP>") == "pid\r\nKp=250 Kv=50\r\nSTEP>"
    assert "Kp=200 Kv=40\r\n" in dish.ask("pid 0 200 40", "STEP>")


def test_raw_steps_and_spinning(terminal):
    dish = entered(terminal, "step", "overshoot=0")
    dish.ask("p 0 -10000", "STEP>")
    dish.clock.advance(5.0)
    assert dish.port.dish.truth().cable_deg == pytest.approx(-90.0, abs=0.01)
    dish.ask("v 0 1111", "STEP>")
    dish.clock.advance(3.0)
    assert dish.port.dish.truth().moving
    dish.ask("v 0 0", "STEP>")
    dish.clock.advance(1.0)
    truth = dish.port.dish.truth()
    assert not truth.moving
    assert -65.0 < truth.cable_deg < -50.0


def test_release_and_engage(terminal):
    dish = entered(terminal, "step")
    dish.ask("r", "STEP>")
    assert dish.port.dish.truth().released
    dish.ask("e", "STEP>")
    assert not dish.port.dish.truth().released


@pytest.mark.parametrize("blocks", [0, 1])
def test_stow(terminal, blocks):
    dish = terminal(f"stow_az=-90&stow_el=20&stow_blocks={blocks}")
    start = dish.now
    dish.ask("stow", "TRK>")
    assert (dish.now - start > 1.0) is bool(blocks)
    dish.clock.advance(5.0)
    truth = dish.port.dish.truth()
    assert (truth.cable_deg, truth.el_deg) == (pytest.approx(-90, abs=0.1), pytest.approx(20, abs=0.1))


def test_stow_unhomed(terminal):
    dish = terminal("unhomed=1")
    assert "Step to Position AZ angle error: 2147483647" in dish.ask("stow", "TRK>")
    assert not dish.port.dish.truth().moving


def test_identity_and_level_of_the_analogue_menu(terminal):
    dish = entered(terminal, "adc", "el=58&az=0")
    assert "STATIONARY\r\n" in dish.ask("bdid", "ADC>")
    assert "\r\nA\r\n" in dish.ask("bdrevid", "ADC>")
    assert int(dish.ask("rssi", "ADC>").splitlines()[1]) == pytest.approx(235, abs=6)


def test_scan(terminal):
    dish = entered(terminal, "adc", "az=-180")
    lines = dish.ask("scan", "ADC>").splitlines()[1:-1]
    assert len(lines) == 11
    assert all(re.fullmatch(r"Motor:0 Angle:\d{5} RSSI:\d+ Lock:[01] SNR:\d+ Scan Delta:100", line) for line in lines)
    angles = [int(re.search(r"Angle:(\d+)", line)[1]) / 100 for line in lines]
    assert angles == pytest.approx([180 + n for n in range(11)], abs=0.7)


def test_an_unhomed_scan_hangs_the_shell_for_good(terminal):
    dish = entered(terminal, "adc", "unhomed=1")
    dish.ask("scan")
    assert not dish.port.dish.truth().shell_alive
    for key in ("", "q", "reboot", "\x1b", "\x03"):
        assert dish.ask(key) == ""
    assert "2147483647" in entered(terminal, "adc", "unhomed=1&unhomed_scan=error").ask("scan", "ADC>")


def test_motor_menu_tells_about_its_motors(terminal):
    dish = entered(terminal, "mot", "az=-90")
    assert "0=AZIMUTH HOLDING\r\n1=ELEVATION HOLDING\r\n" in dish.ask("l", "MOT>")
    assert "Position[0] = -10000\r\n" in dish.ask("p", "MOT>")
    assert "Velocity[0] = 0.00\r\n" in dish.ask("v", "MOT>")
    assert "Max Accel [0] = 400.00\r\n" in dish.ask("ma", "MOT>")
    dish.ask("a 0 20", "MOT>")
    dish.clock.advance(0.5)
    assert "Velocity[0] = 65.00\r\n" in dish.ask("v", "MOT>")
    assert "0=AZIMUTH MOVING\r\n" in dish.ask("l", "MOT>")
    assert "AZIMUTH moves: 1\r\n" in dish.ask("life", "MOT>")
    dish.ask("r", "MOT>")
    assert "1=ELEVATION RELEASED\r\n" in dish.ask("l", "MOT>")


def test_the_step_counter_is_unknown_too_until_homed(terminal):
    assert "Position[1] = 2147483647" in entered(terminal, "mot", "unhomed=1").ask("p", "MOT>")


def test_booted_but_not_homed_with_its_search_on(terminal):
    dish = terminal("boot=1&nvs20=0&home_fails=1")
    log = dish.listen(60.0)
    assert "EL Motor Home Failure\r\n" in log
    assert "Antenna Facing Front" not in log
    assert log.endswith("TRK>")
    assert not dish.port.dish.truth().moving
    dish.ask("nvs", "NVS>")
    assert "FALSE" in dish.ask("d 20", "NVS>")
    dish.ask("q", "TRK>")
    dish.ask("mot", "MOT>")
    assert "2147483647" in dish.ask("a", "MOT>")
    dish.ask("h *", "MOT>")
    assert dish.angles() == (0.01, 65.0)
