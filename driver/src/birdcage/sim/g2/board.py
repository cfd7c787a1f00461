"""What the menus of a G2 share: the dish, the settings memory, the knobs, and the time."""

from __future__ import annotations

import math
from collections.abc import Callable
from datetime import timedelta

from birdcage.sim.g2.knobs import G2Settings
from birdcage.sim.g2.mechanics import G2Dish
from birdcage.sim.g2.nvram import Nvram
from birdcage.sim.g2.tuner import Tuner
from birdcage.sim.machine import Machine
from birdcage.sim.sky import Sky

INT_MAX = 2147483647
"""What an axis reports, and `scan` aims at, until it is homed (section 7.2, [S1])."""
GAINS = 250.0, 50.0
"""Kp and Kv of the stepper menu after power-on (section 7.3, [S1])."""


class Board:
    """The G2's processor board, as far as its console shows it."""

    def __init__(self, settings: G2Settings, machine: Machine, dish: G2Dish, reboot: Callable[[], None]) -> None:
        self.settings = settings
        self.machine = machine
        self.dish = dish
        self.reboot = reboot
        """Start over, as the command `reboot` does; the running command never returns."""
        self.at_power_on: list[Callable[[], None]] = []
        """What forgets as well when the power goes: a menu that keeps something in RAM puts its own in here."""
        self.sky = Sky(settings)
        self.tuner = Tuner(self)
        self.nvram = Nvram()
        self.nvram.write(20, str(int(settings.nvs20)))
        self.nvram.save()
        self.power_on()

    @property
    def now_s(self) -> float:
        """Dish time."""
        return self.machine.dish_s

    def level(self, dish_s: float, az_deg: float, el_deg: float) -> float:
        """Return the noise-free level in counts at an instant of dish time, with the dish at its own az and el."""
        clock = self.machine.clock
        when = clock.utc() + timedelta(seconds=dish_s - clock.monotonic() * clock.rate)
        return self.sky.level(when, az_deg + self.settings.heading, el_deg)

    def power_on(self) -> None:
        """Read the settings memory and go by it from now on."""
        self.nvram.power_on()
        row = self.nvram.active
        self.gains = GAINS
        self.tuner.power_on()
        for forget in self.at_power_on:
            forget()
        self.dish.set_speeds(row[80], row[81], row[85], row[103])


def number(text: str) -> float | None:
    """Read a finite number as the firmware would; None when it is none."""
    try:
        value = float(text)
    except ValueError:
        return None
    return value if math.isfinite(value) else None
