"""What can be asked of the pursuit desk: the one list, for whoever stands before it."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable
from datetime import datetime
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from birdcage.base.config import Settings
    from birdcage.pursuit.desk_work import DeskWork
    from birdcage.pursuit.pass_listener import PassListener
    from birdcage.sky.observer import Observer
    from birdcage.sky.targets import Target

Order = Callable[["DeskWork"], object]
"""A call of the desk's work, to be made on the desk's own thread."""


class PursuitOrders(ABC):
    """Any thread; no call waits. What came of it stands in `DeskNow`, what went wrong in its `problem`."""

    @abstractmethod
    def ask(self, order: Order) -> None:
        """Leave an order for the desk's thread, after those that came before."""

    # --- what is chosen

    def search(self, text: str) -> None:
        """Look for targets as one types; with nothing typed: the favourites, and the bodies."""
        self.ask(lambda work: work.search(text))

    def locate(self, text: str) -> None:
        """Tell from now on where a target stands (`DeskNow.located`), without choosing it; empty ends that."""
        self.ask(lambda work: work.locate(text))

    def choose(self, text: str, target: Target | None = None) -> None:
        """Choose a target, as `birdcage where` takes it or as `TargetMatch.text` has it. What is followed goes on.

        With `target` it is that one, which need not be in the catalogue.
        """
        self.ask(lambda work: work.choose(text, target))

    def choose_pass(self, aos: datetime) -> None:
        """Choose a pass by its AOS, as one of `DeskNow.passes` has it."""
        self.ask(lambda work: work.choose_pass(aos))

    def set_time_offset(self, seconds: float) -> None:
        """Let the chosen satellite come so much later than computed; remembered with its date. At most an hour."""
        self.ask(lambda work: work.set_time_offset(seconds))

    def set_frequency(self, hertz: float | None) -> None:
        """Set the frequency of the chosen satellite's downlink; None for the usual one."""
        self.ask(lambda work: work.set_frequency(hertz))

    # --- what is done with it

    def watch(self) -> None:
        """Only show it: what was being followed is left, and the dish comes to rest."""
        self.leave()

    def aim_once(self) -> None:
        """Point where it stands now, once."""
        self.ask(lambda work: work.aim_once())

    def follow(self) -> None:
        """Follow the chosen pass, by a plan made for the dish as it stands now."""
        self.ask(lambda work: work.follow())

    def leave(self) -> None:
        """Leave what is being followed; the dish comes to rest where it is."""
        self.ask(lambda work: work.leave())

    def take_up(self) -> None:
        """Follow what was left unfinished (`DeskNow.unfinished`): a person has asked for it."""
        self.ask(lambda work: work.take_up(asked=True))

    def resume(self) -> None:
        """Follow again what STOP or a hand has ended or interrupted (`DeskNow.resumable`), autotrack included.

        Whoever asks has released the dish, and has given back what control he took.
        """
        self.ask(lambda work: work.resume())

    def forget_unfinished(self) -> None:
        """Do not offer it any more."""
        self.ask(lambda work: work.forget_unfinished())

    def set_autotrack(self, on: bool) -> None:
        """Follow the passes of the favourites one after the other, or no longer; what is followed goes on."""
        self.ask(lambda work: work.set_autotrack(on))

    def apply(self, settings: Settings, observer: Observer | None) -> None:
        """Use other settings and another place from now on."""
        self.ask(lambda work: work.apply(settings, observer))

    def add_listener(self, listener: PassListener) -> None:
        """Let something go along with every pass from now on, beside the log, the hooks and the receiver."""
        self.ask(lambda work: work.services.add(listener))
