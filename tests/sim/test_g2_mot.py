"""What the commands of the motor and stepper menus do to the dish."""

from __future__ import annotations

import re

import pytest

HIGH, LOW = 23.33, -423.33


def at(terminal, options="", menu="mot"):
    dish = terminal(options)
    dish.ask(menu, f"{menu.upper()}>")
    return dish


def truth(dish):
    return dish.port.dish.truth()


def to_menu(dish, menu):
    dish.ask("q", "TRK>")
    dish.ask(menu, f"{menu.upper()}>")


def travelled(dish):
    heard = dish.ask("motorlife", "MOT>")
    return [float(text) for text in re.findall(r"degrees: (\S+)", heard)]


def test_g_moves_both_at_once_and_keeps_the_shell_until_it_is_there(terminal):
    dish = at(terminal, "az=-90&overshoot=0")
    start = dish.now
    dish.type("g 180 60\r")
    dish.listen(0.2)
    under_way = truth(dish)
    assert under_way.az_deg < 269.5
    assert under_way.el_deg > 45.5
    assert dish.listen(5.0) == "MOT>"
    assert dish.now - start > 1.5
    assert (truth(dish).az_deg, truth(dish).el_deg) == (pytest.approx(180, abs=0.01), pytest.approx(60, abs=0.01))


@pytest.mark.parametrize("key", ["x", "\r", "q", "a\r", " ", "\x1b"])
def test_any_byte_breaks_g_off_and_both_axes_come_to_rest(terminal, key):
    dish = at(terminal, "az=-300&overshoot=0")
    dish.type("g 300 20\r")
    dish.listen(0.4)
    before = truth(dish)
    dish.type(key)
    dish.listen(1.0)
    after = truth(dish)
    assert not after.moving
    # v2/2a from 65 and 45 deg/s at 400 deg/s2 is 5.3 and 2.5 degrees: it decelerates, it does not jump to rest
    assert 2.0 < before.cable_deg - after.cable_deg < 5.5
    assert 1.0 < before.el_deg - after.el_deg < 2.8
    assert truth(dish).menu == "mot"
    dish.ask("", "MOT>")
    assert "Angle[0] = " in dish.ask("a", "MOT>")


def test_the_rest_of_a_crlf_breaks_nothing_off(terminal):
    dish = at(terminal, "az=-300&overshoot=0")
    dish.type("g 300 20\r\n")
    dish.listen(5.0)
    assert truth(dish).az_deg == pytest.approx(300, abs=0.01)
    to_menu(dish, "adc")
    dish.type("m\r\n")
    assert dish.listen(1.1).count("RSSI") == 6


def test_g_may_report(terminal):
    dish = at(terminal, "g_reply=angles&overshoot=0&backlash=0")
    assert dish.ask("g 350 50", "MOT>") == "g 350 50\r\nAngle[0] = 350.00\r\nAngle[1] = 50.00\r\nMOT>"


def test_g_refuses_what_a_refuses(terminal):
    dish = at(terminal)
    assert "Angle out of range.\r\n" in dish.ask("g 350 70", "MOT>")
    assert not truth(dish).moving
    assert "Step to Position AZ angle error: 2147483647\r\n" in at(terminal, "unhomed=1").ask("g 10 30", "MOT>")


def test_life_grows_with_real_motion_of_that_axis_only(terminal):
    dish = at(terminal, "az=-90&overshoot=0")
    assert travelled(dish) == [0.0, 0.0]
    dish.ask("a 0 180", "MOT>")
    dish.listen(3.0)
    assert travelled(dish) == [pytest.approx(90, abs=0.02), 0.0]
    dish.ask("a 0 180", "MOT>")
    dish.listen(3.0)
    assert travelled(dish)[0] == pytest.approx(90, abs=0.02)
    dish.ask("h 1", "MOT>")
    dish.listen(3.0)
    assert travelled(dish)[1] == pytest.approx(21.0, abs=0.05)  # 45 to the stop at 65.5 and back to 65
    assert "ELEVATION moves: 0 homings: 1\r\n" in dish.ask("motorlife", "MOT>")
    dish.device.stall(0)
    dish.ask("a 0 90", "MOT>")
    dish.listen(3.0)
    assert travelled(dish)[0] == pytest.approx(90, abs=0.02)
    assert "AZIMUTH degrees: 90\r\n" in dish.ask("life", "MOT>")


def test_sp_shifts_what_the_dish_believes(terminal):
    dish = at(terminal, "az=-90&overshoot=0")
    assert "Position[0] = 0\r\n" in dish.ask("sp 0 0", "MOT>")
    assert dish.angles()[0] == 0.0
    assert truth(dish).cable_deg == -90.0
    dish.ask("a 0 350", "MOT>")
    dish.listen(2.0)
    assert dish.angles()[0] == 350.0
    assert truth(dish).cable_deg == pytest.approx(-100.0, abs=0.01)


def test_sp_makes_an_unhomed_axis_believe(terminal):
    dish = at(terminal, "unhomed=1")
    dish.ask("sp 1 30", "MOT>")
    assert "Angle[1] = 30.00\r\n" in dish.ask("a", "MOT>").replace("30.01", "30.00")
    assert "2147483647" in dish.ask("a", "MOT>")  # the azimuth still does not know
    dish = at(terminal, "unhomed=1&sp_homes=0")
    dish.ask("sp 1 30", "MOT>")
    assert dish.ask("a", "MOT>").count("2147483647") == 2


@pytest.mark.parametrize(("unit", "text"), [("deg", "-45"), ("cdeg", "-4500"), ("steps", "-5000")])
def test_the_unit_of_sp_is_a_setting(terminal, unit, text):
    dish = at(terminal, f"position_unit={unit}")
    assert "Position[0] = -5000\r\n" in dish.ask(f"sp 0 {text}", "MOT>")


def test_sw_moves_the_limits_of_the_cable(terminal):
    dish = at(terminal, "overshoot=0")
    assert "wrap_min:-44333 wrap_max:333\r\n" in dish.ask("sw 0 20", "MOT>")
    dish.ask("a 0 10", "MOT>")  # ten degrees forward would be 30 on the cable now
    dish.listen(8.0)
    assert truth(dish).cable_deg == pytest.approx(-350.0, abs=0.01)
    assert "wrap_min:-42333 wrap_max:2333\r\n" in dish.ask("h 0", "MOT>")


def test_without_the_wrap_manager_the_cable_is_overwound(terminal):
    dish = at(terminal, "overshoot=0")
    dish.ask("a 0 40", "MOT>")
    dish.listen(10.0)
    assert truth(dish).cable_deg == pytest.approx(-320.0, abs=0.01)
    dish.ask("h 0", "MOT>")
    assert "Wrap[0] = OFF\r\n" in dish.ask("w 0 OFF", "MOT>")
    dish.type("a 0 40\r")
    heard = dish.listen(3.0)
    assert "Angle = 40.00\r\n" in heard
    assert heard.endswith("AZ MOTOR STALLED\r\n")
    assert truth(dish).cable_deg == pytest.approx(HIGH, abs=1e-6)
    assert dish.angles()[0] == pytest.approx(HIGH, abs=0.01)
    dish.device.power_cycle()
    dish.listen(30.0)
    dish.ask("mot", "MOT>")
    assert "Wrap[0] = ON\r\n" in dish.ask("w", "MOT>")


def test_an_overwound_axis_may_slip_and_know_nothing(terminal):
    dish = at(terminal, "overshoot=0&stall=slip")
    dish.ask("w 0 OFF", "MOT>")
    dish.ask("a 0 40", "MOT>")
    assert "STALLED" not in dish.listen(3.0)
    assert dish.angles()[0] == pytest.approx(40.0, abs=0.01)
    assert truth(dish).cable_deg == pytest.approx(HIGH, abs=1e-6)
    dish.ask("a 0 0", "MOT>")
    dish.listen(3.0)
    assert truth(dish).cable_deg == pytest.approx(HIGH - 40, abs=0.01)


def test_stepper_positions_and_speeds_have_no_limits_but_the_stops(terminal):
    dish = at(terminal, "overshoot=0", menu="step")
    dish.type("p 1 0\r")
    assert "EL MOTOR STALLED\r\n" in dish.listen(3.0)
    assert truth(dish).el_deg == pytest.approx(17.5, abs=1e-6)
    dish.type("v 0 -1111\r")
    heard = dish.listen(30.0)
    assert "STALLED" not in heard
    assert truth(dish).moving
    assert "AZ MOTOR STALLED\r\n" in dish.listen(30.0)
    assert truth(dish).cable_deg == pytest.approx(LOW, abs=1e-6)
    assert not truth(dish).moving


def test_gains_are_shared_by_both_menus_and_come_from_the_settings_memory(terminal):
    dish = at(terminal, "pid_kp=300&pid_kv=60&pid_ki=2", menu="step")
    assert "Kp=300 Kv=60\r\n" in dish.ask("pid", "STEP>")
    dish.ask("pid 0 100 10", "STEP>")
    to_menu(dish, "mot")
    assert "PID[0] Kp=100 Kv=10 Ki=2\r\nPID[1] Kp=300 Kv=60 Ki=2\r\n" in dish.ask("pid", "MOT>")
    to_menu(dish, "nvs")
    assert "300.00" in dish.ask("e 128", "NVS>")
    dish.ask("e 131 111", "NVS>")
    dish.ask("s", "NVS>")
    dish.device.power_cycle()
    dish.listen(30.0)
    dish.ask("mot", "MOT>")
    assert "PID[0] Kp=300 Kv=60 Ki=2\r\nPID[1] Kp=111 Kv=60 Ki=2\r\n" in dish.ask("pid", "MOT>")


@pytest.mark.parametrize("blocks", [1, 0])
def test_vms_spins_for_so_long(terminal, blocks):
    dish = at(terminal, f"az=-90&vms_blocks={blocks}&overshoot=0")
    start = dish.now
    dish.ask("vms 0 -20 2000", "MOT>")
    assert (dish.now - start > 1.9) is bool(blocks)
    dish.listen(4.0)
    assert not truth(dish).moving
    assert truth(dish).cable_deg == pytest.approx(-130.0, abs=0.6)


def test_vms_keeps_the_limits(terminal):
    dish = at(terminal, "overshoot=0")
    assert "STALLED" not in dish.ask("vms 1 40 5000", "MOT>")
    assert truth(dish).el_deg == pytest.approx(65.0, abs=0.01)


def test_motorboth_turns_both_out_and_back(terminal):
    dish = at(terminal, "az=-90&overshoot=0&motorboth_deg=15")
    dish.ask("motorboth", "MOT>")
    assert (truth(dish).cable_deg, truth(dish).el_deg) == (pytest.approx(-90, abs=0.01), pytest.approx(45, abs=0.01))
    assert travelled(dish) == [pytest.approx(30, abs=0.05), pytest.approx(30, abs=0.05)]
    assert "angle error: 2147483647" in at(terminal, "unhomed=1").ask("motorboth", "MOT>")


def test_a_stall_is_found_where_there_is_one(terminal):
    dish = at(terminal, "unhomed=1&seed=4")
    assert "EL MOTOR STALLED\r\n" in dish.ask("sd 1 1 5000", "MOT>")
    assert truth(dish).el_deg == pytest.approx(65.5, abs=1e-6)
    dish = at(terminal, "az=-200")
    assert dish.ask("sd 0 0 500", "MOT>") == "sd 0 0 500\r\nAZ - No stall\r\nMOT>"
    dish.listen(1.0)
    assert truth(dish).cable_deg == pytest.approx(-232, abs=7)
    dish.device.stall(0)
    assert dish.ask("sd 0 1 5000", "MOT>") == "sd 0 1 5000\r\nAZ MOTOR STALLED\r\nMOT>"


def test_help_lists_every_command_with_its_arguments(terminal):
    heard = at(terminal).ask("?", "\nMOT>")
    for usage in (
        "azscan [az_rel] [el_rel] [delay]",
        "azscanwxp [motor] [span_deg] [res_cdeg] [num_xponders]",
        "ela2s <deg>",
        "els2a <steps>",
        "g <az> <el>",
        "pid [motor] [Kp] [Kv] [Ki]",
        "sp [motor] [pos]",
        "sw [motor] [pos]",
        "vms [motor] [deg_per_rev] [ms]",
        "w [motor] [ON/OFF]",
    ):
        assert f"\r\n{usage}" in heard
