"""The TV search after homing: the dish moves by itself until it gives up.

That it does is written, its path is assumed (`docs/reference/carryout-2003.md`, *Power-up*).
"""

from __future__ import annotations

from birdcage.sim.carryout.board import CarryoutBoard

EL_STEP_DEG = 5.0
AZ_ENDS_DEG = 5.0, 355.0
SHORTEST_SWEEP_S = 5.0
"""A blocked motor is at its end at once: the search still takes its time."""


class CarryoutSearch:
    """A step in elevation, a sweep in azimuth, and again a little higher. Nothing ticks: each sweep is foreseen."""

    def __init__(self, board: CarryoutBoard) -> None:
        self.running = False
        self._board = board
        self._run = 0
        self._sweeps = 0
        self._swept_s = 0.0
        board.drive.on_rest = self._rested

    def start(self) -> None:
        """Begin, for as long as setting `search_s` says."""
        if not self._board.homed:
            return
        self.running = True
        self._run += 1
        run = self._run
        self._sweeps = 0
        self._board.machine.at_dish(self._board.now_s + self._board.settings.search_s, lambda: self._over(run))
        self._sweep(run)

    def halt(self) -> None:
        """Give up, and leave the motors alone."""
        self.running = False
        self._run += 1

    def stop(self) -> None:
        """Give up, and bring the motors to rest."""
        if self.running:
            self.halt()
            self._board.drive.brake()

    def _over(self, run: int) -> None:
        if run == self._run:
            self.stop()

    def _rested(self) -> None:
        if self.running:
            run, next_s = self._run, self._swept_s + SHORTEST_SWEEP_S
            self._board.machine.at_dish(max(next_s, self._board.now_s), lambda: self._sweep(run))

    def _sweep(self, run: int) -> None:
        if run != self._run:
            return
        board, settings = self._board, self._board.settings
        self._swept_s = board.now_s
        low = settings.el_min
        el_deg = low + EL_STEP_DEG * self._sweeps % max(settings.el_max - low, EL_STEP_DEG)
        az_deg = AZ_ENDS_DEG[self._sweeps % 2]
        self._sweeps += 1
        board.drive.go(az_deg, el_deg)
