"""One axis of the RP2040 base station: a geared motor with an encoder, stepped tick by tick when somebody looks."""

from __future__ import annotations

import math
import random

from birdcage.sim.axis import AxisData, AxisMechanics
from birdcage.sim.easycomm.pid import DEAD_BAND_DEG, TICK_S, PidLoop

STILL = 1e-4
"""A duty, and a speed in deg/s, below which nothing turns."""
SWITCH_DEG = 1.0
"""How far before its lower end an axis presses its switch (assumed)."""


class ServoAxis(AxisMechanics):
    """Angles in degrees of the shaft, 0 where the mechanics have it; the firmware counts ticks from where it zeroed.

    The loop runs at 100 Hz of dish time. At rest a tick changes nothing, so those are skipped however many.
    """

    def __init__(
        self, data: AxisData, position_deg: float, rng: random.Random, loop: PidLoop,
        *, ticks_per_deg: float, full_deg_s: float, lag_s: float, stiction: float, switch: bool,
    ) -> None:  # fmt: skip
        super().__init__(data, position_deg, rng)
        self.loop, self.ticks_per_deg = loop, ticks_per_deg
        self.target_deg = position_deg
        self.duty: float | None = 0.0
        """What a person gave the motor in manual mode; None while the loop drives it."""
        self.measured_deg = position_deg
        """What the firmware has read at its last tick."""
        self._full_deg_s, self._lag_s, self._stiction, self._has_switch = full_deg_s, lag_s, stiction, switch
        self._at_deg, self._rate_deg_s = position_deg, 0.0
        self._zero_deg = 0.0
        """Where the shaft stands while the counter shows 0."""
        self._tick = 0
        self._turned_deg = self._turned_s = 0.0

    def ticks(self, now_s: float) -> int:
        """Return what the counter of the encoder shows."""
        self._run(now_s)
        return math.trunc((self._at_deg - self._zero_deg) * self.ticks_per_deg)

    def set_ticks(self, now_s: float, ticks: float) -> None:
        """Set the counter; the firmware reads it at its next tick."""
        self._run(now_s)
        self._zero_deg = self._at_deg - ticks / self.ticks_per_deg

    def told(self, now_s: float) -> float:
        """Return the angle that the firmware tells: of its last tick."""
        self._run(now_s)
        return self.measured_deg

    def pressed(self, now_s: float) -> bool:
        """Return whether the shaft is at its switch."""
        self._run(now_s)
        return self._at_switch

    def drive(self, now_s: float, duty: float | None) -> None:
        """Give the motor a duty, -1 to 1, or leave it to the loop (None)."""
        self._run(now_s)
        self.duty = None if duty is None else min(max(duty, -1.0), 1.0)

    def aim(self, now_s: float, target_deg: float) -> None:
        """Have the loop go there, once it drives."""
        self._run(now_s)
        self.orders += 1
        self.target_deg = target_deg

    def stop(self, now_s: float) -> None:
        """Aim where it stands, and forget what the loop was about; manual mode stays."""
        self._run(now_s)
        self.target_deg = self.measured_deg
        self.loop.clear()
        if self.duty is not None:
            self.duty = 0.0

    def count(self, now_s: float) -> tuple[float, float]:
        """Return where the shaft is in its own degrees, and how fast it turns."""
        self._run(now_s)
        return self._at_deg + self._rate_deg_s * (now_s - self._tick * TICK_S), self._rate_deg_s

    def shaft(self, now_s: float) -> float:
        """Return where it really is."""
        return self.count(now_s)[0]

    def moving(self, now_s: float) -> bool:
        """Whether it turns."""
        return abs(self.count(now_s)[1]) > STILL

    def wear(self, now_s: float) -> tuple[float, float]:
        """Return how many degrees it has turned, to and fro, and for how many seconds."""
        self._run(now_s)
        return self._turned_deg, self._turned_s

    def retarget(self, now_s: float, target_deg: float, *, rate_deg_s: float | None = None) -> None:  # noqa: ARG002
        """Have the loop go to an angle of the shaft, as if it had been told to."""
        self.aim(now_s, target_deg - self._zero_deg)
        self.duty = None

    def halt(self, now_s: float) -> None:
        """Lose all motion at once."""
        self.stop(now_s)
        self._rate_deg_s = 0.0

    def block(self, now_s: float, *, slips: bool) -> None:  # noqa: ARG002 - an encoder sees what does not turn
        """Block the shaft; the loop goes on pushing."""
        self._run(now_s)
        self.stalled, self._rate_deg_s = True, 0.0

    def unblock(self, now_s: float) -> None:
        """Free it again."""
        self._run(now_s)
        self.stalled = False

    @property
    def _at_switch(self) -> bool:
        return self._has_switch and self._at_deg <= self.data.low_deg + SWITCH_DEG

    def _run(self, now_s: float) -> None:
        until = int(now_s / TICK_S + 1e-6)
        while self._tick < until:
            if self._rests():
                self._tick = until
                return
            self._tick += 1
            self._turn(self._step())
            self.measured_deg = self._counted()

    def _counted(self) -> float:
        return math.trunc((self._at_deg - self._zero_deg) * self.ticks_per_deg) / self.ticks_per_deg

    def _rests(self) -> bool:
        """Whether a tick would change nothing."""
        if abs(self._rate_deg_s) > STILL or self.measured_deg != self._counted():
            return False
        if self.duty is not None:
            return abs(self.duty) <= max(STILL, self._stiction)
        return abs(self.target_deg - self.measured_deg) <= DEAD_BAND_DEG and abs(self.loop.duty) <= STILL

    def _step(self) -> float:
        """Return the duty of this tick."""
        if self.duty is not None:
            return self.duty
        error_deg = self.target_deg - self.measured_deg
        duty = self.loop.tick(error_deg)
        return 0.0 if self._at_switch and error_deg < 0.0 else duty

    def _turn(self, duty: float) -> None:
        if self.stalled:
            self._rate_deg_s = 0.0
            return
        goal_deg_s = 0.0 if abs(duty) <= self._stiction else duty * self._full_deg_s
        self._rate_deg_s += (goal_deg_s - self._rate_deg_s) * min(TICK_S / self._lag_s, 1.0)
        if goal_deg_s == 0.0 and abs(self._rate_deg_s) <= STILL * 100.0:
            self._rate_deg_s = 0.0
        way_deg = self._rate_deg_s * TICK_S
        there = min(max(self._at_deg + way_deg, self.data.low_deg), self.data.high_deg)
        if there != self._at_deg + way_deg:
            self._rate_deg_s = 0.0
        self._turned_deg += abs(there - self._at_deg)
        self._turned_s += TICK_S if there != self._at_deg else 0.0
        self._at_deg = there
