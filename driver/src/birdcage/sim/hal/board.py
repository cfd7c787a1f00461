"""What the menus of a Trav'ler share: the dish, its motors' queues, the settings memory and the time."""

from __future__ import annotations

import math
from collections.abc import Callable
from datetime import timedelta

from birdcage.sim.axis import STALL_DWELL_S, AxisMechanics
from birdcage.sim.chance import seeded
from birdcage.sim.firmware import FirmwareHost
from birdcage.sim.hal.knobs import HalSettings
from birdcage.sim.hal.mechanics import SKEW_DEG, HalDish
from birdcage.sim.hal.memory import MAXIMUM, STOW_AZ, STOW_EL, HalMemory
from birdcage.sim.hal.motor_queue import MotorQueue, QueuedMove
from birdcage.sim.sky import SimSky
from birdcage.sim.stance import Stance


class HalBoard:
    """The processor board, as far as its console shows it."""

    def __init__(self, settings: HalSettings, host: FirmwareHost, dish: HalDish) -> None:
        self.settings = settings
        self.host = host
        self.machine = host.machine
        self.dish = dish
        self.memory = HalMemory(settings.nvs_rows)
        az, el, skew = dish.axes
        self.turn = MotorQueue(host.machine, (az, el), self._started)
        """Azimuth and elevation exclude each other."""
        self.skew = MotorQueue(host.machine, (skew,), self._started)
        self._sky = SimSky(settings)
        self._stance = Stance(settings)
        self._rng = seeded("floor", settings.seed)
        for axis in dish.axes:
            axis.on_strike = self._strikes(axis)

    @property
    def now_s(self) -> float:
        """Dish time."""
        return self.machine.dish_s

    @property
    def el_max(self) -> float:
        """The highest elevation that it takes: a row of its memory, where it has one."""
        return self.memory.active.get(MAXIMUM, self.settings.el_max)

    @property
    def stow_deg(self) -> tuple[float, float]:
        """Azimuth and elevation to which it folds: rows of its memory, where it has them."""
        rows, settings = self.memory.active, self.settings
        return rows.get(STOW_AZ, settings.stow_az), rows.get(STOW_EL, settings.stow_el)

    @property
    def lanes(self) -> tuple[MotorQueue, MotorQueue]:
        """Both queues of moves."""
        return self.turn, self.skew

    def lane(self, index: int) -> MotorQueue:
        """Return the queue that an axis stands in."""
        return self.skew if index == 2 else self.turn

    def order(self, index: int, wanted_deg: float) -> None:
        """Queue a move to an angle that `target` gave."""
        if index == 0:
            self.turn.put(QueuedMove(self.dish.axes[0], lambda now_s: self.dish.cable_target(now_s, wanted_deg)))
        else:
            self.put(index, wanted_deg)

    def put(self, index: int, count_deg: float) -> None:
        """Queue a move to an angle of the axis' own count."""
        self.lane(index).put(QueuedMove(self.dish.axes[index], lambda _now_s: count_deg))

    def drop(self) -> None:
        """Forget every move that waits."""
        for lane in self.lanes:
            lane.drop()

    def brake(self) -> None:
        """Forget every move that waits, and bring every motor to rest."""
        self.drop()
        for axis in self.dish.axes:
            if axis.moving(self.now_s):
                axis.brake(self.now_s)
        for lane in self.lanes:
            lane.go_on()

    def target(self, index: int, wanted_deg: float) -> float | None:
        """Return the angle that a command means, None when it is refused."""
        settings = self.settings
        if index == 0:
            return wanted_deg if settings.az_outside or 0.0 <= wanted_deg <= 360.0 else None
        low, high = SKEW_DEG if index == 2 else (-math.inf, self.el_max)
        inside = min(max(wanted_deg, low), high)
        if inside != wanted_deg and settings.out_of_range == "error":
            return None
        return inside if index == 2 else self._above_floor(inside)

    def above_floor_counts(self, dish_s: float, az_deg: float, el_deg: float) -> float:
        """Return how much more than the empty sky is heard at an instant of dish time."""
        clock = self.machine.clock
        when = clock.utc() + timedelta(seconds=dish_s - clock.monotonic() * clock.rate)
        beam = self._stance.beam(az_deg, el_deg)
        return self._sky.level(when, *beam) - self._sky.floor(beam[1])

    def stalled(self, axis: AxisMechanics) -> None:
        """Tell of a motor that has stopped on its way, and go on with the next move."""
        self._tell_stall(axis)
        for lane in self.lanes:
            if axis in lane.axes:
                lane.go_on()

    def _above_floor(self, el_deg: float) -> float | None:
        floor = self.memory.active[self.settings.floor_row]
        if el_deg >= floor or self.settings.below_floor == "clamp":
            return max(el_deg, floor)
        return None if self.settings.below_floor == "refuse" else self._rng.uniform(el_deg, floor)

    def _started(self, axis: AxisMechanics) -> None:
        if axis.stalled and self.settings.stall == "stop":
            self.machine.at_dish(self.now_s + STALL_DWELL_S, lambda: self._tell_stall(axis) if axis.stalled else None)

    def _tell_stall(self, axis: AxisMechanics) -> None:
        if self.settings.stall_text:
            self.host.say(f"{axis.data.name} MOTOR STALLED\n")

    def _strikes(self, axis: AxisMechanics) -> Callable[[float], None]:
        """Make what is called when a motion is ordered that will run into a stop."""

        def strikes(when_s: float) -> None:
            self.machine.at_dish(when_s, lambda: self.stalled(axis) if axis.end_s() == when_s else None)

        return strikes


def number(text: str) -> float | None:
    """Read a finite number as the firmware would; None when it is none."""
    try:
        value = float(text)
    except ValueError:
        return None
    return value if math.isfinite(value) else None
