"""What the menus of a G2 share: the dish, the settings memory, the knobs, and the time."""

from __future__ import annotations

import math
from collections.abc import Callable
from datetime import timedelta

from birdcage.sim.chance import seeded
from birdcage.sim.g2.knobs import G2Settings
from birdcage.sim.g2.mechanics import G2Dish
from birdcage.sim.g2.nvram import AZ_GAINS, EL_GAINS, g2_nvram
from birdcage.sim.g2.sleep import Sleep
from birdcage.sim.g2.tuner import SimTuner
from birdcage.sim.machine import Machine
from birdcage.sim.sky import SimSky
from birdcage.sim.stance import Stance

ADC_NOISE_COUNTS = 1.5
"""Standard deviation of one raw reading: 233 to 238 over the empty sky (noted: docs/reference/g2-signal.md,
*Levels*)."""


class G2Board:
    """The G2's processor board, as far as its console shows it."""

    def __init__(self, settings: G2Settings, machine: Machine, dish: G2Dish, reboot: Callable[[], None]) -> None:
        self.settings = settings
        self.machine = machine
        self.dish = dish
        self.reboot = reboot
        """Start over, as the command `reboot` does; the running command never returns."""
        self.at_power_on: list[Callable[[], None]] = []
        """What forgets as well when the power goes: a menu that keeps something in RAM puts its own in here."""
        self.sky = SimSky(settings)
        self.stance = Stance(settings)
        self.tuner = SimTuner(self)
        self._adc_rng = seeded("adc", settings.seed)
        self.nvram = g2_nvram(self._own_values(), settings)
        self.sleep = Sleep(self)
        self.power_on()

    @property
    def now_s(self) -> float:
        """Dish time."""
        return self.machine.dish_s

    def level(self, dish_s: float, az_deg: float, el_deg: float) -> float:
        """Return the noise-free level in counts at an instant of dish time, with the dish at its own az and el."""
        clock = self.machine.clock
        when = clock.utc() + timedelta(seconds=dish_s - clock.monotonic() * clock.rate)
        return self.sky.level(when, *self.stance.beam(az_deg, el_deg))

    def adc_counts(self) -> int:
        """Return one reading of the analogue menu."""
        above = self.tuner.level(self.now_s)[1]
        settings = self.settings
        return round(self._adc_rng.gauss(settings.adc_floor + above * settings.adc_scale, ADC_NOISE_COUNTS))

    def bounds(self, index: int) -> tuple[float, float]:
        """Return the lowest and highest count that the firmware allows, in degrees."""
        if index == 1:
            return self.nvram.active[101], self.nvram.active[102]
        return self._cable() if self.wrap_managed[0] else (-math.inf, math.inf)

    def _cable(self) -> tuple[float, float]:
        data, shift = self.dish.axes[0].data, self.wrap_shift_deg[0]
        return data.low_deg - shift, data.high_deg - shift

    def referenced(self, index: int) -> str:
        """Count the turns of the cable anew; tell of the azimuth where it stands."""
        self.wrap_shift_deg[index] = 0.0
        if index != 0:
            return ""
        centideg = round(self.dish.axes[0].count(self.now_s)[0] * 100)
        return f"{self.wrap_text()}AZ - Angle: {centideg} Wrap: 0\n"

    def wrap_text(self) -> str:
        """Return how the limits of the cable are printed."""
        low, high = (round(deg * 100) for deg in self._cable())
        return f"wrap_min:{low} wrap_max:{high}\n"

    def power_on(self) -> None:
        """Read the settings memory and go by it from now on; what was only in RAM is gone."""
        self.nvram.power_on()
        row = self.nvram.active
        self.gains = [[row[first + index] for index in range(3)] for first in (AZ_GAINS, EL_GAINS)]
        """Kp, Kv and Ki of each motor. What they do to its motion is not modelled."""
        self.wrap_managed = [True, True]
        """Whether the firmware keeps the limit of the cable (command `w`)."""
        self.wrap_shift_deg = [0.0, 0.0]
        """What is added to the count of an axis for its place on the cable (command `sw`)."""
        self.tuner.power_on()
        self.sleep.power_on()
        for forget in self.at_power_on:
            forget()
        self.dish.set_speeds(row[80], row[81], row[85], row[103])
        for axis in self.dish.axes:
            if not axis.homed:
                axis.redefine(self.now_s, 0.0)  # the step counter starts from nothing

    def _own_values(self) -> dict[int, float]:
        """Return what this dish has saved otherwise than the factory did."""
        settings = self.settings
        gains = settings.pid_kp, settings.pid_kv, settings.pid_ki
        return {20: float(settings.nvs20)} | {
            first + index: gain for first in (AZ_GAINS, EL_GAINS) for index, gain in enumerate(gains)
        }
