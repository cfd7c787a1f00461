"""What goes on beside a pursuit: its log, the user's own commands, and the receiver."""

from __future__ import annotations

from collections.abc import Callable
from datetime import UTC, datetime
from typing import TYPE_CHECKING

from birdcage.base.clock import Clock
from birdcage.pursuit.follower import reach_end, reach_start, told_reach_end
from birdcage.pursuit.hooks import HookLine, PassHooks
from birdcage.pursuit.pass_facts import PassFacts
from birdcage.pursuit.pass_log import PassLog, keep_passes
from birdcage.radio.now import RadioNow
from birdcage.radio.tuning import Tuning
from birdcage.signal.receiver import RECEIVER, ReceiverSource
from birdcage.signal.source import SignalReading
from birdcage.sky.doppler import doppler_hz
from birdcage.station.pursuit_state import Phase

if TYPE_CHECKING:
    from birdcage.base.config import Settings
    from birdcage.base.paths import Paths
    from birdcage.sky.elements import ElementSet
    from birdcage.sky.observer import Observer
    from birdcage.station.pursuit_state import Pursuit
    from birdcage.station.station import Station
    from birdcage.tracking.plan import Plan

CLOSE_S = 0.2
"""How long the end may wait for the log to reach the disk."""
SAMPLES = 200
"""Directions that are looked at for the highest one within reach."""


class PassServices:
    """For the desk's thread alone."""

    def __init__(
        self, station: Station, clock: Clock, paths: Paths, settings: Settings, *, threads: bool,
        changed: Callable[[], None], receiver: ReceiverSource | None = None,
    ) -> None:  # fmt: skip
        """`changed` is called on any thread once the receiver shows something else.

        `receiver` is one that others look at, too, and that keeps to settings of its own; None: a pass has it alone.
        """
        self._clock = clock
        self._shared = receiver is not None
        self._plan: Plan | None = None
        self._settings = settings
        self._hooks = PassHooks(settings.hooks, self._said, clock)
        self._number, self._site = 0, ""
        self._elements: ElementSet | None = None
        self._log = PassLog(paths.journal, paths.passes, site=lambda: self._site, epoch_of=self._epoch_of)
        self._listens_for = ""
        """For which target the receiver is watched."""
        self._end_log = keep_passes(station, self._log)
        self._receiver = receiver or ReceiverSource(station, settings, clock, threads=threads)
        self._unsubscribe = (
            self._receiver.subscribe(self._heard),
            self._receiver.on_change(lambda _now: changed()),
        )

    @property
    def radio(self) -> RadioNow:
        """The receiver."""
        return self._receiver.now

    @property
    def problem(self) -> str:
        """What is not being kept, and why."""
        return self._log.problem

    def follow(
        self, pursuit: Pursuit | None, settings: Settings, observer: Observer | None, elements: ElementSet | None
    ) -> None:
        """Go along with the pursuit that is live; None when none is any more."""
        self._listen(pursuit)
        plan = None if pursuit is None else pursuit.plan
        self._site = "" if observer is None else observer.name
        if plan is self._plan:
            return
        if pursuit is not None:
            self._number, self._elements = pursuit.number, elements
        if self._plan is None and plan is not None:
            self._use(settings)
        before, self._plan = self._plan, plan
        if plan is None:
            end = None if before is None else told_reach_end(before)
            # One that came to its end keeps its last hook, which may run some time after that.
            if end is None or self._clock.utc() < end:
                self._hooks.plan(None)
            self._receiver.follow(None)
            return
        facts = facts_of(plan, observer)
        if facts is not None:
            self._hooks.plan(facts)
        self._receiver.follow(tuning_of(plan, settings, observer, elements))

    def step(self) -> float:
        """Do what is due; return when to come again, in monotonic seconds."""
        return min(self._hooks.step(), self._receiver.step())

    @property
    def busy(self) -> bool:
        """Whether closing has something to end or to write."""
        waits = self._plan is not None or self._receiver.serves_pass
        return waits or self._hooks.running or not self._log.flush(0.0)

    def close(self) -> None:
        """End what runs, let go of the receiver, and write what is to be kept."""
        self._end_log()
        for unsubscribe in self._unsubscribe:
            unsubscribe()
        self._receiver.close()
        self._hooks.close(0.0)
        self._log.close(CLOSE_S)

    def _said(self, line: HookLine) -> None:
        self._log.hook_said(line)

    def _listen(self, pursuit: Pursuit | None) -> None:
        """Have the receiver that hears the feed read while the dish follows, also what it is not tuned to."""
        name = ""
        if pursuit is not None and pursuit.phase is Phase.FOLLOWING and self._settings.active_feed.signal == RECEIVER:
            name = pursuit.plan.aim.name
        if name != self._listens_for:
            if self._listens_for:
                self._receiver.unwatch(self._listens_for)
            if name:
                self._receiver.watch(name)
            self._listens_for = name

    def _heard(self, reading: SignalReading) -> None:
        demo = " DEMO" if self._receiver.facts.demo else ""
        self._log.signal(reading.value, reading.unit + demo, reading.at)

    def _epoch_of(self, norad_id: int) -> datetime | None:
        elements = self._elements
        return elements.epoch if elements is not None and elements.norad_id == norad_id else None

    def _use(self, settings: Settings) -> None:
        """Take over settings between two passes: within one, what was begun is ended as it was begun."""
        if settings.hooks != self._settings.hooks:
            self._hooks.close(0.0)
            self._hooks = PassHooks(settings.hooks, self._said, self._clock)
        if not self._shared:
            self._receiver.use(settings)
        self._settings = settings


def facts_of(plan: Plan, observer: Observer | None) -> PassFacts | None:
    """Return what a hook is told; None if nothing can be reached."""
    import numpy as np

    start, end = reach_start(plan), reach_end(plan)
    if start is None or end is None:
        return None
    times = np.linspace(max(start.timestamp(), plan.sky.start_s), min(end.timestamp(), plan.sky.end_s), SAMPLES)
    elevations = plan.sky.sample(times)[1]
    top = int(np.argmax(elevations))
    passing = plan.passing
    return PassFacts(
        name=plan.aim.name, reach_start=start, reach_end=told_reach_end(plan), norad_id=plan.aim.norad_id,
        aos=None if passing is None else passing.aos,
        tca=None if passing is None else datetime.fromtimestamp(float(times[top]), UTC),
        los=None if passing is None else passing.los, max_el_deg=float(elevations[top]),
        freq_hz=plan.aim.frequency_hz, downlink=plan.aim.downlink,
        site=(observer.name or None) if observer is not None else None,
    )  # fmt: skip


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
