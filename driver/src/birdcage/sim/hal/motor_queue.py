"""Motors that move one after the other: a queue that keeps every move (`docs/reference/travler.md`, *Moving*)."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from dataclasses import dataclass

from birdcage.sim.axis import AxisMechanics
from birdcage.sim.machine import Machine

TOUCH_S = 1e-6
"""A motor that stops within this has stopped: dish time is rounded on its way through the timetable."""


@dataclass(frozen=True, slots=True, eq=False)
class QueuedMove:
    """One move. Where it goes is decided when it begins, as the way round depends on where the cable is then."""

    axis: AxisMechanics
    goal: Callable[[float], float]
    rate_deg_s: float | None = None


class MotorQueue:
    """Only one of its motors turns at a time; the next move begins when the last has ended."""

    def __init__(
        self, machine: Machine, axes: tuple[AxisMechanics, ...], started: Callable[[AxisMechanics], None]
    ) -> None:
        self.axes = axes
        self.on_idle: Callable[[], None] | None = None
        """Called when all is at rest and nothing waits."""
        self.held = False
        """While this is set, `on_idle` is not called."""
        self.current: QueuedMove | None = None
        """The move that began last."""
        self._machine = machine
        self._started = started
        self._waiting: deque[QueuedMove] = deque()
        self._run = 0

    @property
    def busy(self) -> bool:
        """Whether a motor turns or a move waits."""
        return bool(self._waiting) or self.end_s() > self._machine.dish_s + TOUCH_S

    def end_s(self) -> float:
        """When the motors that turn now come to rest."""
        return max(axis.end_s() for axis in self.axes)

    def put(self, order: QueuedMove) -> None:
        """Move after everything that was ordered before."""
        self._waiting.append(order)
        self.go_on()

    def drop(self) -> None:
        """Forget what waits; what moves goes on."""
        self._waiting.clear()
        self._run += 1

    def go_on(self) -> None:
        """Begin the next move if nothing moves, else look again when it has ended."""
        self._run += 1
        run, now = self._run, self._machine.dish_s
        while self.end_s() <= now + TOUCH_S:
            if not self._waiting:
                if self.on_idle is not None and not self.held:
                    self.on_idle()
                return
            self.current = order = self._waiting.popleft()
            order.axis.retarget(now, order.goal(now), rate_deg_s=order.rate_deg_s)
            self._started(order.axis)
        self._machine.at_dish(self.end_s(), lambda: self._ended(run))

    def _ended(self, run: int) -> None:
        if run == self._run:
            self.go_on()
