"""The TV search, *Tracker Proc*: it moves the dish by itself after power-on unless NVS 20 is TRUE.

That it searches, and at which speed (NVS 41), is noted (docs/reference/g2.md, *Power-up*). Its path, and that it takes
the first strong signal, are assumed. It prints nothing here, as no source quotes what it prints.
"""

from __future__ import annotations

from birdcage.sim.axis import AxisMechanics
from birdcage.sim.g2.board import G2Board

FIRST_EL_DEG, EL_STEP_DEG = 25.0, 5.0
AZ_ENDS_DEG = (-355.0, -5.0)
"""Cable angles between which it sweeps."""
FOUND_COUNTS = 80.0
"""So far above the empty sky it believes that it has found a satellite."""
SAMPLE_S = 0.02
SHORTEST_SWEEP_S = 1.0
"""A blocked or released axis is at its end at once: the search still takes its time."""


class Tracker:
    """Sweeps in azimuth, a little higher each time, until it hears something. Nothing ticks: each sweep is foreseen."""

    def __init__(self, board: G2Board) -> None:
        self._board = board
        self._run = 0
        self._sweep = 0

    def stop(self) -> None:
        """Give up, as at power-off."""
        self._run += 1

    def start(self) -> None:
        """Begin a search if the settings memory does not forbid it."""
        self.stop()
        self._sweep = 0
        if not self._board.nvram.active[20]:
            self._next(self._run)

    def _next(self, run: int) -> None:
        az, el = self._board.dish.axes
        if run != self._run or not (az.homed and el.homed):
            return
        now = self._board.now_s
        low, high = self._board.nvram.active[101], self._board.nvram.active[102]
        el.retarget(now, low + (FIRST_EL_DEG - low + EL_STEP_DEG * self._sweep) % (high - low))
        az.retarget(now, AZ_ENDS_DEG[self._sweep % 2], rate_deg_s=self._board.nvram.active[41])
        self._sweep += 1
        found_s = self._hears(az, el, now)
        if found_s is None:
            self._board.machine.at_dish(max(az.end_s(), el.end_s(), now + SHORTEST_SWEEP_S), lambda: self._next(run))
        else:
            self._board.machine.at_dish(found_s, lambda: self._hold(run))

    def _hears(self, az: AxisMechanics, el: AxisMechanics, now_s: float) -> float | None:
        for index in range(int((az.end_s() - now_s) / SAMPLE_S)):
            when = now_s + index * SAMPLE_S
            level = self._board.level(when, az.shaft(when), el.shaft(when))
            if level > self._board.sky.floor(el.shaft(when)) + FOUND_COUNTS:
                return when
        return None

    def _hold(self, run: int) -> None:
        az, el = self._board.dish.axes
        now = self._board.now_s
        if run == self._run and az.homed and el.homed:
            az.retarget(now, az.count(now)[0])
            el.retarget(now, el.count(now)[0])
