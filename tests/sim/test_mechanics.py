"""The dish as its console and its truth show it."""

from __future__ import annotations

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

HIGH, LOW = 23.33, -423.33


def at_mot(terminal, options=""):
    dish = terminal(options)
    dish.ask("mot", "MOT>")
    return dish


def truth(dish):
    return dish.port.dish.truth()


def test_a_reports_while_it_moves(terminal):
    dish = at_mot(terminal, "latency_min=0&latency_max=0")
    dish.ask("a 0 270", "MOT>")
    dish.listen(0.5)
    az, _ = dish.angles()
    assert truth(dish).moving
    assert az == pytest.approx(360 - 65 * (0.5 - 65 / 400 / 2), abs=0.2)


def test_both_axes_move_at_once(terminal):
    dish = at_mot(terminal)
    dish.type("a 0 270\ra 1 20\r")
    dish.listen(0.5)
    now = truth(dish)
    assert now.az_deg < 350
    assert now.el_deg < 40


@pytest.mark.parametrize("seed", range(8))
def test_it_comes_to_rest_past_the_target_in_the_direction_of_travel(terminal, seed):
    dish = at_mot(terminal, f"seed={seed}&az=-200")
    for az, el in ((200, 60), (170, 30), (250, 50)):
        before = truth(dish)
        dish.type(f"a 0 {az}\ra 1 {el}\r")
        dish.listen(5.0)
        after = truth(dish)
        for was, wanted, now in ((before.az_deg, az, after.az_deg), (before.el_deg, el, after.el_deg)):
            direction = 1 if wanted > was else -1
            past = (now - wanted) * direction
            assert 0.01 - 1e-9 <= past <= (0.05 if direction > 0 else 0.06) + 1e-9


def test_an_ideal_axis_rests_on_the_nearest_step(terminal):
    dish = at_mot(terminal, "overshoot=0")
    dish.ask("a 0 300.003", "MOT>")
    dish.listen(5.0)
    assert abs(truth(dish).az_deg - 300.003) <= 360 / 40000 / 2 + 1e-9
    assert dish.angles()[0] == 300.01


def test_the_same_target_again_moves_nothing(terminal):
    dish = at_mot(terminal)
    dish.ask("a 0 300", "MOT>")
    dish.listen(5.0)
    before = truth(dish)
    dish.ask("a 0 300", "MOT>")
    assert truth(dish) == before


@settings(max_examples=40, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(st.lists(st.tuples(st.floats(-400, 760), st.floats(0.0, 6.0)), max_size=8), st.integers(0, 99))
def test_the_cable_is_never_turned_beyond_its_stops(terminal, moves, seed):
    dish = at_mot(terminal, f"seed={seed}")
    for az, wait in moves:
        dish.type(f"a 0 {az:.3f}\r")
        for _ in range(5):
            dish.listen(wait / 5)
            assert LOW - 1e-9 <= truth(dish).cable_deg <= HIGH + 1e-9


@pytest.mark.parametrize(
    ("az_map", "start", "wanted", "cable"),
    [
        ("nearest", 0, 20, 20),
        ("nearest", 0, 30, -330),
        ("nearest", -350, 350, -370),
        ("home", 0, 20, -340),
        ("home", -350, 350, -10),
        ("literal", 0, 20, 20),
    ],
)
def test_turn_of_the_cable(terminal, az_map, start, wanted, cable):
    dish = at_mot(terminal, f"az_map={az_map}&az={start}")
    assert f"Angle = {wanted}.00" in dish.ask(f"a 0 {wanted}", "MOT>")
    dish.listen(8.0)
    assert truth(dish).cable_deg == pytest.approx(cable, abs=0.07)
    assert dish.angles()[0] == pytest.approx(wanted, abs=0.07)


def test_literal_angles_beyond_the_cable_are_refused(terminal):
    assert "Angle out of range.\r\n" in at_mot(terminal, "az_map=literal").ask("a 0 180", "MOT>")


def test_azimuths_outside_the_circle(terminal):
    assert "Angle = 370.00" in at_mot(terminal).ask("a 0 370", "MOT>")
    assert "out of range" in at_mot(terminal, "az_outside=0").ask("a 0 370", "MOT>")


def test_a_may_print_the_angle_of_the_cable(terminal):
    assert at_mot(terminal, "az_print=cable&az=-90").angles()[0] == -90.0


def test_signed_angles(terminal):
    dish = at_mot(terminal, "az=-90")
    dish.ask("a 0 -10", "MOT>")
    dish.ask("a 1 +5", "MOT>")
    dish.listen(3.0)
    assert dish.angles() == (pytest.approx(260, abs=0.07), pytest.approx(50, abs=0.07))
    dish = at_mot(terminal, "az=-90&signed=absolute")
    dish.ask("a 0 -10", "MOT>")
    dish.listen(3.0)
    assert dish.angles()[0] == pytest.approx(350, abs=0.07)


@pytest.mark.parametrize("el", [17.9, 65.1, 90])
def test_elevations_outside_the_limits(terminal, el):
    dish = at_mot(terminal)
    assert "Angle out of range.\r\n" in dish.ask(f"a 1 {el}", "MOT>")
    assert dish.angles()[1] == 45.0
    clamped = at_mot(terminal, "out_of_range=clamp")
    clamped.ask(f"a 1 {el}", "MOT>")
    clamped.listen(3.0)
    assert clamped.angles()[1] == pytest.approx(min(max(el, 18), 65), abs=0.07)


@pytest.mark.parametrize("words", ["a 2 10", "a 0 x", "a 0 nan", "a 0 inf", "a 0", "h 2", "h", "mv 0 5"])
def test_bad_parameters_move_nothing(terminal, words):
    dish = at_mot(terminal)
    assert dish.ask(words, "MOT>") == f"{words}\r\nInvalid parameter.\r\nMOT>"
    assert not truth(dish).moving


def test_read_outs(terminal):
    dish = at_mot(terminal)
    assert "Max Vel [0] = 65.00\r\nMax Vel [1] = 45.00\r\n" in dish.ask("mv", "MOT>")
    assert "Min: 18.00 Max: 65.00 Home: 65.00\r\n" in dish.ask("elminmaxhome", "MOT>")


def test_slower_axes(terminal):
    dish = at_mot(terminal, "az_speed=2&latency_min=0&latency_max=0")
    dish.ask("a 0 350", "MOT>")
    dish.listen(2.0)
    assert truth(dish).az_deg == pytest.approx(356, abs=0.1)


def run_second_move(terminal, policy):
    dish = at_mot(terminal, f"second_move={policy}")
    dish.ask("a 0 200", "MOT>")
    start = dish.now
    reply = dish.ask("a 0 300", "MOT>")
    return dish, reply, dish.now - start


def test_second_move_retargets(terminal):
    dish, reply, took = run_second_move(terminal, "retarget")
    assert "Angle = 300.00" in reply
    assert took < 0.1
    dish.listen(1.5)
    assert not truth(dish).moving
    assert dish.angles()[0] == pytest.approx(300, abs=0.07)


def test_second_move_queues(terminal):
    dish, reply, took = run_second_move(terminal, "queue")
    assert "Angle = 300.00" in reply
    assert took < 0.1
    dish.listen(2.5)
    assert dish.angles()[0] == pytest.approx(200, abs=2)
    dish.listen(2.5)
    assert dish.angles()[0] == pytest.approx(300, abs=0.07)


def test_motors_that_move_in_turn(terminal):
    dish = at_mot(terminal, "second_move=in_turn&overshoot=0")
    assert "Angle = 300.00" in dish.ask("a 0 300", "MOT>")
    assert "Angle = 60.00" in dish.ask("a 1 60", "MOT>")
    assert "Angle = 55.00" in dish.ask("a 1 -5", "MOT>")
    dish.ask("q", "TRK>")
    dish.ask("a3981", "A3981>")
    assert "AZ ST: HIGH EL ST: LOW" in dish.ask("st", "A3981>")
    assert truth(dish).el_deg == 45.0
    dish.listen(1.4)
    assert "AZ ST: LOW EL ST: HIGH" in dish.ask("st", "A3981>")
    dish.listen(2.0)
    assert (truth(dish).az_deg, truth(dish).el_deg) == (pytest.approx(300, abs=0.07), pytest.approx(55, abs=0.07))


def test_second_move_is_refused(terminal):
    dish, reply, took = run_second_move(terminal, "refuse")
    assert reply == "a 0 300\r\nError: motor busy.\r\nMOT>"
    assert took < 0.1
    dish.listen(3.0)
    assert dish.angles()[0] == pytest.approx(200, abs=0.07)
    assert "Angle = 300.00" in dish.ask("a 0 300", "MOT>")


def test_second_move_blocks_the_shell(terminal):
    dish, reply, took = run_second_move(terminal, "block")
    assert "Angle = 300.00" in reply
    assert took == pytest.approx(2.6, abs=0.2)
    dish.listen(2.0)
    assert dish.angles()[0] == pytest.approx(300, abs=0.07)


def test_unhomed_axes(terminal):
    dish = at_mot(terminal, "unhomed=1")
    assert not truth(dish).homed
    assert dish.ask("a", "MOT>") == "a\r\nAngle[0] = 2147483647.00\r\nAngle[1] = 2147483647.00\r\nMOT>"
    assert "Step to Position EL angle error: 2147483647\r\n" in dish.ask("a 1 40", "MOT>")
    dish.ask("h *", "MOT>")
    assert truth(dish).homed
    assert truth(dish).cable_deg == pytest.approx(0.01)


def test_a_move_of_an_unhomed_axis_may_deadlock(terminal):
    dish = at_mot(terminal, "unhomed=1&unhomed_move=deadlock")
    assert dish.ask("a 0 10") == "a 0 10\r\n"
    assert dish.ask("") == ""


@pytest.mark.parametrize("seed", range(6))
def test_homing_takes_at_most_the_boot_timeouts(terminal, seed):
    dish = at_mot(terminal, f"unhomed=1&seed={seed}")
    start = dish.now
    dish.ask("h 0", "MOT>")
    assert 0.5 < dish.now - start <= 8.0
    start = dish.now
    dish.ask("h 1", "MOT>")
    assert 0.2 < dish.now - start <= 2.0


def test_released_motors_forget_and_sag(terminal):
    dish = at_mot(terminal)
    assert dish.ask("r", "MOT>") == "r\r\nMOT>"
    dish.listen(2.0)
    now = truth(dish)
    assert now.released
    assert not now.homed
    assert now.el_deg == pytest.approx(42.0, abs=0.02)
    dish.ask("e", "MOT>")
    assert not truth(dish).released
    assert "2147483647" in dish.ask("a", "MOT>")


def test_a_firmware_that_does_not_notice_a_release(terminal):
    dish = at_mot(terminal, "release_forgets=0")
    dish.ask("r", "MOT>")
    dish.listen(2.0)
    dish.ask("e", "MOT>")
    assert dish.angles()[1] == 45.0
    assert truth(dish).el_deg == pytest.approx(42.0, abs=0.02)


def test_a_stalled_axis_stops_and_says_so(terminal):
    dish = at_mot(terminal)
    dish.ask("a 0 200", "MOT>")
    dish.listen(1.0)
    dish.device.stall(0)
    stuck = truth(dish)
    assert stuck.stalled == ("az",)
    assert dish.listen(3.0) == "AZ MOTOR STALLED\r\n"
    assert truth(dish).az_deg == stuck.az_deg
    assert dish.angles()[0] == pytest.approx(stuck.az_deg, abs=0.01)
    assert "AZ Motor Home Failure\r\n" in dish.ask("h 0", "MOT>")
    dish.device.stall(0, blocked=False)
    dish.ask("h 0", "MOT>")
    assert dish.angles()[0] == 0.01


def test_a_move_of_a_blocked_axis_says_so(terminal):
    dish = at_mot(terminal)
    dish.device.stall(0)
    assert "STALLED" not in dish.ask("a 1 50", "MOT>") + dish.listen(1.0)
    assert dish.ask("a 0 300", "MOT>") == "a 0 300\r\nAngle = 300.00\r\nMOT>"
    assert dish.listen(1.0) == "AZ MOTOR STALLED\r\n"
    assert "AZ MOTOR STALLED\r\n" in dish.ask("g 300 40", "MOT>") + dish.listen(1.0)
    dish.device.stall(0, blocked=False)
    dish.ask("a 0 300", "MOT>")
    assert dish.listen(2.0) == ""
    assert dish.angles()[0] == pytest.approx(300, abs=0.07)


def test_a_stall_that_nobody_notices_leaves_an_error(terminal):
    dish = at_mot(terminal, "stall=slip")
    dish.ask("a 1 30", "MOT>")
    dish.listen(0.2)
    dish.device.stall(1)
    stuck = truth(dish).el_deg
    dish.listen(2.0)
    assert dish.angles()[1] == pytest.approx(30, abs=0.07)
    assert truth(dish).el_deg == stuck > 31
    dish.device.stall(1, blocked=False)
    assert truth(dish).el_deg == stuck


def test_backlash_follows_late(terminal):
    dish = at_mot(terminal, "overshoot=0&backlash=0.06")
    for el, rest in ((40, 40.03), (40.02, 40.03), (45, 44.97), (44.99, 44.97), (44.9, 44.93)):
        dish.ask(f"a 1 {el}", "MOT>")
        dish.listen(2.0)
        assert truth(dish).el_deg == pytest.approx(rest, abs=0.012)


def test_mechanics_run_with_the_clock(terminal):
    dish = terminal(rate=10.0)
    dish.ask("mot", "MOT>")
    dish.ask("a 0 200", "MOT>")
    dish.listen(0.5)
    assert not truth(dish).moving


@pytest.mark.parametrize(("start", "stop"), [(0, HIGH), (-400, LOW)])
@pytest.mark.parametrize("seed", range(4))
def test_overshoot_ends_at_the_stop_of_the_cable(terminal, start, stop, seed):
    dish = at_mot(terminal, f"az_map=literal&signed=absolute&az={start}&seed={seed}")
    assert f"Angle = {stop}" in dish.ask(f"a 0 {stop}", "MOT>")
    dish.listen(3.0)
    assert LOW - 1e-9 <= truth(dish).cable_deg <= HIGH + 1e-9
    assert truth(dish).cable_deg == pytest.approx(stop, abs=0.01)


def timed(dish, line):
    start = dish.now
    reply = dish.ask(line, "MOT>")
    return reply, dish.now - start


def test_the_shell_blocks_until_the_other_axis_stands(terminal):
    """Reference 2.6: no new motor command before the current motor stops. A reading is no motor command."""
    dish = at_mot(terminal, "second_other=block")
    assert timed(dish, "a 0 200")[1] < 0.1
    assert "Angle[0] = " in dish.ask("a", "MOT>")
    reply, took_s = timed(dish, "a 1 30")
    assert "Angle = 30.00" in reply
    assert took_s == pytest.approx(2.6, abs=0.2)
    assert truth(dish).az_deg == pytest.approx(200, abs=0.07)
    assert truth(dish).el_deg == pytest.approx(45, abs=1), "elevation begins as it answers"
    assert timed(dish, "a 1 40")[1] < 0.1, "the same axis takes a new target on its way"


def test_a_shell_that_blocks_on_either_axis(terminal):
    dish = at_mot(terminal, "second_other=block&second_move=block")
    dish.ask("a 0 200", "MOT>")
    dish.ask("a 1 30", "MOT>")
    assert 0.3 < timed(dish, "a 1 60")[1] < 1.0


@pytest.mark.parametrize(
    ("style", "printed"), [("angle", "Angle = 200.00\r\n"), ("none", ""), ("np", "m 0  a 20000  np 131428\r\n")]
)
def test_what_a_move_prints(terminal, style, printed):
    dish = at_mot(terminal, f"move_reply={style}")
    assert dish.ask("a 0 200", "MOT>") == f"a 0 200\r\n{printed}MOT>"
    dish.listen(4.0)
    assert truth(dish).az_deg == pytest.approx(200, abs=0.07)
