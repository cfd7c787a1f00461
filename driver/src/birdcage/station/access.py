"""What a face needs of a station, whether that is in its own program or in another one."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import Future
from typing import Protocol

from birdcage.base.clock import Clock
from birdcage.station.events import Event
from birdcage.station.raw import MenuCommand, TranscriptEntry, Verdict
from birdcage.station.requests import Request
from birdcage.station.state import StationState


class StationAccess(Protocol):
    """Kept by `Station` itself, and by what is attached to the station of another program. All of it for any thread."""

    @property
    def clock(self) -> Clock:
        """What the times in state and events are counted by."""

    @property
    def state(self) -> StationState:
        """What is known now: immutable."""

    def submit(self, request: Request) -> Future[object]:
        """Ask for something. The future holds its result, or a `BirdcageError` that says why not."""

    def subscribe(self, listener: Callable[[Event], None], *kinds: type[Event]) -> Callable[[], None]:
        """Hear the events of these kinds, all by default: do nothing slow there. Returns what ends it."""

    def stop(self, by: str) -> None:
        """STOP: its first bytes are on their way when this returns, or the station's program was told."""

    def own_signal(self, source: str, holder: str) -> None:
        """Say who owns a signal source now: a target, or `monitor`; empty: it is free."""


class FaceStation(StationAccess, Protocol):
    """What the app needs beyond that: what a raw line would do, what the wire says. Any thread."""

    @property
    def has_prompt(self) -> bool:
        """Whether the machine shows a prompt; without one its console is a plain line terminal."""

    def judge(self, line: str) -> Verdict:
        """Say what a raw line would do in the dish's present menu, before it is sent. Sends nothing."""

    def only_asks(self, line: str, prompt: str) -> bool:
        """Return whether a line that went out at this prompt changes nothing but the menu."""

    def says_target(self, text: str) -> bool:
        """Return whether a line from the machine does nothing but say where it goes."""

    def is_prompt(self, text: str) -> bool:
        """Return whether a line from the machine is a prompt and nothing else."""

    def is_steering(self) -> bool:
        """Return whether a pursuit sends what goes out now, and not STOP or another holder."""

    def commands(self, menu: str | None) -> tuple[MenuCommand, ...]:
        """Return the commands of a menu: the documented ones, and what the dish has told."""


class FaceSession(Protocol):
    """A station for as long as an app runs: its own, or that of another program."""

    @property
    def station(self) -> FaceStation:
        """The station itself."""

    @property
    def clock(self) -> Clock:
        """What the times in its state and events are counted by."""

    @property
    def crash(self) -> BaseException | None:
        """What ended the station's thread in this program, if something did."""

    @property
    def via(self) -> str:
        """The program that drives the dish for this one: `birdcage station run`. Empty where this one does itself."""

    @property
    def detached(self) -> bool:
        """Whether the program that drove the dish for this one is gone, and no other was found."""

    def start(self) -> None:
        """Begin, after the first frame."""

    def on_wire(self, listener: Callable[[TranscriptEntry], None]) -> Callable[[], None]:
        """Call `listener` with every chunk that passes on the wire, and every remark; the result ends that.

        BirdcageError where the wire can't be heard.
        """

    def bar(self) -> bool:
        """Let nothing begin to move in a dish of the app's own from now on; return whether it may be moving.

        Any thread; waits for nothing.
        """

    def leave(self, by: str) -> None:
        """The app is about to end: STOP for a dish of its own, which then is not held for the programs that follow.

        Another program's station goes on.
        """

    def close(self) -> str:
        """Let go of the station, and return a sentence that says what becomes of the dish."""
