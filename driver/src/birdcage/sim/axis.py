"""One motor axis: a step counter that the firmware believes, and a shaft that does what it really does."""

from __future__ import annotations

import math
import random
from collections.abc import Callable
from dataclasses import dataclass

from birdcage.sim.gear import Gear
from birdcage.sim.motion import MotionProfile, at_rest, plan, stopping_point

OVERSHOOT_FORWARD_DEG = (0.01, 0.05)
OVERSHOOT_BACK_DEG = (0.02, 0.06)
"""How far past its target an axis comes to rest, in the direction of travel (noted: docs/reference/g2-motors.md,
*Overshoot*)."""


@dataclass(slots=True)
class AxisData:
    """What an axis is made of. `low` and `high` are its mechanical stops."""

    name: str
    steps_per_rev: int
    max_rate_deg_s: float
    accel_deg_s2: float
    low_deg: float
    high_deg: float
    home_stop_deg: float
    """The stop that homing runs into."""
    home_deg: float
    """Where it comes to rest after homing."""
    homing_rate_deg_s: float
    homing_timeout_s: float
    overshoot: float = 1.0
    """Scale of the overshoot; 0 for an ideal axis."""
    backlash_deg: float = 0.0


STALL_DWELL_S = 0.2
"""How long the motor pushes against the stop before the firmware believes it (assumed)."""


class AxisMechanics:
    """All times are seconds of dish time; all angles are degrees of this axis' own count."""

    def __init__(self, data: AxisData, position_deg: float, rng: random.Random) -> None:
        self.data = data
        self.homed = False
        self.stalled = False
        self.released = False
        self.orders = 0
        """How many motions it was given."""
        self.homings = 0
        """How often it began to look for its reference."""
        self.slips_at_stop = False
        """Whether the count goes on when the shaft is at a stop; else the motion ends there."""
        self.on_strike: Callable[[float], None] | None = None
        """Told when a motion is ordered that will end at a stop, and when that will be."""
        self.on_blocked: Callable[[], None] | None = None
        """Told when a motion is ordered that a blocked shaft does not let begin."""
        self._slips = False
        self._rng = rng
        self._count: list[MotionProfile] = [at_rest(0.0, position_deg)]
        self._target_deg: float | None = None
        self._gear = Gear(data.low_deg, data.high_deg, data.backlash_deg, position_deg)
        self._shaft: list[MotionProfile] | None = None
        self._worn = (0.0, 0.0)
        self._worn_at_s = -math.inf

    @property
    def step_deg(self) -> float:
        """The angle of one microstep."""
        return 360.0 / self.data.steps_per_rev

    def count(self, now_s: float) -> tuple[float, float]:
        """Return the firmware's idea of position and rate, quantised to steps."""
        position, rate = _along(self._count, now_s)
        return round(position / self.step_deg) * self.step_deg, rate

    def shaft(self, now_s: float) -> float:
        """Return where the axis really is."""
        if self._shaft is not None:
            return _along(self._shaft, now_s)[0]
        return self._gear.shaft(self._count, now_s)

    def moving(self, now_s: float) -> bool:
        """Whether the motor turns."""
        counts = any(motion.start_s <= now_s < motion.end_s for motion in self._count)
        return counts or (self._shaft is not None and now_s < self._shaft[-1].end_s)

    def end_s(self) -> float:
        """When the last motion that was ordered ends."""
        return self._count[-1].end_s

    def wear(self, now_s: float) -> tuple[float, float]:
        """Return how many degrees it has really turned, to and fro, and for how many seconds, homing included."""
        motions = self._count if self._shaft is None else self._shaft
        turned = [motion.travelled(self._worn_at_s, now_s) for motion in motions]
        return self._worn[0] + sum(deg for deg, _ in turned), self._worn[1] + sum(seconds for _, seconds in turned)

    def ordered_deg(self) -> float:
        """Return where it will come to rest."""
        return self._count[-1].rest_deg

    def retarget(self, now_s: float, target_deg: float, *, rate_deg_s: float | None = None) -> None:
        """Go to another target from wherever it is, at whatever rate it has; what was queued is dropped.

        `rate_deg_s` is the highest rate on the way, that of the axis when left out.
        """
        if target_deg == self._target_deg and not self.stalled:
            return
        position, rate = _along(self._count, now_s)
        self._settle(now_s)
        self._count = []
        self._append(now_s, position, rate, target_deg, rate_deg_s)

    def brake(self, now_s: float) -> None:
        """Come to rest as soon as it can."""
        position, rate = _along(self._count, now_s)
        self.retarget(now_s, stopping_point(position, rate, self.data.accel_deg_s2))

    def queue(self, now_s: float, target_deg: float, *, not_before_s: float = -math.inf) -> None:
        """Go to another target after those already ordered, and not before an instant."""
        if target_deg == self._target_deg and not self.stalled:
            return
        self._settle(now_s)
        self._count = [motion for motion in self._count if motion.end_s > now_s] or self._count[-1:]
        self._append(max(now_s, self.end_s(), not_before_s), self.ordered_deg(), 0.0, target_deg)

    def halt(self, now_s: float) -> None:
        """Lose all motion at once, as when the motor's current is cut or the rotor is blocked."""
        where = self.shaft(now_s)
        self._stand(now_s, self.count(now_s)[0], where)
        self._shaft = [at_rest(now_s, where)] if self.stalled else None

    def redefine(self, now_s: float, count_deg: float) -> None:
        """Stop, and believe from now on that this is where it stands; the shaft stays where it is."""
        where = self.shaft(now_s)
        self.halt(now_s)
        self._stand(now_s, round(count_deg / self.step_deg) * self.step_deg, where)

    def fall(self, now_s: float, by_deg: float, rate_deg_s: float) -> None:
        """Let the shaft sink towards its lower stop while the count stands still."""
        self.halt(now_s)
        where = self.shaft(now_s)
        goal = max(self.data.low_deg, where - by_deg)
        self._shaft = [plan(now_s, where, 0.0, goal, rate_deg_s, self.data.accel_deg_s2)]

    def block(self, now_s: float, *, slips: bool) -> None:
        """Block the shaft. The count stops as well, unless the motor `slips` unnoticed."""
        where = self.shaft(now_s)
        if not slips:
            self.halt(now_s)
        self._settle(now_s)
        self.stalled = True
        self._slips = slips
        self._shaft = [at_rest(now_s, where)]

    def unblock(self, now_s: float) -> None:
        """Free the shaft again; steps lost meanwhile stay lost."""
        if self.stalled:
            self.stalled = False
            self.halt(now_s)

    def home(self, now_s: float) -> float:
        """Run into the stop, back off to the home position, and return when that is done."""
        self.halt(now_s)
        self.homed = False
        self.homings += 1
        data = self.data
        where = self.shaft(now_s)
        if self.stalled:
            self._shaft = [at_rest(now_s, where)]
            return now_s + data.homing_timeout_s
        there = plan(now_s, where, 0.0, data.home_stop_deg, data.homing_rate_deg_s, data.accel_deg_s2)
        turn_s = there.end_s + STALL_DWELL_S
        back = plan(turn_s, data.home_stop_deg, 0.0, data.home_deg, data.homing_rate_deg_s, data.accel_deg_s2)
        self._shaft = [there, back]
        return back.end_s

    def homing_done(self, now_s: float) -> bool:
        """Take the reference if the stop was found; return whether it was."""
        if self.stalled:
            return False
        self._stand(now_s, self.data.home_deg, self.data.home_deg)
        self._shaft = None
        self.homed = True
        return True

    def _append(
        self, start_s: float, position: float, rate: float, target_deg: float, highest_deg_s: float | None = None
    ) -> None:
        self._target_deg = target_deg
        self.orders += 1
        if self.released or (self.stalled and not self._slips):
            self._count.append(at_rest(start_s, position))
            if not self.released and self.on_blocked is not None and abs(target_deg - position) > self.step_deg:
                self.on_blocked()
            return
        data = self.data
        ahead = target_deg - stopping_point(position, rate, data.accel_deg_s2)
        rest = self._rest(target_deg, 1 if ahead > 0 else -1)
        motion = plan(start_s, position, rate, rest, highest_deg_s or data.max_rate_deg_s, data.accel_deg_s2)
        struck = None if self.slips_at_stop or self.stalled else self._gear.strike(motion)
        self._count.append(struck or motion)
        if struck is not None:
            self._target_deg = None  # ordered again, it tries again
            if self.on_strike is not None:
                self.on_strike(struck.end_s)

    def _rest(self, target_deg: float, direction: int) -> float:
        """Choose the step it comes to rest on: past the target; inside the stops if the target is."""
        near, far = OVERSHOOT_FORWARD_DEG if direction > 0 else OVERSHOOT_BACK_DEG
        step = self.step_deg
        first = math.ceil((target_deg * direction + near * self.data.overshoot) / step)
        last = math.floor((target_deg * direction + far * self.data.overshoot) / step)
        steps = self._rng.randint(first, last) if self.data.overshoot and last >= first else None
        rest = round(target_deg / step) if steps is None else steps * direction
        if not self.data.low_deg <= target_deg <= self.data.high_deg:
            return rest * step
        low, high = math.ceil(self.data.low_deg / step), math.floor(self.data.high_deg / step)
        return min(max(rest, low), high) * step

    def _settle(self, now_s: float) -> None:
        """Go on from here: remember what matters of the motions until now."""
        self._worn, self._worn_at_s = self.wear(now_s), now_s
        self._gear.settle(self._count, now_s)

    def _stand(self, now_s: float, count_deg: float, shaft_deg: float) -> None:
        self._worn, self._worn_at_s = self.wear(now_s), now_s
        self._count = [at_rest(now_s, count_deg)]
        self._target_deg = None
        self._gear.place(count_deg, shaft_deg)


def _along(motions: list[MotionProfile], now_s: float) -> tuple[float, float]:
    for motion in motions:
        if now_s < motion.end_s:
            return motion.at(now_s)
    return motions[-1].at(now_s)
