"""The signal sources of one station: those that settings name, made when they are first asked for."""

from __future__ import annotations

import threading
from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import TYPE_CHECKING

from birdcage.base.config.signals import OWN_TUNER, RECEIVER
from birdcage.signal.ear import SourceEar, TaskEar, TunerEar
from birdcage.signal.signal_tasks import signal_tasks

if TYPE_CHECKING:
    from pathlib import Path

    from birdcage.base.clock import Clock
    from birdcage.base.config import Settings
    from birdcage.signal.meter_source import MeterSource
    from birdcage.signal.monitor import SignalMonitor
    from birdcage.signal.receiver import ReceiverSource
    from birdcage.signal.rtl_tcp_meter import Tuned
    from birdcage.signal.source import Hear, SignalSource
    from birdcage.signal.tuner import TunerSource
    from birdcage.station.access import StationAccess
    from birdcage.station.task import Task

WATCHER = "task"


class SourceSet:
    """Any thread may call it. Nothing is connected to, or started, before somebody watches it."""

    def __init__(
        self, settings: Settings, clock: Clock, load: Callable[[], Settings] | None = None, *,
        memory: Path | None = None, threads: bool = True, keep: Callable[[Mapping[str, float]], object] | None = None,
    ) -> None:  # fmt: skip
        """`load` reads the settings again; `memory` is the file of what step-track remembers; `keep` writes settings.

        `threads=False`: a test calls the receiver's `step`.
        """
        self._memory, self._keep = memory, keep
        self._settings, self._clock, self._load, self._threads = settings, clock, load, threads
        self._station: StationAccess | None = None
        self._lock = threading.RLock()
        self._tuner: TunerSource | None = None
        self._receiver: ReceiverSource | None = None
        self._meters: dict[str, MeterSource] = {}
        self._monitor: SignalMonitor | None = None
        self._by_hand = ""
        """The source that a person has chosen over the one that the feed names."""

    def attach(self, station: StationAccess) -> None:
        """Serve this station: its `settings.tasks` are `tasks`, so it comes into being later."""
        self._station = station

    @property
    def tasks(self) -> Mapping[str, Callable[..., Task]]:
        """What the station is given: tasks that hear by these sources."""
        return signal_tasks(self.ear, self._memory)

    @property
    def ids(self) -> tuple[str, ...]:
        """What there is to choose from: the dish's own first, presets last."""
        receiver = (RECEIVER,) if self._settings.radio.rigctld is not None or self.chosen == RECEIVER else ()
        named = [each for each in self._settings.signals if f"signal.{each}." in self._named]
        return (OWN_TUNER, *receiver, *named, *(each for each in self._settings.signals if each not in named))

    @property
    def _named(self) -> str:
        return " ".join(self._settings.sources)

    @property
    def chosen(self) -> str:
        """The id of the source that counts: chosen by hand, else the feed's."""
        return self._by_hand or self._settings.active_feed.signal

    def get(self, source: str) -> SignalSource:
        """Return a source by its id. KeyError for one that there is not."""
        with self._lock:
            if source == OWN_TUNER:
                return self._own_tuner
            if source == RECEIVER:
                return self.receiver
            if source not in self._meters:
                from birdcage.signal.metered import metered_source

                self._meters[source] = metered_source(source, self._settings, self._clock, self._attached)
                self._meet(self._meters[source])
            return self._meters[source]

    @property
    def receiver(self) -> ReceiverSource:
        """The receiver that a pass tunes; the monitor hears it from then on."""
        with self._lock:
            if self._receiver is None:
                from birdcage.signal.receiver import ReceiverSource

                self._receiver = ReceiverSource(self._attached, self._settings, self._clock, threads=self._threads)
                self._meet(self._receiver)
            return self._receiver

    def ear(self, source: str) -> TaskEar:
        """Return how a task hears by a source, by the chosen one for an empty id. TypeError for an unknown one."""
        source = source or self.chosen
        if source == OWN_TUNER:
            return TunerEar()
        try:
            return SourceEar(self.get(source), self._clock, WATCHER)
        except KeyError:
            raise TypeError(f"there is no signal source called {source}") from None

    def monitor(self, hear: Hear) -> SignalMonitor:
        """Return what reads the chosen one."""
        from birdcage.signal.monitor import SignalMonitor

        with self._lock:
            chosen = self.get(self.chosen)
            made = [self._own_tuner, self._receiver, *self._meters.values()]
            sources = [each for each in made if each is not None]
            self._monitor = SignalMonitor(sources, chosen.facts.id, hear)
            return self._monitor

    def choose(self, source: str) -> None:
        """Take a source over the one that the feed names, until another feed is mounted. KeyError: there is none."""
        self.get(source)
        self._by_hand = source

    def chosen_now(self) -> str:
        """Read the settings again, as another feed was mounted; return the id of the source that it names."""
        with self._lock:
            before, self._by_hand = self._settings, ""
            if self._load is not None:
                self._settings = self._load()
            if self._receiver is not None:
                self._receiver.use(self._settings)
            if (before.signals, before.active_feed) != (self._settings.signals, self._settings.active_feed):
                for meter in self._meters.values():
                    meter.close()
                self._meters.clear()
            self.get(self.chosen)
            return self.chosen

    def tuned(self, source: str) -> Tuned | None:
        """Return how an RTL-SDR behind rtl_tcp is tuned; a frequency of 0 is not set yet. None for other sources."""
        profile = self._settings.signals.get(source)
        if profile is None or profile.kind != "rtl_tcp":
            return None
        from birdcage.signal.rtl_tcp_meter import RtlTcpMeter, Tuned

        self.get(source)
        meter = self._meters[source].meter
        if isinstance(meter, RtlTcpMeter):
            return meter.tuned
        return Tuned(0.0, profile.sample_rate_hz, profile.channel_hz, profile.gain_db)

    def tune(self, source: str, tuned: Tuned) -> bool:
        """Tune it from now on; return whether settings keep that. ConfigError, and nothing tuned: they can't."""
        from birdcage.signal.metered import meter_of
        from birdcage.signal.rtl_tcp_meter import RtlTcpMeter
        from birdcage.signal.tuning import as_settings

        with self._lock:
            if self._keep is not None:
                self._keep(as_settings(source, tuned))
            profile = replace(
                self._settings.signals[source], freq_hz=tuned.freq_hz, sample_rate_hz=tuned.sample_rate_hz,
                channel_hz=tuned.channel_hz, gain_db=as_settings(source, tuned)[f"signal.{source}.gain_db"],
            )  # fmt: skip
            # As if read again: another feed that is mounted later then finds nothing changed.
            self._settings = replace(self._settings, signals={**self._settings.signals, source: profile})
            self.get(source)
            made = self._meters[source]
            if isinstance(made.meter, RtlTcpMeter):
                made.meter.retune(tuned)
            else:
                made.replace(meter_of(source, self._settings, self._clock))
            return self._keep is not None

    def close(self) -> None:
        """End all of them."""
        with self._lock:
            if self._tuner is not None:
                self._tuner.close()
            if self._receiver is not None:
                self._receiver.close()
        self.close_meters()

    def close_meters(self) -> None:
        """End the programs and connections beside the receiver that a pass tunes, which the pursuit desk closes."""
        with self._lock:
            for meter in self._meters.values():
                meter.close()

    @property
    def _attached(self) -> StationAccess:
        assert self._station is not None, "it was attached to a station"
        return self._station

    @property
    def _own_tuner(self) -> TunerSource:
        if self._tuner is None:
            from birdcage.signal.tuner import TunerSource

            self._tuner = TunerSource(self._attached)
        return self._tuner

    def _meet(self, source: SignalSource) -> None:
        if self._monitor is not None:
            self._monitor.add(source)
