"""Signals that end a program, heard on a thread of their own and obeyed even if the main thread is stuck.

Python runs a signal handler on the main thread, between two of its instructions. A main thread that waits for a
terminal which takes no more output never gets there. So the C handler writes the signal's number into a pipe
(`signal.set_wakeup_fd`), and a thread reads it: STOP goes out from there. If the main thread then does not leave in
time, the process ends all the same (docs/decisions/0024).
"""

from __future__ import annotations

import os
import signal
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType

NAMES = ("SIGINT", "SIGTERM", "SIGHUP", "SIGQUIT", "SIGBREAK")
"""Which signals end a program; not every system has all of them."""
STATUS = 128
"""Plus the signal's number: the exit status of a program that a signal ended."""
PATIENCE_S = 3.0
"""How long the main thread may take, after a signal, to begin to leave."""
LAST_S = 5.0
"""How long the last work may take where the main thread does not do it: STOP, and putting changed speeds back."""

Hear = Callable[[int], object]


class SignalListener:
    """Hears the signals that end this program. Made and closed on the main thread; one at a time."""

    def __init__(self, *, patience_s: float = PATIENCE_S, end: Callable[[int], object] = os._exit) -> None:
        """Prepare; `end(status)` ends the process at once."""
        self._patience_s, self._end = patience_s, end
        self.number: int | None = None
        """The first signal that came."""
        self._hear: Hear | None = None
        self._last: Callable[[], object] = lambda: None
        self._deadline = 0.0
        self._open = True
        self._leaving = self._raised = False
        self._changed = threading.Condition()
        self._reader, self._writer = os.pipe()
        if os.name == "posix":
            os.set_blocking(self._writer, False)
        self._handlers: dict[int, object] = {}
        self._wakeup_fd = -1
        self._thread: threading.Thread | None = None

    def start(self) -> None:
        """Take the signals, except those that were ignored from the start (nohup, a job in the background)."""
        self._thread = threading.Thread(target=self._listen, name="signals", daemon=True)
        self._thread.start()
        for number in (getattr(signal, name, None) for name in NAMES):
            if number is not None and signal.getsignal(number) is not signal.SIG_IGN:
                self._handlers[number] = signal.signal(number, self._on_main_thread)
        self._wakeup_fd = signal.set_wakeup_fd(self._writer, warn_on_full_buffer=False)

    def tell(self, hear: Hear, last: Callable[[], object]) -> None:
        """Call `hear(number)` for each signal from now on, on the thread of the signals; also for one that has come.

        `last` is called if the main thread does not begin to leave in time: it has to do all that must not be left
        out. Before `tell`, a signal raises SystemExit on the main thread.
        """
        with self._changed:
            self._hear, self._last, self._leaving = hear, last, False
            number = self.number
        if number is not None:
            hear(number)

    def take(self, number: int) -> None:
        """Act as if that signal had come. Any thread."""
        with self._changed:
            if self.number is None:
                self.number = number
                self._deadline = time.monotonic() + self._patience_s
                threading.Thread(target=self._end_in_time, args=(number,), name="hard end", daemon=True).start()
            hear = self._hear
        if hear is not None:
            hear(number)

    def leave(self, within_s: float) -> None:
        """Say that the main thread is on its way out and does the last work itself, in that long at most.

        It counts from now, or from a signal that comes later. Where it is too late, this waits for the end.
        """
        with self._changed:
            self._leaving, self._patience_s = True, within_s
            self._deadline = time.monotonic() + within_s
            self._changed.notify_all()

    def status(self, otherwise: int) -> int:
        """Return the exit status: the signal's if one came."""
        return otherwise if self.number is None else STATUS + self.number

    def close(self) -> None:
        """Give the signals back."""
        with self._changed:
            self._open = False
            self._changed.notify_all()
        if self._thread is not None:
            signal.set_wakeup_fd(self._wakeup_fd)
            for number, handler in self._handlers.items():
                signal.signal(number, handler)  # type: ignore[arg-type] # as `signal` returned it
        os.close(self._writer)
        if self._thread is not None:
            self._thread.join()
        os.close(self._reader)

    def _on_main_thread(self, number: int, _frame: FrameType | None) -> None:
        if self._hear is None and not self._raised:
            self._raised = True
            raise SystemExit(STATUS + number)
        if os.name == "nt":  # there the wakeup descriptor is asyncio's while its loop runs
            os.write(self._writer, bytes([number]))

    def _listen(self) -> None:
        while numbers := os.read(self._reader, 64):
            for number in numbers:
                if number in self._handlers:
                    self.take(number)

    def _end_in_time(self, number: int) -> None:
        with self._changed:
            while self._open and (left_s := self._deadline - time.monotonic()) > 0.0:
                self._changed.wait(left_s)
            if not self._open:
                return
            # The lock is kept: a main thread that comes late waits in `leave` or `close`.
            if not self._leaving:
                worker = threading.Thread(target=self._last, name="last work", daemon=True)
                worker.start()
                worker.join(LAST_S)
            self._end(STATUS + number)


@contextmanager
def interrupt_quits() -> Iterator[None]:
    """Let Ctrl+C end the process at once and in silence, while modules are imported and nothing is to be undone.

    A KeyboardInterrupt there may fall into a callback of the import machinery: then it is printed, and lost.
    """
    before = signal.getsignal(signal.SIGINT)
    if before is not signal.default_int_handler or threading.current_thread() is not threading.main_thread():
        yield
        return
    signal.signal(signal.SIGINT, _quit)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)


def _quit(number: int, _frame: FrameType | None) -> None:
    os._exit(STATUS + number)
