"""Two axes, what they take while they turn, and what they print about themselves."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass

from .habits import UNHOMED, Habits
from .motor import Motor
from .nvs import Nvs

CABLE_DEG = (-423.33, 23.33)
STEPS_A_TURN = (40000, 24960)
AXES = ("AZ", "EL")


@dataclass(frozen=True)
class Asked:
    """One move that a line asked for."""

    at: float
    axis: int
    deg: float
    taken: bool


class Mechanics:
    """Azimuth is counted on the cable, from the reference: 180 is -180 there."""

    def __init__(self, habits: Habits, nvs: Nvs, now: Callable[[], float]) -> None:
        self.habits, self.now, self._nvs = habits, now, nvs
        az = habits.az_deg if habits.shows_turn else self._nearest(habits.az_deg, -200.0)
        self.motors = (
            Motor(az, habits.az_speed, habits.accel),
            Motor(habits.el_deg, habits.el_speed, habits.accel),
        )
        self.homed = [habits.homed, habits.homed]
        self.powered = True
        self.asked: list[Asked] = []

    @property
    def rests_at(self) -> float:
        """When both axes have come to rest: now, where they have."""
        return max(self.now(), *(motor.ends for motor in self.motors))

    def where(self) -> tuple[float, float]:
        """Return the truth: azimuth from 0 to 360, and elevation."""
        now = self.now()
        return self.motors[0].at(now) % 360.0, self.motors[1].at(now)

    def printed(self) -> str:
        """Return what `a` prints."""
        az, el = (motor.at(self.now()) for motor in self.motors)
        shown = (az if self.habits.shows_turn else az % 360.0, el)
        return "".join(f"Angle[{axis}] = {self._angle(axis, deg)}\n" for axis, deg in enumerate(shown))

    def _angle(self, axis: int, deg: float) -> str:
        if not self.homed[axis]:
            return UNHOMED.get(self.habits.unhomed_as, self.habits.unhomed_as)
        return f"{deg:.{self.habits.decimals}f}"

    def steps(self, axis: int) -> int:
        """Return what `p` prints of an axis."""
        if not self.homed[axis]:
            return 2147483647
        return round(self.motors[axis].at(self.now()) * STEPS_A_TURN[axis] / 360.0)

    def refuses(self, axis: int, deg: float) -> str:
        """Return what is said to a target that is not taken; empty where it is."""
        if not self.homed[axis]:
            return f"Step to Position {AXES[axis]} angle error: 2147483647\n"
        low, high = CABLE_DEG[0], 360.0
        if axis == 1:
            low, high = float(self._nvs.ram[101]), float(self._nvs.ram[102])
        return "" if low <= deg <= high else f"{self.habits.range_text}\n"

    def move(self, axis: int, text: str) -> Iterator[str | float]:
        """Carry out `a <id> <deg>`."""
        deg, habits = float(text), self.habits
        refusal = self.refuses(axis, deg)
        rules = self._rules(axis)
        if not refusal and "refuse" in rules:
            refusal = f"{habits.busy_text}\n"
        taken = not refusal and "ignore" not in rules and habits.takes_moves and self.powered
        self.asked.append(Asked(self.now(), axis, deg, taken))
        if refusal:
            yield refusal
            return
        if taken and "block" in rules:
            yield rules["block"]
        if taken and "abort" in rules:
            self.halt()
        if taken:
            self.send(axis, deg, after=rules.get("queue", 0.0))
        yield self._answer(axis, deg)

    def _rules(self, axis: int) -> dict[str, float]:
        """Return which rules for a second move hold now, each with the end of the motion that it is about."""
        now, rules = self.now(), {}
        for index, rule in ((axis, self.habits.second_same), (1 - axis, self.habits.second_other)):
            if self.motors[index].turns(now):
                rules[rule] = max(rules.get(rule, 0.0), self.motors[index].ends)
        return rules

    def _answer(self, axis: int, deg: float) -> str:
        match self.habits.move_answer:
            case "angle":
                return f"Angle = {deg:.{self.habits.decimals}f}\n"
            case "np":
                return f"m {axis}  a {round(deg * 100)}  np {round(deg * 657.1)}\n"
            case "empty":
                return ""
            case text:
                return f"{text}\n"

    def send(self, axis: int, deg: float, after: float = 0.0) -> None:
        """Set an axis going, at once or behind a motion that ends at `after`."""
        motor, now = self.motors[axis], self.now()
        here = motor.rest if after > now else motor.at(now)
        if axis == 0 and not self.habits.shows_turn:
            deg = self._nearest(deg, here)
        deg += math.copysign(self.habits.overshoot_deg, deg - here)
        if after > now:
            motor.go_then(after, deg)
        else:
            motor.go(now, deg)

    @staticmethod
    def _nearest(deg: float, here: float) -> float:
        """Return the turn of an azimuth that is next to where it stands, within the cable."""
        low, high = CABLE_DEG
        turns = (deg % 360.0 + 360.0 * turn for turn in (-2, -1, 0, 1))
        return min((each for each in turns if low <= each <= high), key=lambda each: abs(each - here))

    def home(self, axes: tuple[int, ...]) -> Iterator[str | float]:
        """Find the reference of axes: the shell waits for it."""
        for axis in axes:
            motor, begun = self.motors[axis], self.now()
            reference = 0.0 if axis == 0 else float(self._nvs.ram[103])
            self.homed[axis] = False
            usual = motor.max_speed, motor.accel
            motor.max_speed = max(usual[0], 2.0 * abs(reference - motor.at(begun)) / self.habits.homing_s[axis])
            motor.accel = max(usual[1], 4.0 * motor.max_speed)
            motor.go(begun, reference)
            yield max(begun + self.habits.homing_s[axis], motor.ends)
            motor.freeze(self.now())
            motor.max_speed, motor.accel = usual
            self.homed[axis] = True
            yield "wrap_min:-42333 wrap_max:2333\nAZ - Angle: 1 Wrap: 0\n" if axis == 0 else "EL homed\n"

    def stow(self) -> None:
        """Fold flat: it ends at the floor of what the mechanics pass."""
        self.send(0, 0.0)
        self.send(1, 5.0)

    def halt(self) -> None:
        for motor in self.motors:
            motor.halt(self.now())

    def power(self, *, on: bool) -> None:
        """Give the motors current, or take it."""
        self.powered = on
        if not on:
            for motor in self.motors:
                motor.freeze(self.now())

    def lose(self) -> None:
        """Stand where it stands, and know nothing of it: the power went."""
        for motor in self.motors:
            motor.freeze(self.now())
        self.homed, self.powered = [False, False], True
