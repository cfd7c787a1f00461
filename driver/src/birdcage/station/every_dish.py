"""STOP for every dish of one program: one after the other, and around one whose wire is stuck."""

from __future__ import annotations

import threading
from collections.abc import Callable, Sequence
from contextlib import suppress
from functools import partial

Deed = Callable[[], object]

STUCK_S = 0.003
"""After this long the second thread takes the others: a first byte leaves in about one millisecond."""


def do_each(deeds: Sequence[Deed]) -> None:
    """Do all of them in this thread alone, in their order; the first error is raised once all the others are done."""
    wrong = list[Exception]()
    for deed in deeds:
        try:
            deed()
        except Exception as error:  # noqa: BLE001 - the others come first
            wrong.append(error)
    if wrong:
        raise wrong[0]


class EveryDish:
    """Does one thing to each of several dishes, in the calling thread.

    A write to an adapter that is stuck may take 0.2 s. So a second thread looks on, and does what is left where the
    calling one hangs. What both do must then be one: STOP is, as calls within 0.2 s are one. Closing a session is not.
    """

    def __init__(self, dishes: int) -> None:
        """Prepare for so many. With several the second thread begins now, as beginning one takes a while."""
        self._wanted = threading.Semaphore(0)
        self._round: tuple[list[Deed], threading.Event] | None = None
        self._thread: threading.Thread | None = None
        if dishes > 1:
            self._thread = threading.Thread(target=self._look_on, name="every dish", daemon=True)
            self._thread.start()

    def do(self, deeds: Sequence[Deed]) -> None:
        """Do all of them, in their order; one that raises ends none of the others. Any thread."""
        left, done = list(deeds), threading.Event()
        if self._thread is not None:
            self._round = left, done
            self._wanted.release()

        def do(deed: Deed) -> None:
            try:
                deed()
            finally:
                left.remove(deed)

        try:
            do_each([partial(do, deed) for deed in deeds])
        finally:
            done.set()

    def close(self) -> None:
        """End the second thread."""
        self._round = None
        self._wanted.release()

    def _look_on(self) -> None:
        while self._wanted.acquire() and (this := self._round) is not None:
            left, done = this
            if not done.wait(STUCK_S):
                for deed in left[1:]:
                    # The calling thread does the same, and raises what is wrong with it. This one lives for the next.
                    with suppress(Exception):
                        deed()
