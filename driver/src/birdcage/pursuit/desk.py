"""The desk: a target is chosen here, its pass planned, and the plan handed to the station and kept up to date.

It owns one thread. On a virtual clock there is none: a test calls `step`.
"""

from __future__ import annotations

import threading
from collections import deque
from collections.abc import Callable
from functools import partial

from birdcage.base.clock import Clock
from birdcage.base.wake import Wake
from birdcage.pursuit.desk_setup import DeskSetup
from birdcage.pursuit.desk_work import DeskWork
from birdcage.pursuit.face_search import OWN
from birdcage.pursuit.now import DeskNow
from birdcage.pursuit.orders import Order, PursuitOrders
from birdcage.station.events import Event, Followed, LinkChanged, PursuitChanged
from birdcage.station.station import Station


class PursuitDesk(PursuitOrders):
    """All methods but `step` are for any thread; `tell` is called on the desk's thread."""

    def __init__(
        self, station: Station, clock: Clock, setup: DeskSetup, tell: Callable[[DeskNow], object], *,
        threads: bool = True,
    ) -> None:  # fmt: skip
        self._clock, self._tell, self._threads = clock, tell, threads
        self._orders = _OrderQueue()
        self._work = DeskWork(station, clock, setup, self._orders.put, threads=threads)
        self._faces: dict[str, Callable[[DeskNow], object]] = {}
        self._thread: threading.Thread | None = None
        self._starting = threading.Lock()
        """Kept until the thread runs: one that was not started yet can't be waited for."""
        self._closing = False
        self._now = DeskNow(clock.utc())
        self._unsubscribe = station.subscribe(self._hear, PursuitChanged, Followed, LinkChanged)
        self.crash: BaseException | None = None
        """What ended the thread, if a fault of birdcage did."""

    @property
    def now(self) -> DeskNow:
        """What the desk shows: immutable."""
        return self._now

    def start(self) -> None:
        """Begin, in a daemon thread where there are threads."""
        if self._threads:
            with self._starting:
                self._thread = threading.Thread(target=self._run, name="pursuit", daemon=True)
                self._thread.start()

    def close(self, timeout_s: float = 0.3) -> None:
        """End the desk, before the station is closed. What is being followed is offered at the next start.

        A second time does nothing more than wait again.
        """
        self._closing = True
        self._unsubscribe()
        self._orders.wake.set()
        with self._starting:
            thread = self._thread
        if thread is not None:
            thread.join(timeout_s)
        if thread is None:
            self._work.end()
        if thread is None or not thread.is_alive():
            self._orders.wake.close()

    @property
    def owes(self) -> bool:
        """Whether its end has something to leave: what is followed, a pass in the log, a hook, a receiver."""
        return self._work.owes

    def wait(self, timeout_s: float) -> bool:
        """Wait until it has ended, after `close`; False if that took too long."""
        if self._thread is None:
            return True
        self._thread.join(timeout_s)
        return not self._thread.is_alive()

    def ask(self, order: Order) -> None:
        """Leave an order. Any thread."""
        self.ask_as(OWN, order)

    def ask_as(self, face: str, order: Order) -> None:
        """Leave an order of another face than this program's own. Any thread."""
        self._orders.put(partial(order.carry_out_for, face, self._work))

    def join(self, face: str, tell: Callable[[DeskNow], object]) -> Callable[[], None]:
        """Let another face stand at the desk: it is told what it is shown, on the desk's thread. Returns its end."""

        def begin() -> None:
            self._work.faces.join(face)
            self._faces[face] = tell

        def end() -> None:
            self._faces.pop(face, None)
            self._work.faces.part(face)

        self._orders.put(begin)
        return partial(self._orders.put, end)

    # --- the desk's own thread

    def step(self) -> float:
        """Do what there is to do; return how many seconds of the clock it may rest then, 0 for more to do."""
        self._orders.wake.clear()
        self._orders.carry_out()
        rest_s = self._work.step()
        told = self._work.told()
        if told is not None and not self._closing:
            self._show(told)
        return rest_s

    def _show(self, told: DeskNow) -> None:
        self._now = self._work.faces.seen_by(OWN, told)
        self._tell(self._now)
        for face, tell in self._faces.items():
            tell(self._work.faces.seen_by(face, told))

    def _run(self) -> None:
        try:
            while not self._closing:
                rest_s = self.step()
                if not self._closing:
                    self._clock.wait(None, self._clock.monotonic() + rest_s, self._orders.wake)
            self._work.end()
        except BaseException as crash:  # noqa: BLE001 - whatever it is, the dish stays in the hands of the station
            # Kept for the face to tell: a traceback from this thread would land in the middle of its screen.
            self.crash = crash
            self._show(DeskNow(self._clock.utc(), problem=f"The pursuit desk stopped: {crash!r}"))

    def _hear(self, _event: Event) -> None:
        self._orders.put(self._work.look_again)


class _OrderQueue:
    """Calls of other threads, waiting for the desk's own; wakes whoever takes from it."""

    def __init__(self) -> None:
        self._waiting: deque[Callable[[], object]] = deque()
        self.wake = Wake()

    def put(self, order: Callable[[], object]) -> None:
        """Leave an order. Any thread; returns at once."""
        self._waiting.append(order)
        self.wake.set()

    def carry_out(self) -> None:
        """Carry out what waits. The desk's thread alone."""
        while self._waiting:
            self._waiting.popleft()()
