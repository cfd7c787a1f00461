"""The desk: a target is chosen here, its pass planned, and the plan handed to the station and kept up to date.

It owns one thread. On a virtual clock there is none: a test calls `step`.
"""

from __future__ import annotations

import threading
from collections.abc import Callable
from datetime import datetime
from functools import partial
from typing import TYPE_CHECKING

from birdcage.base.clock import Clock
from birdcage.base.config import Settings
from birdcage.pursuit.desk_setup import DeskSetup
from birdcage.pursuit.desk_work import DeskWork
from birdcage.pursuit.now import DeskNow
from birdcage.pursuit.orders import Orders
from birdcage.sky.observer import Observer
from birdcage.station.events import Event, Followed, LinkChanged, PursuitChanged
from birdcage.station.station import Station

if TYPE_CHECKING:
    from birdcage.pursuit.pass_listener import PassListener
    from birdcage.sky.targets import Target


class PursuitDesk:
    """All methods but `step` are for any thread, and none of them waits; `tell` is called on the desk's thread.

    What goes wrong stands in `DeskNow.problem`, as a sentence.
    """

    def __init__(
        self, station: Station, clock: Clock, setup: DeskSetup, tell: Callable[[DeskNow], object], *,
        threads: bool = True,
    ) -> None:  # fmt: skip
        self._clock, self._tell, self._threads = clock, tell, threads
        self._orders = Orders()
        self._work = DeskWork(station, clock, setup, self._orders.put, threads=threads)
        self._thread: threading.Thread | None = None
        self._closing = False
        self._now = DeskNow(clock.utc())
        self._unsubscribe = station.subscribe(self._hear)
        self.crash: BaseException | None = None
        """What ended the thread, if a fault of birdcage did."""

    @property
    def now(self) -> DeskNow:
        """What the desk shows: immutable."""
        return self._now

    def start(self) -> None:
        """Begin, in a daemon thread where there are threads."""
        if self._threads:
            self._thread = threading.Thread(target=self._run, name="pursuit", daemon=True)
            self._thread.start()

    def close(self, timeout_s: float = 0.3) -> None:
        """End the desk, before the station is closed. What is being followed is offered at the next start.

        A second time does nothing more than wait again.
        """
        self._closing = True
        self._unsubscribe()
        self._orders.wake.set()
        if self._thread is not None:
            self._thread.join(timeout_s)
        if self._thread is None:
            self._work.end()
        if self._thread is None or not self._thread.is_alive():
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

    # --- what is chosen

    def search(self, text: str) -> None:
        """Look for targets as one types; with nothing typed: the favourites, and the bodies."""
        self._orders.put(partial(self._work.search, text))

    def locate(self, text: str) -> None:
        """Tell from now on where a target stands (`DeskNow.located`), without choosing it; empty ends that."""
        self._orders.put(partial(self._work.locate, text))

    def choose(self, text: str, target: Target | None = None) -> None:
        """Choose a target, as `birdcage where` takes it or as `Found.text` has it. What is followed goes on.

        With `target` it is that one, which need not be in the catalogue.
        """
        self._orders.put(partial(self._work.choose, text, target))

    def choose_pass(self, aos: datetime) -> None:
        """Choose a pass by its AOS, as one of `DeskNow.passes` has it."""
        self._orders.put(partial(self._work.choose_pass, aos))

    def set_time_offset(self, seconds: float) -> None:
        """Let the chosen satellite come so much later than computed; remembered with its date. At most an hour."""
        self._orders.put(partial(self._work.set_time_offset, seconds))

    def set_frequency(self, hertz: float | None) -> None:
        """Set the frequency of the chosen satellite's downlink; None for the usual one."""
        self._orders.put(partial(self._work.set_frequency, hertz))

    # --- what is done with it

    def watch(self) -> None:
        """Only show it: what was being followed is left, and the dish comes to rest."""
        self._orders.put(self._work.leave)

    def aim_once(self) -> None:
        """Point where it stands now, once."""
        self._orders.put(self._work.aim_once)

    def follow(self) -> None:
        """Follow the chosen pass, by a plan made for the dish as it stands now."""
        self._orders.put(self._work.follow)

    def leave(self) -> None:
        """Leave what is being followed; the dish comes to rest where it is."""
        self._orders.put(self._work.leave)

    def take_up(self) -> None:
        """Follow what was left unfinished (`DeskNow.unfinished`): a person has asked for it."""
        self._orders.put(partial(self._work.take_up, asked=True))

    def resume(self) -> None:
        """Follow again what STOP or a hand has ended or interrupted (`DeskNow.resumable`), autotrack included.

        Whoever asks has released the dish, and has given back what control he took.
        """
        self._orders.put(self._work.resume)

    def forget_unfinished(self) -> None:
        """Do not offer it any more."""
        self._orders.put(self._work.forget_unfinished)

    def set_autotrack(self, on: bool) -> None:
        """Follow the passes of the favourites one after the other, or no longer; what is followed goes on."""
        self._orders.put(partial(self._work.set_autotrack, on))

    def apply(self, settings: Settings, observer: Observer | None) -> None:
        """Use other settings and another place from now on."""
        self._orders.put(partial(self._work.apply, settings, observer))

    def add_listener(self, listener: PassListener) -> None:
        """Let something go along with every pass from now on, beside the log, the hooks and the receiver."""
        self._orders.put(partial(self._work.services.add, listener))

    # --- the desk's own thread

    def step(self) -> float:
        """Do what there is to do; return how many seconds of the clock it may rest then, 0 for more to do."""
        self._orders.wake.clear()
        self._orders.carry_out()
        rest_s = self._work.step()
        told = self._work.told()
        if told is not None and not self._closing:
            self._now = told
            self._tell(told)
        return rest_s

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
            self._now = DeskNow(self._clock.utc(), problem=f"The pursuit desk stopped: {crash!r}")
            self._tell(self._now)

    def _hear(self, event: Event) -> None:
        if isinstance(event, PursuitChanged | Followed | LinkChanged):
            self._orders.put(self._work.look_again)
