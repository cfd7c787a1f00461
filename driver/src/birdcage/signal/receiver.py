"""The receiver over rigctl as a source: one connection, which a pass and those who look at its level take in turn."""

from __future__ import annotations

import math
import threading
from collections.abc import Callable
from dataclasses import replace

from birdcage.base.clock import Clock
from birdcage.base.config import Settings
from birdcage.base.config.tracking_sections import RadioSettings
from birdcage.radio.now import RadioNow, RadioState
from birdcage.radio.peer import no_level
from birdcage.radio.receiver import LOOK_EVERY_S
from birdcage.radio.runner import ReceiverRunner
from birdcage.radio.tuning import Tuning
from birdcage.radio.wire import Connect
from birdcage.signal.listeners import Listeners
from birdcage.signal.source import MONITOR, Hear, Scale, SignalFacts, SignalReading
from birdcage.station.access import StationAccess

RECEIVER = "rigctl"
PAUSE_S = 2.5
"""It is asked once a second, when it has answered; a slow one takes more than a second for that."""
UNSET = 'No receiver is set. [radio] rigctld = "localhost:4532" in birdcage.toml names one.'
TROUBLED = frozenset({RadioState.CONNECTING, RadioState.LOST, RadioState.REFUSED})
"""In these its sentence says what is, or was, wrong; else it is a remark."""


class ReceiverSource:
    """A pass has it from a minute before reach until its end; else it is read while somebody watches, or left alone."""

    def __init__(
        self, station: StationAccess, settings: Settings, clock: Clock, *, threads: bool, connect: Connect | None = None
    ) -> None:
        """With `threads` it has one of its own from its first use on; else `step` does what is due.

        `connect` opens TCP in place of sockets.
        """
        self._station, self._clock, self._threads, self._connect = station, clock, threads, connect
        self._readings: Listeners[SignalReading] = Listeners()
        self._shown: Listeners[RadioNow] = Listeners()
        self._watchers: frozenset[str] = frozenset()
        self._lock = threading.Lock()
        self._told_s: float | None = None
        self._begun = False
        self._radio = _wanted(settings)
        self._runner = self._connection()

    @property
    def facts(self) -> SignalFacts:
        """Decibels, over S9 of a real radio, over full scale of an SDR; how long it averages is the receiver's own."""
        return SignalFacts(
            RECEIVER, "receiver", "dB", Scale.LOG, 1.0 / LOOK_EVERY_S, PAUSE_S, latency_s=None, dwell_s=None,
            decimals=1, span=10.0, least=None, of_dish=False, demo=self.now.demo,
            where=(self._radio.rigctld or "").partition("?")[0], set_to=self._set_to,
        )  # fmt: skip

    @property
    def _set_to(self) -> tuple[tuple[str, str], ...]:
        tuned_hz = self.now.read_back_hz
        return () if tuned_hz is None else (("freq_hz", f"{tuned_hz:.0f}"),)

    @property
    def trouble(self) -> str:
        """What is wrong with it, in its own words."""
        now = self.now
        if not now.address:
            return now.sentence or UNSET
        if now.state in TROUBLED:
            return now.sentence
        return "" if now.strength_refused is None else no_level(now.strength_refused)

    @property
    def now(self) -> RadioNow:
        """What is known of the receiver. Any thread."""
        return self._runner.now

    @property
    def serves_pass(self) -> bool:
        """Whether a pass has it or will, or LOS is owed to one. Any thread."""
        return self._runner.serves_pass

    def subscribe(self, hear: Hear) -> Callable[[], None]:
        """Tell every reading once, on the receiver's thread."""
        return self._readings.add(hear)

    def on_change(self, show: Callable[[RadioNow], object]) -> Callable[[], None]:
        """Tell what is known of it whenever that changes, on the receiver's thread; the result ends that."""
        return self._shown.add(show)

    def watch(self, watcher: str, *, steady: bool = False) -> None:  # noqa: ARG002 - it tells at a rate of its own
        """Connect, and read its level while no pass has it: without tuning it."""
        with self._lock:
            self._watchers |= {watcher}
            self._listen()

    def unwatch(self, watcher: str) -> None:
        """Hang up after the last watcher, unless a pass has it."""
        with self._lock:
            self._watchers -= {watcher}
            self._listen()

    def follow(self, tuning: Tuning | None) -> None:
        """Give it to this pass from a minute before reach; None takes it from the pass, and ends a recording."""
        with self._lock:
            self._begin()
            self._runner.follow(tuning)

    def use(self, settings: Settings) -> None:
        """Take over settings between two passes: within one, what was begun is ended as it was begun."""
        radio = _wanted(settings)
        with self._lock:
            if radio == self._radio or self._runner.serves_pass:
                return
            before, self._radio = self._runner, radio
            self._runner, self._begun = self._connection(), False
            self._listen()
        before.close(0.0)
        self._own(self.now)

    def step(self) -> float:
        """Do what is due without a thread; return when to come again, in monotonic seconds."""
        return self._runner.step() if not self._threads else math.inf

    def close(self) -> None:
        """Tell LOS where it is owed, and hang up; waits for that, a short time."""
        self._runner.close()

    def _connection(self) -> ReceiverRunner:
        runner = ReceiverRunner(self._radio, self._clock, lambda now: self._show(runner, now), connect=self._connect)
        return runner

    def _begin(self) -> None:
        if self._threads and not self._begun and self._radio.rigctld is not None:
            self._runner.start()
        self._begun = True

    def _listen(self) -> None:
        if self._watchers:
            self._begin()
        self._runner.listen(on=bool(self._watchers))

    def _show(self, runner: ReceiverRunner, now: RadioNow) -> None:
        """Take what a connection shows, unless another one has taken its place."""
        if runner is not self._runner:
            return
        self._own(now)
        value, at, utc = now.strength_db, now.strength_read_s, now.strength_at
        if value is not None and at is not None and utc is not None and at != self._told_s:
            self._told_s = at  # it is shown again and again with whatever else changes
            self._readings.tell(SignalReading(value, "dB", at, utc, RECEIVER))
        self._shown.tell(now)

    def _own(self, now: RadioNow) -> None:
        target = now.name or next((watcher for watcher in self._watchers if watcher != MONITOR), MONITOR)
        owner = "" if now.state is RadioState.OFF else target
        if owner != self._station.state.signal_owners.get(RECEIVER, ""):
            self._station.own_signal(RECEIVER, owner)


def _wanted(settings: Settings) -> RadioSettings:
    """Return how it is used: a feed that is heard by it wants its level in a pass, too."""
    by_feed = settings.active_feed.signal == RECEIVER
    return replace(settings.radio, strength=settings.radio.strength or by_feed)
