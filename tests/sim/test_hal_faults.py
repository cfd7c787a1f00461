"""Bad days, for all firmwares where they are alike."""

from __future__ import annotations

import pytest
from birdcage.base.clock import VirtualClock
from birdcage.sim.control import obey
from birdcage.sim.hal.knobs import HalSettings
from birdcage.sim.port import open_device
from birdcage.sim.settings import option_names


@pytest.fixture
def motor(hal):
    def start(options=""):
        dish = hal(options)
        dish.ask("motor", "MOT>")
        return dish

    return start


@pytest.mark.parametrize(("index", "name", "line"), [(0, "AZ", "a 0 300"), (1, "EL", "a 1 70"), (2, "SK", "a 2 10")])
@pytest.mark.parametrize("told", [True, False])
def test_a_stall_of_each_axis(motor, index, name, line, told):
    dish = motor(f"stall_text={int(told)}")
    dish.ask(line, "MOT>")
    dish.listen(2.0)
    dish.device.stall(index)
    assert dish.listen(1.0) == (f"{name} MOTOR STALLED\r\n" if told else "")
    truth = dish.device.truth()
    assert (truth.stalled, truth.moving) == ((name.lower(),), False)
    heard = dish.ask(line, "MOT>") + dish.listen(1.0)  # pushed again
    assert (f"{name} MOTOR STALLED" in heard) is told
    dish.device.stall(index, blocked=False)
    dish.ask(line, "MOT>")
    dish.listen(1.0)
    assert dish.device.truth().moving


def test_after_a_stall_the_move_that_waits_begins(motor):
    dish = motor()
    dish.ask("a 0 300", "MOT>")
    dish.ask("a 1 60", "MOT>")
    dish.listen(2.0)
    dish.device.stall(0)
    dish.listen(1.0)
    assert dish.device.truth().el_deg > 45.5


def test_steps_that_are_lost_unnoticed(motor):
    dish = motor("stall=slip")
    dish.ask("a 0 300", "MOT>")
    dish.listen(2.0)
    dish.device.stall(0)
    dish.listen(30.0)
    assert "AZ = 300.00" in dish.ask("a", "MOT>")
    assert dish.device.truth().az_deg < 230.0


def test_running_into_a_hard_stop_is_a_stall(motor):
    dish = motor("el_max=120")
    dish.ask("a 1 110", "MOT>")
    assert "EL MOTOR STALLED" in dish.listen(30.0)
    assert dish.device.truth().el_deg == pytest.approx(93.0, abs=0.02)
    dish.ask("a 0 190", "MOT>")
    dish.listen(10.0)
    assert dish.device.truth().az_deg == pytest.approx(190.0)


def test_a_reboot_in_mid_move_homes_again(motor):
    dish = motor("boot_home_s=20")
    dish.ask("a 0 300", "MOT>")
    dish.ask("a 1 70", "MOT>")
    dish.listen(2.0)
    dish.device.reboot()
    now = dish.device.truth()
    assert (now.homed, now.moving, now.menu) == (False, False, "root")
    log = dish.listen(60.0)
    assert log.startswith("HAL 2.05.003\r\n")
    assert dish.device.truth().homed
    assert dish.device.truth().el_deg < 70.0  # what waited is forgotten


@pytest.mark.parametrize("quiet", [False, True])
def test_a_brown_out_forgets_homing_and_the_search(hal, quiet):
    dish = hal("searching=1&search_finds=0")
    dish.listen(10.0)
    dish.device.brown_out(quiet=quiet)
    log = dish.listen(60.0)
    assert ("HAL 2.05.003" in log) is not quiet
    assert "calibrating" not in log
    truth = dish.device.truth()
    assert (truth.homed, truth.moving, truth.menu) == (False, False, "root")
    assert not dish.device.firmware.search.running
    dish.ask("motor", "MOT>")
    assert "AZ = 2147483647.00" in dish.ask("a", "MOT>")
    assert "Motor not calibrated." in dish.ask("a 0 100", "MOT>")
    assert "Motor not calibrated." in dish.ask("g 100 40 90", "MOT>")
    assert dish.listen(60.0) == ""
    assert dish.device.truth().az_deg == truth.az_deg


def test_a_brown_out_forgets_the_moves_that_wait(motor):
    dish = motor()
    dish.ask("a 0 300", "MOT>")
    dish.ask("a 1 70", "MOT>")
    dish.listen(2.0)
    dish.device.brown_out()
    dish.listen(60.0)
    assert dish.device.truth().el_deg == 45.0


def test_unhomed_moves_may_deadlock(motor):
    dish = motor("unhomed=1&unhomed_move=deadlock")
    dish.ask("a 0 100")
    assert not dish.device.truth().shell_alive
    assert dish.ask("") == ""


def test_a_deadlocked_shell_leaves_the_motors_to_their_queue(motor):
    dish = motor()
    dish.ask("a 0 200", "MOT>")
    dish.ask("a 1 60", "MOT>")
    dish.device.deadlock()
    assert dish.ask("a") == ""
    dish.listen(30.0)
    truth = dish.device.truth()
    assert (truth.az_deg, truth.el_deg) == pytest.approx((200.0, 60.0))


@pytest.mark.parametrize("firmware", ["carryout", "g2", "hal000", "hal205"])
class TestAll:
    """What the control port does to any of them."""

    def test_wander(self, firmware):
        clock = VirtualClock()
        device = open_device(f"{firmware}?az={-90 if firmware == 'g2' else 200}", clock=clock)
        before = device.truth()
        obey(device, {"do": "wander", "axis": 1, "by_deg": -10})
        assert device.truth().moving
        clock.advance(20.0)
        assert device.truth().el_deg == pytest.approx(before.el_deg - 10, abs=0.1)
        obey(device, {"do": "wander", "by_deg": 30})
        clock.advance(20.0)
        assert device.truth().az_deg == pytest.approx(before.az_deg + 30, abs=0.1)

    def test_wander_turns_the_other_way_where_the_range_ends(self, firmware):
        clock = VirtualClock()
        device = open_device(f"{firmware}?el=60", clock=clock)
        obey(device, {"do": "wander", "axis": 1, "by_deg": 40})
        clock.advance(20.0)
        assert device.truth().el_deg == pytest.approx(20.0, abs=0.1)

    def test_a_brown_out(self, firmware):
        clock = VirtualClock()
        device = open_device(firmware, clock=clock)
        assert device.truth().homed
        obey(device, {"do": "brown_out", "quiet": True})
        clock.advance(60.0)
        truth = device.truth()
        assert (truth.homed, truth.moving, truth.shell_alive, truth.powered) == (False, False, True, True)
        assert not device.inbox

    def test_a_line_that_nobody_asked_for(self, firmware):
        device = open_device(firmware, clock=VirtualClock())
        obey(device, {"do": "say", "text": "Hello"})
        assert device.inbox.popleft()[1] == b"Hello\r\n"
        device.deadlock()
        obey(device, {"do": "say", "text": "Hello"})
        assert not device.inbox

    def test_axes_that_there_are(self, firmware):
        device = open_device(firmware, clock=VirtualClock())
        for what in ("stall", "wander"):
            with pytest.raises(ValueError, match=r"axis is 0 \(azimuth\) or 1"):
                obey(device, {"do": what, "axis": 3})
        if firmware.startswith("hal"):
            obey(device, {"do": "stall", "axis": 2})
            assert device.truth().stalled == ("sk",)
            assert obey(device, {"do": "truth"})["truth"]["skew_deg"] == 90.0
        else:
            with pytest.raises(ValueError, match="axis is 0"):
                obey(device, {"do": "stall", "axis": 2})
            assert obey(device, {"do": "truth"})["truth"]["skew_deg"] is None

    def test_power(self, firmware):
        clock = VirtualClock()
        device = open_device(f"{firmware}?az={-90 if firmware == 'g2' else 200}", clock=clock)
        device.power_off()
        before = device.truth()
        assert (before.powered, before.shell_alive, before.homed) == (False, False, False)
        device.receive(b"\r")
        clock.advance(100.0)
        assert not device.inbox
        obey(device, {"do": "power_on"})
        clock.advance(1.0)
        device.truth()
        assert device.inbox


def test_every_choice_opens(hal):
    for name, values in HalSettings.choices.items():
        assert name in option_names(HalSettings)
        assert getattr(HalSettings(), name) in values
        for value in values:
            assert hal(f"{name}={value}").ask("").endswith(">")


def test_the_same_seed_gives_the_same_dish(hal):
    def session(seed):
        dish = hal(f"seed={seed}&drop=0.02&boot=1&boot_home_s=10")
        return dish.listen(60) + dish.ask("motor") + dish.ask("a 1 3") + dish.listen(60) + dish.ask("a")

    assert session(4) == session(4)
    assert session(4) != session(5)


def test_an_option_of_the_other_firmware_is_refused():
    with pytest.raises(ValueError, match="the simulated hal205 has no option 'nvs20'"):
        open_device("hal205?nvs20=1", clock=VirtualClock())
    with pytest.raises(ValueError, match="the simulated g2 has no option 'prompts'"):
        open_device("g2?prompts=alike", clock=VirtualClock())
