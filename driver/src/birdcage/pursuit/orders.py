"""What can be asked of the pursuit desk: the one list, for whoever stands before it."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from datetime import datetime
from typing import TYPE_CHECKING

from birdcage.pursuit.face_search import OWN

if TYPE_CHECKING:
    from birdcage.base.config import Settings
    from birdcage.pursuit.desk_work import DeskWork
    from birdcage.pursuit.pass_listener import PassListener
    from birdcage.sky.observer import Observer
    from birdcage.sky.targets import Target


class Order(ABC):
    """One order, as data. `order_form` writes those that another program may give as JSON."""

    __slots__ = ()

    @abstractmethod
    def carry_out(self, work: DeskWork) -> None:
        """Do it, on the desk's own thread."""

    def carry_out_for(self, face: str, work: DeskWork) -> None:  # noqa: ARG002 - all faces have one choice
        """Do it for one of the faces at the desk."""
        self.carry_out(work)


class FaceOrder(Order):
    """One of which each face has its own answer: what one types."""

    __slots__ = ()

    def carry_out(self, work: DeskWork) -> None:
        """Do it for the desk's own program."""
        self.carry_out_for(OWN, work)

    @abstractmethod
    def carry_out_for(self, face: str, work: DeskWork) -> None:
        """Do it for one of the faces at the desk."""


@dataclass(frozen=True, slots=True)
class SearchOrder(FaceOrder):
    """Look for targets as one types."""

    text: str

    def carry_out_for(self, face: str, work: DeskWork) -> None:
        """Do it."""
        work.faces.search(self.text, face)


@dataclass(frozen=True, slots=True)
class LocateOrder(FaceOrder):
    """Tell where a target stands from now on."""

    text: str

    def carry_out_for(self, face: str, work: DeskWork) -> None:
        """Do it."""
        work.faces.locate(self.text, face)


@dataclass(frozen=True, slots=True)
class ChooseOrder(Order):
    """Choose a target."""

    text: str
    target: Target | None = None

    def carry_out(self, work: DeskWork) -> None:
        """Do it."""
        work.choose(self.text, self.target)


@dataclass(frozen=True, slots=True)
class ChoosePassOrder(Order):
    """Choose a pass."""

    aos: datetime

    def carry_out(self, work: DeskWork) -> None:
        """Do it."""
        work.choose_pass(self.aos)


@dataclass(frozen=True, slots=True)
class TimeOffsetOrder(Order):
    """Let the chosen satellite come later."""

    seconds: float

    def carry_out(self, work: DeskWork) -> None:
        """Do it."""
        work.set_time_offset(self.seconds)


@dataclass(frozen=True, slots=True)
class FrequencyOrder(Order):
    """Set the frequency of the downlink."""

    hertz: float | None

    def carry_out(self, work: DeskWork) -> None:
        """Do it."""
        work.set_frequency(self.hertz)


@dataclass(frozen=True, slots=True)
class AimOrder(Order):
    """Point where the choice stands now, once."""

    def carry_out(self, work: DeskWork) -> None:
        """Do it."""
        work.aim_once()


@dataclass(frozen=True, slots=True)
class FollowOrder(Order):
    """Follow the chosen pass."""

    def carry_out(self, work: DeskWork) -> None:
        """Do it."""
        work.follow()


@dataclass(frozen=True, slots=True)
class LeaveOrder(Order):
    """Leave what is followed."""

    def carry_out(self, work: DeskWork) -> None:
        """Do it."""
        work.leave()


@dataclass(frozen=True, slots=True)
class TakeUpOrder(Order):
    """Follow what was left unfinished."""

    def carry_out(self, work: DeskWork) -> None:
        """Do it."""
        work.take_up(asked=True)


@dataclass(frozen=True, slots=True)
class ResumeOrder(Order):
    """Follow again what STOP or a hand has ended."""

    def carry_out(self, work: DeskWork) -> None:
        """Do it."""
        work.resume()


@dataclass(frozen=True, slots=True)
class ForgetOrder(Order):
    """Do not offer what was left unfinished any more."""

    def carry_out(self, work: DeskWork) -> None:
        """Do it."""
        work.forget_unfinished()


@dataclass(frozen=True, slots=True)
class AutotrackOrder(Order):
    """Switch autotrack."""

    on: bool

    def carry_out(self, work: DeskWork) -> None:
        """Do it."""
        work.set_autotrack(self.on)


@dataclass(frozen=True, slots=True)
class ReadSettingsOrder(Order):
    """Read the settings again, and use them and the place that they name."""

    def carry_out(self, work: DeskWork) -> None:
        """Do it."""
        work.read_settings()


@dataclass(frozen=True, slots=True)
class ApplyOrder(Order):
    """Use other settings and another place. It has no JSON form."""

    settings: Settings
    observer: Observer | None

    def carry_out(self, work: DeskWork) -> None:
        """Do it."""
        work.apply(self.settings, self.observer)


@dataclass(frozen=True, slots=True)
class ListenOrder(Order):
    """Let something go along with every pass. It has no JSON form."""

    listener: PassListener

    def carry_out(self, work: DeskWork) -> None:
        """Do it."""
        work.services.add(self.listener)


class PursuitOrders(ABC):
    """Any thread; no call waits. What came of it stands in `DeskNow`, what went wrong in its `problem`."""

    @abstractmethod
    def ask(self, order: Order) -> None:
        """Leave an order for the desk's thread, after those that came before."""

    # --- what is chosen

    def search(self, text: str) -> None:
        """Look for targets as one types; with nothing typed: the favourites, and the bodies."""
        self.ask(SearchOrder(text))

    def locate(self, text: str) -> None:
        """Tell from now on where a target stands (`DeskNow.located`), without choosing it; empty ends that."""
        self.ask(LocateOrder(text))

    def choose(self, text: str, target: Target | None = None) -> None:
        """Choose a target, as `birdcage where` takes it or as `TargetMatch.text` has it. What is followed goes on.

        With `target` it is that one, which need not be in the catalogue.
        """
        self.ask(ChooseOrder(text, target))

    def choose_pass(self, aos: datetime) -> None:
        """Choose a pass by its AOS, as one of `DeskNow.passes` has it."""
        self.ask(ChoosePassOrder(aos))

    def set_time_offset(self, seconds: float) -> None:
        """Let the chosen satellite come so much later than computed; remembered with its date. At most an hour."""
        self.ask(TimeOffsetOrder(seconds))

    def set_frequency(self, hertz: float | None) -> None:
        """Set the frequency of the chosen satellite's downlink; None for the usual one."""
        self.ask(FrequencyOrder(hertz))

    # --- what is done with it

    def watch(self) -> None:
        """Only show it: what was being followed is left, and the dish comes to rest."""
        self.leave()

    def aim_once(self) -> None:
        """Point where it stands now, once."""
        self.ask(AimOrder())

    def follow(self) -> None:
        """Follow the chosen pass, by a plan made for the dish as it stands now."""
        self.ask(FollowOrder())

    def leave(self) -> None:
        """Leave what is being followed; the dish comes to rest where it is."""
        self.ask(LeaveOrder())

    def take_up(self) -> None:
        """Follow what was left unfinished (`DeskNow.unfinished`): a person has asked for it."""
        self.ask(TakeUpOrder())

    def resume(self) -> None:
        """Follow again what STOP or a hand has ended or interrupted (`DeskNow.resumable`), autotrack included.

        Whoever asks has released the dish, and has given back what control he took.
        """
        self.ask(ResumeOrder())

    def forget_unfinished(self) -> None:
        """Do not offer it any more."""
        self.ask(ForgetOrder())

    def set_autotrack(self, on: bool) -> None:
        """Follow the passes of the favourites one after the other, or no longer; what is followed goes on."""
        self.ask(AutotrackOrder(on))

    def apply(self, settings: Settings, observer: Observer | None) -> None:
        """Use other settings and another place from now on."""
        self.ask(ApplyOrder(settings, observer))

    def read_settings(self) -> None:
        """Read birdcage.toml again where the desk is, and use what it says from now on."""
        self.ask(ReadSettingsOrder())

    def add_listener(self, listener: PassListener) -> None:
        """Let something go along with every pass from now on, beside the log, the hooks and the receiver."""
        self.ask(ListenOrder(listener))
