"""One command's dealings with a station, its own or that of another program: asking, waiting, STOP."""

from __future__ import annotations

import queue
from abc import ABC, abstractmethod
from collections.abc import Callable
from concurrent.futures import Future

from birdcage.base.errors import BirdcageError, LinkError, NoReply
from birdcage.base.reason import Reason
from birdcage.cli.exits import EndedBySignal
from birdcage.cli.say import Progress
from birdcage.station.access import StationAccess
from birdcage.station.events import Event, StopConfirmed
from birdcage.station.network_state import NetworkState
from birdcage.station.requests import Request
from birdcage.station.state import Activity, LinkPhase, StationState, StopReport

SLICE_S = 0.1
"""How long a wait goes without looking round: on Windows no signal ends it."""
CONFIRM_S = 6.0
"""How long the end of a command waits for the dish to confirm a STOP."""
NOTHING_MOVED_S = 1.0
"""How long it waits when nothing was moving: to prove that a dish stands still may take longer than a person does."""

Hear = Callable[[Event], None]


class StationCommand(ABC):
    """Waits for a station. Signals end every wait with `EndedBySignal`."""

    station: StationAccess

    def __init__(self, station: StationAccess, *, moves: bool) -> None:
        self.station = station
        self.progress = Progress()
        self.confirmed: StopReport | None = None
        """What the dish said to the last STOP."""
        self.closing = False
        self.stop_called = False
        """Whether this command called STOP. The station notes it a little later."""
        self.leave_moving = False
        """Set when the motion shall outlive the command."""
        self.moves = moves
        self.hear_all: Hear | None = None
        """Hears every event, to the last one of the station: also while the end of this command waits for STOP."""
        self.unanswered: Request | None = None
        """What was asked and is waited for."""
        self._events: queue.SimpleQueue[Event | None] = queue.SimpleQueue()
        self.number: int | None = None
        """The signal that ends this command."""
        self.station.subscribe(self._events.put)

    @property
    def state(self) -> StationState:
        """What is known now."""
        return self.station.state

    @property
    def now(self) -> float:
        """Monotonic seconds of the station's clock."""
        return self.station.clock.monotonic()

    @property
    def crash(self) -> BaseException | None:
        """What has ended the station in this program, if something has."""
        return None

    @abstractmethod
    def on_signal(self, number: int) -> None:
        """Do what comes before anything else, and end the wait under way. On the thread of the signals."""

    @abstractmethod
    def call_stop(self, by: str, *, leaving: bool = False) -> None:
        """STOP: it is on its way when this returns. `leaving`: the dish is not held for other programs."""

    def bar(self) -> None:  # noqa: B027 - the station of another program goes on
        """Let nothing begin to move any more in a dish on a port of its own."""

    @abstractmethod
    def show_network(self, network: NetworkState | None) -> None:
        """Show a server for network clients, and who they are, in the station; None: it has ended. Any thread."""

    @abstractmethod
    def let_go(self) -> str:
        """Let go of the station without a word, and return where the dish is left. Any thread."""

    def close(self) -> str:
        """Let go of the station, and return where the dish is left."""
        self.progress.clear()
        self.closing = True
        farewell = self.let_go()
        while not self._events.empty():
            self._take(self._events.get())
        return farewell

    def look_anew(self) -> None:  # noqa: B027 - on a port of its own it was read as the link came up
        """Have the position read again, where it may be an old one."""

    def end_wait(self, number: int) -> None:
        """End the wait under way for a signal. Any thread."""
        self.number = number
        self._events.put(None)

    def come_up(
        self, timeout_s: float, *, patient: bool = False, hear: Hear | None = None,
        each_time: Callable[[], None] = lambda: None,
    ) -> StationState:  # fmt: skip
        """Wait until the dish answers. LinkError when the port can't be had, NoReply when the dish does not answer.

        Someone patient waits out the silence (of a dish that boots) until the time is over.
        """
        deadline = self.now + timeout_s
        while self.state.link.state is not LinkPhase.UP:
            link, over = self.state.link, self.now >= deadline
            if link.state is LinkPhase.LOST and (over or not patient or link.last_reply is None):
                raise LinkError(link.detail)
            silent = link.state is LinkPhase.SILENT and (not patient or link.reason is Reason.WRONG_FIRMWARE)
            if over or silent:
                raise NoReply(link.detail, reason=link.reason)
            self.look(hear)
            each_time()
        return self.state

    def ask(self, request: Request, timeout_s: float, hear: Hear | None = None) -> object:
        """Submit a request and wait for its result, which may be the error that it raises."""
        self.unanswered = request  # before it is sent: a signal may come at any time
        try:
            future = self.station.submit(request)
            self.wait(future, timeout_s, hear)
            return future.result()
        finally:
            self.unanswered = None

    def wait(self, future: Future[object], timeout_s: float, hear: Hear | None = None) -> None:
        """Wait for a future; BirdcageError when it takes too long."""
        deadline = self.now + timeout_s
        while not future.done():
            if self.now >= deadline:
                raise BirdcageError(f"Not done within {timeout_s:.0f} s.", reason=Reason.TIMEOUT)
            self.look(hear)
        if self.number is not None:
            raise EndedBySignal(self.number)

    def look(self, hear: Hear | None = None, wait_s: float = SLICE_S) -> bool:
        """Wait a moment for something to happen; return whether it did.

        Raises Ended after a signal, and what ended the station's thread.
        """
        happened = self._next(hear, wait_s)
        if self.number is not None:
            raise EndedBySignal(self.number)
        if self.crash is not None:
            raise self.crash
        return happened

    def _next(self, hear: Hear | None = None, wait_s: float = SLICE_S) -> bool:
        try:
            event = self._events.get(timeout=wait_s)
        except queue.Empty:
            return False
        self._take(event)
        if event is not None and hear is not None:
            hear(event)
        return True

    def _take(self, event: Event | None) -> None:
        if isinstance(event, StopConfirmed):
            self.confirmed = event.report
        if event is not None and self.hear_all is not None:
            self.hear_all(event)

    @property
    def in_motion(self) -> bool:
        """Whether the dish moves because of this command."""
        return self.state.motion is not None or self.state.activity in (
            Activity.SLEWING, Activity.STOPPING, Activity.HOMING, Activity.STOWING, Activity.FOLLOWING,
            Activity.SWEEPING, Activity.MOTOR_RUN,
        )  # fmt: skip

    def stopped_since(self, since: float) -> StopReport | None:
        """Return the last STOP, if it was called at `since` or later."""
        last = self.state.last_stop
        return None if last is None or last.at < since else last

    def stop(self, by: str) -> StopReport | None:
        """STOP, and wait for what came of it; None when nothing did in time."""
        called = self.now
        self.call_stop(by)
        return self.settle(called)

    def settle(self, since: float, *, leaving: bool = False) -> StopReport | None:
        """Wait for what came of a STOP that was called at `since` or later.

        Who is `leaving` does not wait for the proof that a dish which nothing had moved stands still.
        """
        begun = self.now
        while self.now < begun + CONFIRM_S and self.crash is None:
            if self.confirmed is not None and self.confirmed.at >= since:
                return self.confirmed
            last = self.stopped_since(since)
            idle = last is not None and last.means == "nothing moved"
            if leaving and idle and self.now >= begun + NOTHING_MOVED_S:
                return None
            self._next()
        return None
