"""What the menus of a relative of the G2 share: motors, knobs, the time, and the settings of one that has them."""

from __future__ import annotations

from collections.abc import Callable

from birdcage.sim.chance import seeded
from birdcage.sim.machine import Machine
from birdcage.sim.trk.kin_knobs import KinSettings
from birdcage.sim.trk.mechanics import TrkDish
from birdcage.sim.trk.nvram import Nvram, NvramSetting

TRACKER = 20
ROWS = {TRACKER: NvramSetting("Disable Tracker Proc?", "bool", 0)}
"""The one row that its owner wrote of (docs/reference/g2-kin.md, *Settings*); there are others, unknown ones."""
_SPEEDS = 65.0, 400.0, 45.0, 65.0
"""Azimuth speed and acceleration, elevation speed, and elevation after homing: those of a G2 (assumed)."""


class KinBoard:
    """The processor board, as far as its console shows it."""

    def __init__(self, settings: KinSettings, machine: Machine, dish: TrkDish, reboot: Callable[[], None]) -> None:
        self.settings = settings
        self.machine = machine
        self.dish = dish
        self.reboot = reboot
        self.at_power_on: list[Callable[[], None]] = []
        """What forgets as well when the power goes."""
        self.nvram = Nvram(ROWS, {TRACKER: float(not settings.homes_at_boot)})
        self.sent_deg = 0.0
        """Where the azimuth was last sent."""
        self._rng = seeded("lag", settings.seed)
        self.power_on()

    @property
    def now_s(self) -> float:
        """Dish time."""
        return self.machine.dish_s

    @property
    def homes_by_itself(self) -> bool:
        """Whether it homes at power-up: as its settings say, where it has any."""
        if "nvs" in self.settings.menu_words:
            return not self.nvram.active[TRACKER]
        return self.settings.homes_at_boot

    def bounds(self, index: int) -> tuple[float, float]:
        """Return the lowest and highest count that the firmware allows, in degrees."""
        data = self.dish.axes[index].data
        return (self.settings.low_el, self.settings.high_el) if index == 1 else (data.low_deg, data.high_deg)

    def referenced(self, index: int) -> str:
        """Tell of the azimuth where it stands."""
        if index != 0:
            return ""
        axis = self.dish.axes[0]
        low, high = (round(deg * 100) for deg in self.bounds(0))
        wrap = f"wrap_min:{low} wrap_max:{high}\n" if self.settings.wrap_line else ""
        return f"{wrap}AZ - Angle: {round(axis.count(self.now_s)[0] * 100)} Wrap: 0\n"

    def lag_s(self) -> float:
        """Return how long this command waits before it is executed."""
        return self._rng.uniform(self.settings.lag_min_s, max(self.settings.lag_min_s, self.settings.lag_max_s))

    def power_on(self) -> None:
        """Read the settings memory; what was only in RAM is gone."""
        self.nvram.power_on()
        for forget in self.at_power_on:
            forget()
        self.dish.set_speeds(*_SPEEDS)
        for axis in self.dish.axes:
            if not axis.homed:
                axis.redefine(self.now_s, 0.0)
