"""How long a command waits before the dish tells its settings, and what it leaves for the next, on the dish's clock."""

from __future__ import annotations

import pytest
from birdcage.console.codec import MARK
from birdcage.station.requests import Watch
from birdcage.station.session import Session
from birdcage.station.state import LinkPhase
from birdcage.station.station import Station

from .conftest import Bench

DISHES = [("g2?seed=1", "g2", 115200, 0.5), ("hal205?seed=1&search_finds=0", "hal205", 57600, 2.5)]
"""Address, firmware, rate, and the most simulated seconds until its settings are read."""


class Commands(Bench):
    """One dish, asked by one program after the other."""

    def run(self, *, survey: bool) -> tuple[float, list[str]]:
        """Run a command; return how long it took on the dish's clock, and its lines."""
        began, before = self.clock.monotonic(), len(self.received())
        settings = self.station.settings
        self.station = Station(self.clock, settings)
        self.session = Session(self.clock, self.station)
        self.station.submit(Watch("test", frozenset({"position"})))
        while self.state.link.state is not LinkPhase.UP or (survey and not self.state.surveyed):
            self.step(0.01)
            assert self.clock.monotonic() - began < 30.0
        took_s = self.clock.monotonic() - began
        self.session.close()
        self.clock.advance(0.5)
        return took_s, self.lines()[before:]


@pytest.mark.parametrize(("address", "firmware", "baud", "most_s"), DISHES)
def test_no_command_waits_for_a_quiet_line_whatever_the_last_one_left(address, firmware, baud, most_s):
    dish = Commands(address, {"baud": baud}, firmware=firmware)
    for survey in (True, True, False, True):
        took_s, lines = dish.run(survey=survey)
        assert took_s < most_s, (survey, took_s, lines)
        assert lines.count(MARK) <= 1
        assert dish.device.shell.menu in ("root", "mot", "motor"), lines


@pytest.mark.parametrize(("menu", "firmware"), [("mot", "g2"), ("os", "g2"), ("nvs", "g2"), ("motor", "hal205")])
def test_a_dish_that_was_left_in_a_menu_costs_the_next_command_nothing(menu, firmware):
    address, _, baud, most_s = next(each for each in DISHES if each[1] == firmware)
    dish = Commands(address, {"baud": baud}, firmware=firmware)
    dish.device.shell.menu = menu
    took_s, lines = dish.run(survey=True)
    assert took_s < most_s + 1.0, lines


def test_the_settings_count_as_read_only_when_the_dish_is_back_in_its_motor_menu():
    dish = Commands("g2?seed=1", {})
    dish.watch("position")
    while not dish.state.surveyed:
        dish.step(0.001)
        assert dish.clock.monotonic() < 1010.0
    assert dish.device.shell.menu == "mot"
