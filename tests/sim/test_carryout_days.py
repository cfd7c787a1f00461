"""Boot, homing, search and bad days of a Carryout of 2003."""

from __future__ import annotations

import pytest
from birdcage.base.clock import VirtualClock
from birdcage.sim.carryout.knobs import CarryoutSettings
from birdcage.sim.port import open_port
from birdcage.sim.settings import option_names


def truth(dish):
    return dish.device.truth()


def test_it_starts_homed_at_rest_and_silent(carryout):
    dish = carryout()
    before = truth(dish)
    assert (before.homed, before.moving, before.az_deg, before.el_deg, before.skew_deg) == (True, False, 180, 45, None)
    assert dish.listen(600.0) == ""
    assert truth(dish) == before


def test_power_up_homes_and_searches_for_10_to_15_minutes(carryout):
    dish = carryout("boot=1")
    powered = dish.now
    assert not truth(dish).homed
    assert "EL calibrating" in dish.listen(30.0)
    dish.listen(40.0)
    assert truth(dish).homed
    began, places = dish.now, set()
    while truth(dish).moving or dish.now - began < 60.0:
        dish.listen(5.0)
        places.add(round(truth(dish).az_deg))
        assert dish.now - powered < 1000.0
    assert 600.0 < dish.now - powered < 900.0
    assert max(places) - min(places) > 300
    dish.listen(600.0)
    assert not truth(dish).moving


def test_the_search_may_be_off_by_its_switches(carryout):
    dish = carryout("boot=1&search=0")
    dish.listen(100.0)
    assert truth(dish).homed
    assert not truth(dish).moving


def test_disabling_tracking_disables_homing_with_it(carryout):
    dish = carryout("tracking_row=20")
    dish.ask("nvs")
    dish.ask("e 20 1")
    dish.ask("s")
    dish.device.power_cycle()
    dish.listen(300.0)
    assert not truth(dish).homed
    assert not truth(dish).moving
    dish.ask("target")
    assert "Not calibrated." in dish.ask("g 180 45")
    deadlocked = carryout("unhomed=1&unhomed_move=deadlock")
    deadlocked.ask("target")
    deadlocked.ask("g 180 45")
    assert not truth(deadlocked).shell_alive


@pytest.mark.parametrize(("policy", "said", "there"), [("end", "", True), ("refuse", "Motors busy.", False)])
def test_a_move_while_it_searches(carryout, policy, said, there):
    dish = carryout(f"searching=1&search_move={policy}")
    dish.listen(15.0)
    dish.ask("target")
    dish.type("g 100 40\r")
    heard = dish.listen(60.0)
    assert said in heard
    assert ((truth(dish).az_deg, truth(dish).el_deg) == (100.0, 40.0)) is there
    assert dish.device.firmware.search.running is not there


@pytest.mark.parametrize("kills", [True, False])
def test_a_process_may_be_quit(carryout, kills):
    dish = carryout(f"searching=1&os_kills={int(kills)}")
    dish.listen(10.0)
    dish.ask("os", "OS>")
    assert "Search" in dish.ask("tasks", "OS>")
    dish.ask("kill Search", "OS>")
    dish.listen(5.0)
    assert truth(dish).moving is not kills
    assert ("Search" in dish.ask("tasks", "OS>")) is not kills


def test_a_blocked_axis_stops_and_may_say_so(carryout):
    dish = carryout("stall_text=STALL")
    dish.ask("target")
    dish.type("g 300 45\r")
    dish.listen(2.0)
    dish.device.stall(0)
    assert dish.listen(5.0).count("STALL\r\n") == 1
    stopped = truth(dish)
    assert (stopped.stalled, stopped.moving) == (("az",), False)
    assert "STALL" in dish.ask("g 310 45") + dish.listen(3.0)
    dish.device.stall(0, blocked=False)
    dish.ask("g 320 45")
    dish.listen(10.0)
    assert truth(dish).az_deg == pytest.approx(320.0, abs=0.01)


def test_steps_that_are_lost_unnoticed_are_told_all_the_same(carryout):
    dish = carryout("stall=slip")
    dish.ask("target")
    dish.type("g 300 45\r")
    dish.listen(2.0)
    dish.device.stall(0)
    assert "az = 30000   el = 4500" in dish.listen(20.0)
    assert truth(dish).az_deg < 240.0


def test_running_into_a_hard_stop_is_a_stall(carryout):
    dish = carryout("el_max=120&stall_text=STALL")
    dish.ask("target")
    dish.type("g 180 110\r")
    assert "STALL" in dish.listen(20.0)
    assert truth(dish).el_deg == pytest.approx(92.0, abs=0.02)


def test_a_failed_homing_leaves_it_unhomed(carryout):
    dish = carryout("boot=1&home_fails=1")
    dish.listen(300.0)
    assert (truth(dish).homed, truth(dish).az_homed, truth(dish).moving) == (False, True, False)


def test_losing_its_power_in_mid_move_ends_the_records(carryout):
    dish = carryout("search=0&boot_text=0&second_move=queue")
    dish.ask("target")
    dish.type("g 300 45\r")
    dish.listen(2.0)
    dish.type("g 20 45\r")
    dish.listen(1.0)
    dish.device.power_cycle()
    assert "az =" not in dish.listen(100.0)
    assert (truth(dish).homed, truth(dish).menu) == (True, "root")
    assert truth(dish).az_deg == pytest.approx(0.0)  # the move that waited is forgotten


def test_it_speaks_at_57600():
    for baud, heard in ((57600, b"\r\nTRK>"), (115200, b"")):
        clock = VirtualClock()
        port = open_port("carryout", clock=clock, baud=baud)
        port.write(b"\r")
        clock.advance(1.0)
        assert port.read() == heard


def test_bytes_cross_a_slow_wire_one_by_one(carryout):
    dish = carryout("pace_baud=57600")
    start = dish.now
    assert dish.ask("target", "TARGET>") == "target\r\nTARGET>"
    assert dish.now - start > 0.004


def test_every_choice_opens_and_moves(carryout):
    for name, values in CarryoutSettings.choices.items():
        assert name in option_names(CarryoutSettings)
        assert getattr(CarryoutSettings(), name) in values
        for value in values:
            dish = carryout(f"{name}={value}")
            dish.ask("target")
            dish.type("g 170 40\r")
            dish.listen(20.0)
            assert truth(dish).az_deg == 170.0, f"{name}={value}"


def test_the_same_seed_gives_the_same_dish(carryout):
    def session(seed):
        dish = carryout(f"seed={seed}&drop=0.02&boot=1&boot_home_s=10")
        return dish.listen(60) + dish.ask("target") + dish.ask("g 30 30") + dish.listen(60)

    assert session(4) == session(4)
    assert session(4) != session(5)
