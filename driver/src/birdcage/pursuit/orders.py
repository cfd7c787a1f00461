"""Calls of other threads, waiting for the desk's own."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable

from birdcage.base.wake import Wake


class Orders:
    """A queue that wakes whoever takes from it."""

    def __init__(self) -> None:
        self._queue: deque[Callable[[], object]] = deque()
        self.wake = Wake()

    def put(self, order: Callable[[], object]) -> None:
        """Leave an order. Any thread; returns at once."""
        self._queue.append(order)
        self.wake.set()

    def carry_out(self) -> bool:
        """Carry out what waits; return whether anything did. The desk's thread alone."""
        any_done = False
        while self._queue:
            self._queue.popleft()()
            any_done = True
        return any_done
