"""Two ways to the stand-in dish: in memory, on any clock, and a pty that any program can open."""

from __future__ import annotations

import contextlib
import math
import os
import select
import termios
import threading
import time
import tty

from .dish import StandIn
from .habits import Habits

NEVER_S = 0.2


class MemoryPort:
    """What a driver opens in a test: bytes, and when the next may come. At another speed it is garbage."""

    demo = False

    def __init__(self, dish: StandIn, name: str = "standin", baud: int | None = None) -> None:
        self.name, self.dish = name, dish
        self.heard = baud in (None, dish.habits.baud)

    def fileno(self) -> None:
        return None

    def pending(self) -> bool:
        return self.heard and self.dish.pending()

    def next_event(self) -> float:
        return self.dish.next_event() if self.heard else math.inf

    def read(self) -> bytes:
        data = self.dish.take()
        return data if self.heard else b""

    def write(self, data: bytes) -> None:
        if self.heard:
            self.dish.hear(data)

    def discard(self) -> None:
        self.dish.take()

    def close(self) -> None:
        self.heard = False


class PtyDish:
    """A stand-in dish on a pty of its own, served by a thread. `rate`: how many of its seconds pass in one."""

    def __init__(self, habits: Habits | None = None, *, rate: float = 1.0) -> None:
        begun = time.monotonic()
        self.rate = rate
        self.dish = StandIn(lambda: begun + (time.monotonic() - begun) * rate, habits)
        self._master, self._slave = os.openpty()
        tty.setraw(self._slave)
        os.set_blocking(self._master, False)
        self.path = os.ttyname(self._slave)
        self._speed = getattr(termios, f"B{self.dish.habits.baud}")
        self._wake, self._end = os.pipe()
        self._thread = threading.Thread(target=self._serve, daemon=True)
        self._thread.start()

    def _serve(self) -> None:
        while True:
            wait_s = min(max(self.dish.next_event() - self.dish._clock(), 0.0) / self.rate, NEVER_S)
            readable, _, _ = select.select([self._master, self._wake], [], [], wait_s)
            if self._wake in readable:
                return
            heard = termios.tcgetattr(self._slave)[4] == self._speed
            if self._master in readable:
                data = os.read(self._master, 4096)
                if heard:
                    self.dish.hear(data)
            said = self.dish.take()
            if said and heard:
                self._write(said)

    def _write(self, data: bytes) -> None:
        """Write what fits: a pty without a reader is full in the end."""
        with contextlib.suppress(BlockingIOError):
            os.write(self._master, data)

    def close(self) -> None:
        os.write(self._end, b"x")
        self._thread.join(5)
        for descriptor in (self._master, self._slave, self._wake, self._end):
            os.close(descriptor)

    def __enter__(self) -> PtyDish:
        return self

    def __exit__(self, *_problem: object) -> None:
        self.close()
