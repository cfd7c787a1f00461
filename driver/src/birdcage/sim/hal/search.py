"""The TV search: it begins when homing has ended, and moves the dish by itself until it is stopped.

`docs/reference/travler.md`, *Start and search*.

Its path, its speed, and that it takes the first strong signal, are assumed. It takes its turn with the moves of `a`: a
dish that searches carries out a move, and then goes on searching.
"""

from __future__ import annotations

from birdcage.sim.axis import AxisMechanics
from birdcage.sim.hal.board import HalBoard
from birdcage.sim.hal.memory import SEARCH_MINIMUM
from birdcage.sim.hal.motor_queue import TOUCH_S, QueuedMove

EL_STEP_DEG = 5.0
AZ_ENDS_DEG = 5.0, 355.0
"""Cable angles between which it sweeps."""
FOUND_COUNTS = 80.0
"""So far above the empty sky it believes that it has found a satellite."""
SAMPLE_S = 0.05
SHORTEST_SWEEP_S = 5.0
"""A blocked motor is at its end at once: the search still takes its time."""


class HalSearch:
    """A step in elevation, a sweep in azimuth, and again a little higher. Nothing ticks: each sweep is foreseen."""

    def __init__(self, board: HalBoard) -> None:
        self.running = False
        self._board = board
        self._run = 0
        self._steps = 0
        self._next_s = 0.0
        self._order: QueuedMove | None = None
        board.turn.on_idle = self._go_on

    def start(self) -> None:
        """Begin, if every axis knows where it is."""
        if all(axis.homed for axis in self._board.dish.axes):
            self.running = True
            self._steps = 0
            self._board.turn.go_on()

    def halt(self) -> None:
        """Give up, and leave the motors alone."""
        self.running = False
        self._run += 1

    def stop(self) -> None:
        """Give up; a motor that it moves comes to rest, and moves that wait have their turn (assumed)."""
        self.halt()
        turn = self._board.turn
        if self._order is not None and turn.current is self._order:
            for axis in turn.axes:
                if axis.moving(self._board.now_s):
                    axis.brake(self._board.now_s)
            turn.go_on()

    def _go_on(self) -> None:
        if not self.running:
            return
        board, now = self._board, self._board.now_s
        self._run += 1
        run = self._run
        if now < self._next_s - TOUCH_S:
            board.machine.at_dish(self._next_s, lambda: self._again(run))
            return
        az, el = board.dish.axes[:2]
        sweep, second = divmod(self._steps, 2)
        self._steps += 1
        if not second:
            low = board.memory.active[SEARCH_MINIMUM]
            top = min(board.el_max, board.settings.el_stop - EL_STEP_DEG)
            goal = low + EL_STEP_DEG * sweep % max(top - low, EL_STEP_DEG)
            self._move(el, goal)
            return
        self._next_s = now + SHORTEST_SWEEP_S
        if board.settings.search_text:
            board.host.say(f"{board.settings.search_text}\n")
        self._move(az, AZ_ENDS_DEG[sweep % 2], board.settings.search_speed)
        found_s = self._hears(now) if board.settings.search_finds else None
        if found_s is not None:
            board.machine.at_dish(found_s, lambda: self._hold(run))

    def _move(self, axis: AxisMechanics, goal_deg: float, rate_deg_s: float | None = None) -> None:
        self._order = QueuedMove(
            axis, lambda _now_s: goal_deg, rate_deg_s
        )  # kept first: what follows may come back here
        self._board.turn.put(self._order)

    def _again(self, run: int) -> None:
        if run == self._run:
            self._board.turn.go_on()

    def _hears(self, now_s: float) -> float | None:
        az, el = self._board.dish.axes[:2]
        for index in range(int((az.end_s() - now_s) / SAMPLE_S)):
            when = now_s + index * SAMPLE_S
            if self._board.above_floor_counts(when, az.shaft(when), el.shaft(when)) > FOUND_COUNTS:
                return when
        return None

    def _hold(self, run: int) -> None:
        """Stop, and go back by the way that braking took (assumed): the beam is narrower than that."""
        if run == self._run and self.running:
            heard_at_deg = self._board.dish.axes[0].count(self._board.now_s)[0]
            self.stop()
            self._board.put(0, heard_at_deg)
            if self._board.settings.found_text:
                self._board.host.say(f"{self._board.settings.found_text}\n")
