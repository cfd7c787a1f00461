"""What the menus of a Carryout of 2003 share: the dish, its motors, the settings memory and the time."""

from __future__ import annotations

import math
from collections.abc import Callable

from birdcage.sim.axis import STALL_DWELL_S, AxisMechanics
from birdcage.sim.carryout.drive import CarryoutDrive, Records
from birdcage.sim.carryout.knobs import CarryoutSettings
from birdcage.sim.carryout.mechanics import CarryoutDish
from birdcage.sim.carryout.memory import EL_MAX, CarryoutMemory
from birdcage.sim.firmware import FirmwareHost


class CarryoutBoard:
    """The processor board, as far as its console shows it."""

    def __init__(self, settings: CarryoutSettings, host: FirmwareHost, dish: CarryoutDish) -> None:
        self.settings = settings
        self.host = host
        self.machine = host.machine
        self.dish = dish
        self.memory = CarryoutMemory(settings)
        self.drive = CarryoutDrive(settings, host.machine, dish)
        self.records = Records(settings, host.machine, dish, self.drive, host.say)
        for axis in dish.axes:
            axis.on_strike = self._strikes(axis)
            axis.on_blocked = self._blocked

    @property
    def now_s(self) -> float:
        """Dish time."""
        return self.machine.dish_s

    @property
    def homed(self) -> bool:
        """Whether both axes are."""
        return all(axis.homed for axis in self.dish.axes)

    def target(self, az_deg: float, el_deg: float) -> tuple[float, float] | None:
        """Return the angles that a command means, None when it is refused."""
        settings = self.settings
        low, high = settings.el_min, self.memory.active[EL_MAX]
        az = az_deg if 0.0 <= az_deg <= 360.0 or settings.az_outside == "refuse" else az_deg % 360.0
        inside = min(max(az, 0.0), 360.0), min(max(el_deg, low), high)
        if inside != (az, el_deg) and settings.out_of_range == "refuse":
            return None
        return inside

    def stalled(self) -> None:
        """Tell of a motor that has stopped on its way (setting `stall_text`)."""
        self.tell(self.settings.stall_text)

    def tell(self, text: str) -> None:
        """Print a line unasked; none for an empty text."""
        if text:
            self.host.say(f"{text}\n")

    def _strikes(self, axis: AxisMechanics) -> Callable[[float], None]:
        """Make what is called when a motion is ordered that will run into a stop."""

        def strikes(when_s: float) -> None:
            self.machine.at_dish(when_s, lambda: self.stalled() if axis.end_s() == when_s else None)

        return strikes

    def _blocked(self) -> None:
        if self.settings.stall == "stop":
            self.machine.at_dish(self.now_s + STALL_DWELL_S, self.stalled)


def number(text: str) -> float | None:
    """Read a finite number as the firmware would; None when it is none."""
    try:
        value = float(text)
    except ValueError:
        return None
    return value if math.isfinite(value) else None
