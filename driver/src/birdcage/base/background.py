"""A thread of its own for slow files: transcripts and journals never make the wire wait."""

from __future__ import annotations

import threading
from collections import deque
from collections.abc import Callable
from typing import Generic, TypeVar

Item = TypeVar("Item")


class BackgroundWriter(Generic[Item]):
    """Hands items to `handle` in a daemon thread, in order; when the queue is full it counts what it drops.

    `handle(items, dropped)` gets all that is waiting and how many were lost since the last call; it is also called
    with nothing after `quiet_s` without an item, and at the end, to let it finish what it holds back.
    """

    def __init__(
        self,
        name: str,
        handle: Callable[[list[Item], int], None],
        *,
        size: int = 4096,
        weigh: Callable[[Item], int] = lambda _item: 1,
        quiet_s: float | None = None,
    ) -> None:
        """Begin. `size` is how much may wait, in what `weigh` says of each item: items, or bytes."""
        self._handle = handle
        self._size, self._weigh = size, weigh
        self._weight = 0
        self._quiet_s = quiet_s
        self._waiting: deque[Item] = deque()
        self._dropped = 0
        self._busy = False
        self._closing = False
        self._changed = threading.Condition()
        self._thread = threading.Thread(target=self._run, name=name, daemon=True)
        self._thread.start()

    def offer(self, item: Item) -> bool:
        """Queue `item` without waiting; False if there was no room, or the writer is closed."""
        weight = self._weigh(item)
        with self._changed:
            if self._closing or self._weight + weight > self._size:
                self._dropped += 1
                return False
            self._waiting.append(item)
            self._weight += weight
            self._changed.notify_all()
            return True

    def flush(self, timeout_s: float = 2.0) -> bool:
        """Wait until all that was offered is handled; False if that took too long."""
        with self._changed:
            return self._changed.wait_for(lambda: not self._waiting and not self._busy, timeout_s)

    def close(self, timeout_s: float = 2.0) -> bool:
        """Handle what is waiting, then end the thread; False if that took too long (it then dies with the program)."""
        with self._changed:
            self._closing = True
            self._changed.notify_all()
        self._thread.join(timeout_s)
        return not self._thread.is_alive()

    def _run(self) -> None:
        held_back = False
        while True:
            with self._changed:
                timeout_s = self._quiet_s if held_back else None
                self._changed.wait_for(lambda: bool(self._waiting or self._closing), timeout_s)
                items, dropped = list(self._waiting), self._dropped
                self._waiting.clear()
                self._weight = self._dropped = 0
                self._busy = True
                ending = self._closing
            self._handle(items, dropped)
            held_back = bool(items)
            with self._changed:
                self._busy = False
                self._changed.notify_all()
                if ending:  # nothing was taken in since
                    break
        if held_back:
            self._handle([], 0)
