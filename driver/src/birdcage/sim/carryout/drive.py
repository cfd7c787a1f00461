"""What turns the motors of a Carryout of 2003, and the records that it prints while they run."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable

from birdcage.sim.axis import AxisMechanics
from birdcage.sim.carryout.knobs import CarryoutSettings
from birdcage.sim.carryout.mechanics import CarryoutDish
from birdcage.sim.machine import Machine

TOUCH_S = 1e-6
"""A motor that stops within this has stopped: dish time is rounded on its way through the timetable."""
Leg = dict[AxisMechanics, float]
"""Axes that turn together, and the angle of its own count that each goes to."""


class CarryoutDrive:
    """Carries out moves one after the other."""

    def __init__(self, settings: CarryoutSettings, machine: Machine, dish: CarryoutDish) -> None:
        self.on_rest: Callable[[], None] | None = None
        """Called when all is at rest and no move waits."""
        self._settings = settings
        self._machine = machine
        self._dish = dish
        self._waiting: deque[Callable[[], Leg]] = deque()
        self._run = 0

    @property
    def end_s(self) -> float:
        """When the motors that turn now come to rest."""
        return max(axis.end_s() for axis in self._dish.axes)

    @property
    def busy(self) -> bool:
        """Whether a motor turns or a move waits."""
        return bool(self._waiting) or self.end_s > self._machine.dish_s + TOUCH_S

    def go(self, az_deg: float, el_deg: float) -> None:
        """Go to a target after those that wait."""
        az, el = self._dish.axes

        def azimuth() -> Leg:
            return {az: self._dish.cable_target(self._machine.dish_s, az_deg)}

        if self._settings.g_axes == "turn":
            self._waiting += (azimuth, lambda: {el: el_deg})
        else:
            self._waiting.append(lambda: {**azimuth(), el: el_deg})
        self._go_on()

    def retarget(self, az_deg: float, el_deg: float) -> None:
        """Go to a target from wherever the motors are; what they did until now is forgotten."""
        self.drop()
        if self._settings.g_axes == "turn":
            self.brake()
            self.go(az_deg, el_deg)
            return
        now, (az, el) = self._machine.dish_s, self._dish.axes
        az.retarget(now, self._dish.cable_target(now, az_deg))
        el.retarget(now, el_deg)
        self._watch()

    def brake(self) -> None:
        """Forget every move, and bring the motors to rest."""
        self.drop()
        for axis in self._dish.axes:
            if axis.moving(self._machine.dish_s):
                axis.brake(self._machine.dish_s)
        self._watch()

    def drop(self) -> None:
        """Forget what waits, and leave the motors alone."""
        self._waiting.clear()
        self._run += 1

    def _go_on(self) -> None:
        now = self._machine.dish_s
        while self._waiting and self.end_s <= now + TOUCH_S:
            for axis, goal_deg in self._waiting.popleft()().items():
                axis.retarget(now, goal_deg)
        self._watch()

    def _watch(self) -> None:
        self._run += 1
        run = self._run
        self._machine.at_dish(self.end_s, lambda: self._ended(run))

    def _ended(self, run: int) -> None:
        if run != self._run:
            return
        if self._waiting:
            self._go_on()
        elif self.on_rest is not None:
            self.on_rest()


class Records:
    """Prints where the motors are, by the firmware's own count, while they run."""

    def __init__(
        self,
        settings: CarryoutSettings,
        machine: Machine,
        dish: CarryoutDish,
        drive: CarryoutDrive,
        say: Callable[[str], None],
    ) -> None:
        self._settings = settings
        self._machine = machine
        self._dish = dish
        self._drive = drive
        self._say = say
        self._end = {"line": "\n", "cr": "\r"}[settings.record_end]
        self._run = 0
        self.runs = False

    def begin(self) -> None:
        """Print records until the motors are at rest."""
        if not self.runs and self._drive.busy:
            self.runs = True
            self._run += 1
            self._next(self._run)

    def end(self) -> None:
        """Print no more."""
        self.runs = False
        self._run += 1

    def _next(self, run: int) -> None:
        now = self._machine.dish_s
        rest_s = self._drive.end_s
        wait_s = self._settings.record_s if rest_s <= now else min(self._settings.record_s, rest_s - now)
        self._machine.at_dish(now + wait_s, lambda: self._print(run))

    def _print(self, run: int) -> None:
        if run != self._run:
            return
        at_rest = not self._drive.busy
        if not at_rest or self._settings.record_last:
            self._say(self._record())
        if at_rest:
            self.end()
        else:
            self._next(run)

    def _record(self) -> str:
        az, el = (round(axis.count(self._machine.dish_s)[0] * 100) for axis in self._dish.axes)
        az = az % 36000 if az > 36000 else az
        return self._settings.record.replace("{az}", str(az)).replace("{el}", str(el)) + self._end
