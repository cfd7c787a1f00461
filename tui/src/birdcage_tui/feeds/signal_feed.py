"""What the app hears of signal sources: the one of the mounted feed is read while a page shows it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Protocol

from birdcage.base.errors import ConfigError
from birdcage.signal.level_scale import LevelScale, find_scale, keep_scale, load_scales, remove_scale
from birdcage.signal.monitor import SignalMonitor
from birdcage.signal.recording import SignalRecorder, about, row_of
from birdcage.signal.rtl_tcp_meter import Tuned
from birdcage.signal.source import Hear, SignalReading, SignalSource
from birdcage.signal.tuner import TUNER, TunerSource
from birdcage.station.access import FaceStation
from birdcage.station.events import Event, ReadingRead, TaskChanged

from birdcage_tui.feeds.tone_sound import Sound
from birdcage_tui.shown.polarisation_book import PolarisationBook
from birdcage_tui.shown.signal_book import SignalBook
from birdcage_tui.shown.source_choice import SourceChoice
from birdcage_tui.shown.sweep_book import SweepBook

SIGNAL, STEADY = "signal", "signal steadily"
"""What a page names that shows it; the second where the signal alone counts."""


class SignalSources(Protocol):
    """The sources of a session. No call waits."""

    def monitor(self, hear: Hear) -> SignalMonitor:
        """Return what reads the one that the feed names; `hear` is called on any thread."""

    @property
    def ids(self) -> Sequence[str]:
        """What there is to choose from."""

    def get(self, source: str) -> SignalSource:
        """Return a source by its id."""

    def choose(self, source: str) -> None:
        """Take a source over the one that the feed names, until another feed is mounted."""

    def chosen_now(self) -> str:
        """Read the settings again, and return the id of the source that the mounted feed names."""

    def tuned(self, source: str) -> Tuned | None:
        """Return how an RTL-SDR behind rtl_tcp is tuned; None for other sources."""

    def tune(self, source: str, tuned: Tuned) -> bool:
        """Tune it from now on; return whether that is kept. ConfigError, and nothing tuned: it can't be."""

    def close_meters(self) -> None:
        """End programs and connections that were begun for it."""


class SignalFeed:
    """Nothing is read before `begin`, nor after `close`."""

    def __init__(
        self, sources: SignalSources | None, station: FaceStation, soon: Callable[[Callable[[], None]], object],
        changed: Callable[[], object], recordings_file: Path | None = None,
        levels_file: Path | None = None,
    ) -> None:  # fmt: skip
        """Without `sources` there is the dish's own tuner; without a file nothing is kept in it."""
        self._sources, self._station, self._soon, self._changed = sources, station, soon, changed
        self._monitor: SignalMonitor | None = None
        self.recordings_file = recordings_file
        """Where recordings are kept; None if nowhere."""
        self._levels_file = levels_file
        self._scales: Sequence[LevelScale] = ()
        self._feed = ""
        self.book = SignalBook()
        self.sweeps = SweepBook()
        self.polarisations = PolarisationBook()
        self.recorder: SignalRecorder | None = None
        """Keeps what is heard, while a person wants that."""
        self.sound: Sound | None = None
        """Plays a tone by it; None: the terminal's bell is all there is."""
        self.no_sound = ""
        """Why that is so, as the beginning of a sentence."""
        self._records = ""
        self._unsubscribe: Callable[[], None] | None = None

    def begin(self) -> None:
        """Meet the sources; after the first frame."""
        if self._sources is None:
            self._monitor = SignalMonitor([TunerSource(self._station)], TUNER, self._hear)
        else:
            self._monitor = self._sources.monitor(self._hear)
        self._unsubscribe = self._station.subscribe(self._on_event, TaskChanged, ReadingRead)
        self.book.chosen = self._monitor.chosen.facts
        self._feed = self._station.state.feed_name
        if self._levels_file is not None:
            self._scales = load_scales(self._levels_file).entries

    @property
    def scale(self) -> LevelScale | None:
        """What the values that are shown are in dB, by two known levels."""
        return find_scale(self._scales, self.book.heard.id, self._station.state.feed_name)

    def keep_levels(self, scale: LevelScale | None) -> str:
        """Keep two known levels, or with None remove those of what is heard; return what became of it, a sentence."""
        before = self.scale
        if self._levels_file is None:
            return "There is no folder for known levels."
        if scale is None and before is None:
            return "No levels are known."
        try:
            if scale is not None:
                self._scales = keep_scale(self._levels_file, scale).entries
                return f"{scale.words(self.book.heard.unit)}. A straight line between them is assumed."
            if before is not None:
                self._scales = remove_scale(self._levels_file, before).entries
        except ConfigError as error:
            return str(error)
        return "Known levels removed."

    @property
    def trouble(self) -> str:
        """Why nothing is read of the source that the feed names; empty while all is well."""
        return "" if self._monitor is None else self._monitor.chosen.trouble

    @property
    def choices(self) -> Sequence[SourceChoice]:
        """The sources that can be heard."""
        if self._monitor is None:
            return ()
        owners, chosen = self._station.state.signal_owners, self._monitor.chosen.facts.id
        sources = [self._monitor.chosen]
        if self._sources is not None:
            sources = [self._sources.get(each) for each in self._sources.ids]
        return [
            SourceChoice(each.facts, each.facts.id == chosen, owners.get(each.facts.id, ""), each.trouble)
            for each in sources
        ]

    def choose(self, source: str) -> None:
        """Hear by another one, with nothing of what was heard by the one before."""
        if self._sources is not None and self._monitor is not None and source != self._monitor.chosen.facts.id:
            self.end_record()
            self._sources.choose(source)
            self._monitor.choose(source)
            self.book.choose(self._monitor.chosen.facts)

    @property
    def tuned(self) -> Tuned | None:
        """How the chosen source is tuned; None for one that is not tuned from here."""
        if self._sources is None or self._monitor is None:
            return None
        return self._sources.tuned(self._monitor.chosen.facts.id)

    def tune(self, tuned: Tuned) -> str:
        """Tune the chosen source, with nothing of what was heard before; return what became of it, a sentence."""
        if self._sources is None or self._monitor is None:
            return ""
        facts = self._monitor.chosen.facts
        self.end_record()
        try:
            kept = self._sources.tune(facts.id, tuned)
        except ConfigError as error:
            return str(error)
        self.book.choose(facts)
        till = f"[signal.{facts.id}] keeps it" if kept else "Until birdcage ends"
        return f"Tuned to {tuned.freq_hz / 1e6:.9g} MHz. {till}."

    def watch(self, shown: frozenset[str], *, typing: bool) -> frozenset[str]:
        """Have it read if it is among what a page shows, or recorded; return the rest of what is shown.

        A dish that a person is `typing` to is not asked: it would change the menu.
        """
        if self._monitor is not None:
            self._take_feed(self._monitor)
            asked = not (typing and self._monitor.chosen.facts.of_dish)
            wanted = self.recorder is not None or not shown.isdisjoint({SIGNAL, STEADY})
            self._monitor.watch(on=asked and wanted, steady=STEADY in shown)
        return shown - {SIGNAL, STEADY}

    def close(self) -> None:
        """Read nothing more, and end a recording."""
        self.end_record()
        if self.sound is not None:
            self.sound.close()
        if self._unsubscribe is not None:
            self._unsubscribe()
        if self._monitor is not None:
            self._monitor.close()

    def _take_feed(self, monitor: SignalMonitor) -> None:
        """Take another source where another feed was mounted: on a page that watches none."""
        feed = self._station.state.feed_name
        if self._sources is not None and feed != self._feed:
            self._feed = feed
            monitor.choose(self._sources.chosen_now())
            self.book.choose(monitor.chosen.facts)

    def _on_event(self, event: Event) -> None:
        if isinstance(event, TaskChanged):
            self._soon(lambda: self.sweeps.take(event.task))
        elif isinstance(event, ReadingRead) and self.polarisations.wants(event.feature):
            self._soon(lambda: self.polarisations.take(event))

    def _hear(self, reading: SignalReading) -> None:
        self._soon(lambda: self._take(reading))

    def record(self) -> bool:
        """Keep what is heard until `end_record`, or until another source is chosen; False where there is no file."""
        path = self.recordings_file
        if path is None or self._monitor is None:
            return False
        if self.recorder is None:
            facts = self._monitor.chosen.facts
            self.recorder = SignalRecorder(
                path, facts, about(facts, self._station.state.feed_name), demo=facts.demo or self._station.state.demo
            )
            self._records = facts.id
        return True

    @property
    def recorded(self) -> str:
        """How far the recording is, or why it has stopped."""
        recorder = self.recorder
        return "" if recorder is None else recorder.problem or f"● recording, {recorder.kept} readings"

    def end_record(self) -> str:
        """End it, and return what became of it; empty where nothing was recorded."""
        recorder, self.recorder = self.recorder, None
        if recorder is None:
            return ""
        recorder.close()
        return recorder.problem or f"Recording {recorder.number}: {recorder.kept} readings."

    def _take(self, reading: SignalReading) -> None:
        if self._monitor is not None:
            facts = self._monitor.facts_of(reading.source)
            if self.recorder is not None and reading.source == self._records:
                now = self._station.clock.monotonic()
                self.recorder.add(row_of(reading, facts, self._station.state, now))
            self.book.hear(reading, facts, self._station.state)
            if not facts.of_dish:  # else the station's own event brings the next frame
                self._changed()
