"""Boot, homing and the TV search of a Trav'ler."""

from __future__ import annotations

import pytest
from birdcage.base.clock import VirtualClock
from birdcage.sim.port import open_port


def truth(dish):
    return dish.device.truth()


def test_it_starts_homed_and_at_rest_with_its_search_ended(hal):
    dish = hal()
    before = truth(dish)
    assert (before.homed, before.moving, before.az_deg, before.el_deg, before.skew_deg) == (True, False, 180, 45, 90)
    assert dish.listen(600.0) == ""
    assert truth(dish) == before


def test_homing_takes_its_time_then_the_dish_moves_by_itself(hal):
    dish = hal("boot=1&boot_home_s=60&search_finds=0")
    assert not truth(dish).homed
    assert "No LNB Voltage" not in dish.listen(55.0)
    log = dish.listen(10.0)
    assert log.endswith("No LNB Voltage\r\nTRK>")
    assert truth(dish).homed
    places = set()
    for _ in range(20):
        dish.listen(5.0)
        places.add(round(truth(dish).az_deg))
    assert max(places) - min(places) > 200


def test_one_with_a_gps_names_no_line_of_the_two(hal):
    log = hal("boot=1&boot_home_s=20&boot_line=none").listen(60.0)
    assert "NoGPS" not in log
    assert "No LNB" not in log
    assert log.endswith("TRK>")


def test_the_search_is_stopped_and_stays_so(hal):
    dish = hal("searching=1&search_finds=0")
    dish.listen(10.0)
    assert truth(dish).moving
    assert dish.ask("ngsearch", "NGSEARCH>") == "ngsearch\r\nNGSEARCH>"
    assert "q\r\n" in dish.ask("?", "NGSEARCH>")
    assert dish.ask("s", "NGSEARCH>") == "s\r\nSearch stopped.\r\nNGSEARCH>"
    assert dish.ask("q", "TRK>") == "q\r\nTRK>"
    dish.listen(1.0)
    rested = truth(dish)
    assert not rested.moving
    dish.listen(300.0)
    assert truth(dish) == rested


def test_leaving_the_menu_without_s_stops_nothing(hal):
    dish = hal("searching=1&search_finds=0")
    dish.ask("ngsearch", "NGSEARCH>")
    dish.ask("q", "TRK>")
    dish.listen(60.0)
    assert truth(dish).moving


def test_it_ends_at_a_satellite(hal):
    dish = hal("searching=1&found_text=Locked")
    assert "Locked\r\n" in dish.listen(600.0)
    found = truth(dish)
    assert not found.moving
    sky = dish.device.board
    assert sky.above_floor_counts(dish.device.machine.dish_s, found.az_deg, found.el_deg) > 70


def test_a_move_has_its_turn_and_the_search_goes_on(hal):
    dish = hal("searching=1&search_finds=0")
    dish.ask("motor", "MOT>")
    dish.listen(15.0)
    dish.ask("a 1 80", "MOT>")
    highest = 0.0
    for _ in range(100):
        dish.listen(0.5)
        highest = max(highest, truth(dish).el_deg)
    assert highest == pytest.approx(80.0, abs=0.5)
    assert truth(dish).el_deg < 40.0
    assert truth(dish).moving


def test_s_lets_a_move_that_waits_begin_at_once(hal):
    dish = hal("searching=1&search_finds=0&el=15")
    dish.ask("motor", "MOT>")
    dish.ask("a 1 80", "MOT>")
    dish.ask("q", "TRK>")
    dish.ask("ngsearch", "NGSEARCH>")
    dish.ask("s", "NGSEARCH>")
    dish.listen(3.0)
    assert truth(dish).el_deg > 16.0
    dish.listen(30.0)
    assert truth(dish).el_deg == pytest.approx(80.0)
    assert not truth(dish).moving


def test_s_leaves_a_move_that_somebody_ordered(hal):
    dish = hal("searching=1&search_finds=0&el=15")
    dish.ask("motor", "MOT>")
    dish.ask("a 1 80", "MOT>")
    dish.ask("q", "TRK>")
    dish.ask("ngsearch", "NGSEARCH>")
    while truth(dish).el_deg < 30.0:
        dish.listen(0.5)
    dish.ask("s", "NGSEARCH>")
    dish.listen(30.0)
    assert truth(dish).el_deg == pytest.approx(80.0)


def test_a_reboot_during_g_does_not_keep_the_search_from_moving(hal):
    dish = hal("boot_home_s=20&search_finds=0")
    dish.ask("motor", "MOT>")
    dish.type("g 300 60 90\r")
    dish.listen(2.0)
    dish.device.reboot()
    assert "No LNB Voltage" in dish.listen(60.0)
    assert truth(dish).moving


def test_every_sweep_may_be_told(hal):
    assert hal("searching=1&search_finds=0&search_text=Sweep").listen(120.0).count("Sweep\r\n") >= 4


def test_a_failed_homing_leaves_it_unhomed_and_at_rest(hal):
    dish = hal("boot=1&boot_home_s=20&home_fails=1")
    log = dish.listen(100.0)
    assert "EL Motor Home Failure\r\n" in log
    assert not truth(dish).homed
    assert truth(dish).az_homed
    assert not truth(dish).moving
    dish.ask("motor", "MOT>")
    assert "EL = 2147483647.00" in dish.ask("a", "MOT>")
    assert "Motor not calibrated." in dish.ask("a 1 40", "MOT>")
    assert "OK" in dish.ask("a 0 40", "MOT>")
    assert "Home Failure" not in hal("boot=1&boot_home_s=20&home_fails=1&stall_text=0").listen(100.0)


def test_an_axis_that_is_blocked_fails_to_home(hal):
    dish = hal("boot=1&boot_home_s=20")
    dish.device.stall(0)
    assert "AZ Motor Home Failure\r\n" in dish.listen(100.0)
    assert not truth(dish).az_homed


@pytest.mark.parametrize("q", ["error", "ignore", "kill"])
def test_q_at_the_root(hal, q):
    dish = hal(f"root_q={q}")
    answer = dish.ask("q")
    assert ("Invalid command." in answer) is (q == "error")
    assert truth(dish).shell_alive is (q != "kill")


def test_prompts_that_are_all_alike(hal):
    dish = hal("prompts=alike")
    for line in ("", "motor", "q", "ngsearch", "q", "nvs"):
        assert dish.ask(line) == f"{line}\r\n>"
    assert truth(dish).menu == "nvs"


def test_prompts_of_ones_own(hal):
    dish = hal("prompt_root=HAL>&prompt_motor=Motor:")
    assert dish.ask("motor") == "motor\r\nMotor:"
    assert dish.ask("q") == "q\r\nHAL>"


def test_it_speaks_at_57600():
    for baud, heard in ((57600, b"\r\nTRK>"), (115200, b"")):
        clock = VirtualClock()
        port = open_port("hal205", clock=clock, baud=baud)
        port.write(b"\r")
        clock.advance(1.0)
        assert port.read() == heard


def test_the_settings_memory(hal):
    dish = hal("below_floor=refuse")
    dish.ask("nvs", "NVS>")
    assert [line.split()[0] for line in dish.ask("d", "NVS>").splitlines()[1:3]] == ["125)", "127)"]
    assert dish.ask("d 127", "NVS>").splitlines()[1].endswith("15.00")
    assert dish.ask("e 127 0", "NVS>").splitlines()[1].endswith("0.00")
    for bad in ("e 126", "e 127 x", "d 1", "e", "e 125 1 2"):
        assert "Invalid parameter." in dish.ask(bad, "NVS>")

    def low(dish):
        dish.ask("q", "TRK>")
        dish.ask("motor", "MOT>")
        return dish.ask("a 1 5", "MOT>").splitlines()[1]

    assert low(dish) == "Angle out of range."  # not before the next start
    dish.device.power_cycle()
    dish.listen(200.0)
    assert low(dish) == "Angle out of range."  # it was not saved
    dish.ask("q", "TRK>")
    dish.ask("nvs", "NVS>")
    for line in ("e 125 0", "e 127 0", "s"):
        dish.ask(line, "NVS>")
    dish.ask("q", "TRK>")
    dish.ask("reboot", "TRK>", within=200.0)
    assert low(dish) == "OK"


@pytest.mark.parametrize("rate", [1.0, 3.0, 19.7])
def test_a_search_with_blocked_motors_takes_its_time(hal, rate):
    dish = hal("searching=1&search_finds=0&search_text=Sweep", rate=rate)
    for axis in (0, 1):
        dish.device.stall(axis)
    assert 5 <= dish.listen(60.0 / rate).count("Sweep\r\n") <= 13
    assert truth(dish).shell_alive
