"""Reads the source of the feed while the dish follows, where that is neither its tuner nor the tuned receiver."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from birdcage.base.clock import Clock
from birdcage.base.config.signals import OWN_TUNER, RECEIVER
from birdcage.pursuit.pass_listener import LivePass, PassListener
from birdcage.pursuit.pass_tuner import TellSignal
from birdcage.signal.source import SignalReading, SignalSource
from birdcage.station.pursuit_state import Phase

if TYPE_CHECKING:
    from birdcage.base.config import Settings
    from birdcage.station.station import Station


class PassLevel(PassListener):
    """A program that tells a level, or an RTL-SDR: it is read for the target that is followed."""

    label = "reading of the signal"

    def __init__(
        self, station: Station, clock: Clock, tell: TellSignal, source_of: Callable[[str], SignalSource] | None
    ) -> None:
        """`tell` gets value, unit and monotonic time of each level, on any thread.

        `source_of` returns a source by its id, which others hear, too. None: a pass has one of its own.
        """
        self._station, self._clock, self._tell, self._source_of = station, clock, tell, source_of
        self._source: SignalSource | None = None
        self._name = ""
        self._end: Callable[[], None] = lambda: None

    def begins(self, live: LivePass) -> None:
        """Read it from the moment at which the dish follows."""
        self.changes(live)

    def changes(self, live: LivePass) -> None:
        """The same; in a gap of the pass it is left alone."""
        wanted = live.settings.active_feed.signal
        if wanted in (OWN_TUNER, RECEIVER) or live.pursuit.phase is not Phase.FOLLOWING:
            self.ends()
        elif self._source is None or self._source.facts.id != wanted or self._name != live.plan.aim.name:
            self.ends()
            self._begin(live.settings, wanted, live.plan.aim.name)

    def ends(self) -> None:
        """Leave it alone."""
        source, self._source = self._source, None
        if source is not None:
            source.unwatch(self._name)
            self._end()

    def close(self) -> None:
        """The same."""
        self.ends()

    def _begin(self, settings: Settings, wanted: str, name: str) -> None:
        from birdcage.signal.metered import metered_source

        if self._source_of is not None:
            source = self._source_of(wanted)
        else:
            source = metered_source(wanted, settings, self._clock, self._station)
        self._source, self._name = source, name
        self._end = source.subscribe(self._heard)
        source.watch(name, steady=True)

    def _heard(self, reading: SignalReading) -> None:
        self._tell(reading.value, reading.unit, reading.at)
