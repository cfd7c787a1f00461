"""The consoles of the G2's kin, line by line, against docs/reference/g2-kin.md."""

from __future__ import annotations

import pytest
from birdcage.base.clock import VirtualClock
from birdcage.sim.port import SimPort, open_device


class Terminal:
    """Types lines and reads what comes back."""

    def __init__(self, address: str, end: str = "\r") -> None:
        self.clock, self.end = VirtualClock(), end
        self.device = open_device(address, clock=self.clock)
        self.port = SimPort(self.device, "terminal", baud=115200)

    def type(self, line: str, seconds: float = 0.1) -> str:
        self.port.write((line + self.end).encode())
        self.clock.advance(seconds)
        return self.port.read().decode()


def test_a_g2_plus_homes_both_axes_and_says_so_at_the_end():
    dish = Terminal("g2plus?seed=1&unhomed=1")
    assert dish.type("mot") == "mot\r\nMOT>"
    assert dish.type("h *", 30.0) == "h *\r\nAZ - Angle: 1 Wrap: 0\r\nMOT>"
    truth = dish.device.truth()
    assert (truth.homed, truth.el_deg) == (True, pytest.approx(65.0, abs=0.1))
    assert min(truth.az_deg, 360.0 - truth.az_deg) < 0.1


def test_a_g2_plus_answers_a_move_with_the_angle_before_it_is_there():
    dish = Terminal("g2plus?seed=1")
    dish.type("mot")
    assert dish.type("a 0 90.0") == "a 0 90.0\r\nAngle = 90.00\r\nMOT>"
    assert dish.device.truth().moving
    dish.clock.advance(10.0)
    assert dish.device.truth().az_deg == pytest.approx(90.0, abs=0.1)


@pytest.mark.parametrize(("bare", "answer"), [
    ("angles", "Angle[0] = 0.00\r\nAngle[1] = 45.00\r\n"), ("error", "Invalid parameter.\r\n"), ("nothing", ""),
    ("target", "Angle = 0.00\r\n"),
])  # fmt: skip
def test_what_a_bare_a_is_answered_with_is_open(bare, answer):
    dish = Terminal(f"g2plus?seed=1&bare_a={bare}")
    dish.type("mot")
    assert dish.type("a") == f"a\r\n{answer}MOT>"


def test_row_20_is_that_of_the_tv_search_and_counts_from_the_next_power_up():
    dish = Terminal("g2plus?seed=1&homes_at_boot=1")
    dish.type("nvs")
    assert " 20) Disable Tracker Proc?" in dish.type("d")
    assert dish.type("e 20 1").split() == ["e", "20", "1", "20)", "Disable", "Tracker", "Proc?", "FALSE", ".", "TRUE",
                                           "NVS>"]  # fmt: skip
    assert "doneSuccess" in dish.type("s", 2.0)
    dish.device.power_cycle()
    dish.clock.advance(60.0)
    assert not dish.device.truth().homed, "with the search off it does not home by itself"


def test_one_with_its_search_on_homes_at_power_up():
    dish = Terminal("g2plus?seed=1&boot=1&homes_at_boot=1")
    dish.clock.advance(60.0)
    assert dish.device.truth().homed
    assert dish.port.read().decode().endswith("AZ - Angle: 1 Wrap: 0\r\nTRK>")


def test_an_x1_homes_one_axis_at_a_time_and_its_azimuth_ends_at_0():
    dish = Terminal("pathway-x1?seed=1&unhomed=1")
    dish.type("mot")
    assert dish.type("h 0", 10.0).endswith("MOT>")
    assert dish.type("h 1", 10.0).endswith("MOT>")
    truth = dish.device.truth()
    assert (truth.homed, min(truth.az_deg, 360.0 - truth.az_deg) < 0.1) == (True, True)


def test_an_x1_has_no_menu_that_no_source_has_seen():
    assert "Invalid command." in Terminal("pathway-x1?seed=1").type("nvs")


def test_an_x2_answers_with_motor_hundredths_and_steps():
    dish = Terminal("pathway-x2?seed=1&lag_max_s=0", "\r\n")
    assert dish.type("mot") == "mot\r\nMOT>"
    assert dish.type("") == "\r\nMOT>"
    assert dish.type("a 0 170.00") == "a 0 170.00\r\nm 0  a 17000  np 111714\r\nMOT>"
    assert "m 1  a 4500  np " in dish.type("a 1 45.00")
    dish.clock.advance(10.0)
    assert dish.device.truth().az_deg == pytest.approx(170.0, abs=0.1)


@pytest.mark.parametrize(("ack", "answered"), [("executed", False), ("at_once", True)])
def test_an_x2_waits_before_it_executes_and_answers_then_or_at_once(ack, answered):
    dish = Terminal(f"pathway-x2?seed=1&lag_min_s=14.9&lag_max_s=14.9&lag_ack={ack}", "\r\n")
    dish.type("mot")
    assert ("m 0  a 17000" in dish.type("a 0 170.00", 14.0)) is answered
    assert not dish.device.truth().moving
    dish.clock.advance(1.0)
    assert dish.device.truth().moving
    dish.clock.advance(10.0)
    assert dish.device.truth().az_deg == pytest.approx(170.0, abs=0.1)


@pytest.mark.parametrize("ack", ["executed", "at_once"])
def test_an_x2_waits_before_it_homes(ack):
    dish = Terminal(f"pathway-x2?seed=1&unhomed=1&lag_min_s=14.9&lag_max_s=14.9&lag_ack={ack}", "\r\n")
    dish.type("mot")
    assert dish.type("h 0", 14.0) == "h 0\r\n"
    assert not dish.device.truth().moving
    assert "MOT>" in dish.type("", 12.0)


def test_the_wait_of_an_x2_is_another_one_each_time():
    dish = Terminal("pathway-x2?seed=1", "\r\n")
    dish.type("mot")
    waits = []
    for azimuth in (10, 20, 30, 40, 50):
        dish.type(f"a 0 {azimuth}", 0.0)
        waited = 0.0
        while "MOT>" not in dish.port.read().decode() and waited < 20.0:
            dish.clock.advance(0.1)
            waited += 0.1
        waits.append(waited)
    assert max(waits) <= 15.2
    assert len({round(each, 1) for each in waits}) == len(waits)
