"""Keeps the receiver on the frequency of the pass, and tells what level it hears."""

from __future__ import annotations

from collections.abc import Callable
from datetime import UTC, datetime
from typing import TYPE_CHECKING

from birdcage.base.clock import Clock
from birdcage.pursuit.follower import reach_end, reach_start
from birdcage.pursuit.pass_listener import LivePass, PassListener
from birdcage.radio.now import RadioNow
from birdcage.radio.tuning import Tuning
from birdcage.signal.receiver import RECEIVER, ReceiverSource
from birdcage.signal.source import SignalReading
from birdcage.sky.doppler import doppler_hz
from birdcage.station.pursuit_state import Phase

if TYPE_CHECKING:
    from birdcage.base.config import Settings
    from birdcage.sky.elements import ElementSet
    from birdcage.sky.observer import Observer
    from birdcage.station.station import Station
    from birdcage.tracking.plan import Plan

TellSignal = Callable[[float, str, float], None]


class PassTuner(PassListener):
    """The receiver in a pass. Between two it takes over other settings."""

    label = "receiver's tuning"

    def __init__(
        self, station: Station, clock: Clock, settings: Settings, tell: TellSignal, *, threads: bool,
        changed: Callable[[], None], receiver: ReceiverSource | None = None,
    ) -> None:  # fmt: skip
        """`tell` gets value, unit and monotonic time of each level; `changed` is called when the receiver shows more.

        Both are called on any thread. `receiver` is one that others look at, too, and that keeps to settings of its
        own; None: a pass has it alone.
        """
        self._settings, self._tell = settings, tell
        self._shared = receiver is not None
        self._plan: Plan | None = None
        self._listens_for = ""
        """For which target the receiver is watched."""
        self._receiver = receiver or ReceiverSource(station, settings, clock, threads=threads)
        self._unsubscribe = (
            self._receiver.subscribe(self._heard),
            self._receiver.on_change(lambda _now: changed()),
        )

    @property
    def now(self) -> RadioNow:
        """What is known of the receiver. Any thread."""
        return self._receiver.now

    def begins(self, live: LivePass) -> None:
        """Take over the settings of now: within a pass, what was begun is ended as it was begun."""
        if not self._shared:
            self._receiver.use(live.settings)
        self._settings = live.settings
        self.changes(live)

    def changes(self, live: LivePass) -> None:
        """Tune by the newest plan; listen while the dish follows."""
        self._listen(live.plan.aim.name if live.pursuit.phase is Phase.FOLLOWING else "")
        if live.plan is not self._plan:
            self._plan = live.plan
            self._receiver.follow(tuning_of(live.plan, live.settings, live.observer, live.elements))

    def ends(self) -> None:
        """Let go of it."""
        self._listen("")
        self._plan = None
        self._receiver.follow(None)

    def step(self) -> float:
        """Do what is due where it has no thread."""
        return self._receiver.step()

    @property
    def busy(self) -> bool:
        """Whether a pass has it, or LOS is owed to one."""
        return self._receiver.serves_pass

    def close(self) -> None:
        """Tell LOS where it is owed, and hang up."""
        for unsubscribe in self._unsubscribe:
            unsubscribe()
        self._receiver.close()

    def _listen(self, name: str) -> None:
        """Have the receiver that hears the feed read while the dish follows, also what it is not tuned to."""
        if self._settings.active_feed.signal != RECEIVER:
            name = ""
        if name != self._listens_for:
            if self._listens_for:
                self._receiver.unwatch(self._listens_for)
            if name:
                self._receiver.watch(name)
            self._listens_for = name

    def _heard(self, reading: SignalReading) -> None:
        demo = " DEMO" if self._receiver.facts.demo else ""
        self._tell(reading.value, reading.unit + demo, reading.at)


def tuning_of(plan: Plan, settings: Settings, observer: Observer | None, elements: ElementSet | None) -> Tuning | None:
    """Return what a receiver is to be tuned to; None for what sends nothing, or is no satellite."""
    from birdcage.sky.targets.model import NoPosition, Satellite

    frequency_hz, start, end = plan.aim.frequency_hz, reach_start(plan), reach_end(plan)
    if frequency_hz is None or elements is None or observer is None or start is None or end is None:
        return None
    satellite, place = Satellite(elements, plan.aim.time_offset_s), observer

    def shift_hz(at_s: float) -> float | None:
        try:
            rate_km_s = satellite.look(place, datetime.fromtimestamp(at_s, UTC)).range_rate_km_s
        except NoPosition:
            return None
        return None if rate_km_s is None else doppler_hz(frequency_hz, rate_km_s)

    lo_hz = settings.radio.lo_hz if settings.radio.lo_hz is not None else settings.active_feed.lo_hz
    return Tuning(plan.aim.name, frequency_hz, shift_hz, start.timestamp(), end.timestamp(), lo_hz or 0.0)
