"""How the app ends: STOP goes out first, the terminal is given back, and the exit status says why."""

from __future__ import annotations

import signal
from collections.abc import Callable
from typing import Protocol

from birdcage.base.signals import STATUS
from textual.app import App

from birdcage_tui.shell.dishes import Dishes
from birdcage_tui.shell.key_queue import KeyQueue
from birdcage_tui.shown.view import YOU


class EndingHost(Protocol):
    """The app, seen from its end."""

    dishes: Dishes
    keys: KeyQueue

    def soon(self, work: Callable[[], None]) -> None:
        """Do something soon on the app's thread. Any thread."""


class Ending:
    """Ends the app by a key, a signal or a terminal that is gone; `run` closes the session then."""

    def __init__(self, app: App[None], host: EndingHost) -> None:
        self._app, self._host = app, host
        self.anew: int | None = None
        """Which dish, from 1, was found to be another one: the app begins again at once, with another session."""
        self.number: int | None = None
        """The signal that ends the app."""
        self.take_signal: Callable[[int], object] | None = None
        """Ends the app as that signal does, and its process if the app does not end; `run` sets it."""

    def begin_anew(self) -> None:
        """End, and begin again with the settings as they are then: the dish that is shown is another one."""
        self.anew = self._host.dishes.number
        self.leave()

    def leave(self, by: str = YOU, status: int = 0) -> None:
        """STOP first if a dish of ours moves; give the terminal back."""
        self._host.dishes.leave(by)
        self._host.keys.close()
        for dish in self._host.dishes.all:
            dish.feeds.sky.close()
        self._app.exit(return_code=status)

    def by_signal(self, number: int) -> None:
        """End as Ctrl+Q does. Any thread: STOP goes out from here, as the app's own thread may be stuck."""
        self.number = number
        if number == signal.SIGINT:
            self._host.dishes.stop_elsewhere("Ctrl+C")  # a person's; what else ends this app leaves those alone
        self._host.dishes.leave("signal")
        self._host.soon(self.leave_by_signal)

    def leave_by_signal(self) -> None:
        """Leave with the status of the signal that came, if one did."""
        if self.number is not None:
            self.leave("signal", STATUS + self.number)

    def terminal_gone(self) -> None:
        """End as by SIGHUP: the driver has found the terminal closed. Any thread."""
        (self.take_signal or self.by_signal)(signal.SIGHUP)
