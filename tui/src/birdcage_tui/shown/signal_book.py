"""What was heard: by the source of the mounted feed, or in a pass by a receiver, which goes before the dish's tuner."""

from __future__ import annotations

from collections import deque
from collections.abc import Sequence
from datetime import datetime, timedelta

from birdcage.signal.heard_from import heard_from
from birdcage.signal.peak_hold import LevelNow, PeakHold
from birdcage.signal.source import SignalFacts, SignalReading, Spectrum
from birdcage.signal.tuner import TUNER, TUNER_FACTS
from birdcage.station.pursuit_state import Phase
from birdcage.station.state import StationState

from birdcage_tui.shown.markers import Marker, Markers
from birdcage_tui.shown.view import SignalSample

KEPT = 2000
MOST_SPECTRA = 120
"""More than any screen has rows."""


class SignalBook:
    """Kept by the app: what each source has told."""

    def __init__(self) -> None:
        self.chosen = TUNER_FACTS
        """Of the source that the feed names."""
        self._facts: dict[str, SignalFacts] = {}
        self._samples: dict[str, deque[SignalSample]] = {}
        self._holds: dict[str, PeakHold] = {}
        self._markers: dict[str, Markers] = {}
        self._passes: dict[str, tuple[int, PeakHold]] = {}
        """Of each source, what it has told in the newest pursuit, and the number of that."""
        self.spectra: deque[Spectrum] = deque(maxlen=MOST_SPECTRA)
        """Of the chosen source, the newest last."""

    def choose(self, facts: SignalFacts) -> None:
        """Show the source of another feed, and nothing of what was heard through the one before."""
        self.chosen = facts
        self._samples.clear()
        self._holds.clear()
        self._markers.clear()
        self._passes.clear()
        self.spectra.clear()

    def of(self, facts: SignalFacts) -> deque[SignalSample]:
        """Return what a source has told, the newest last."""
        self._facts[facts.id] = facts
        return self._samples.setdefault(facts.id, deque(maxlen=KEPT))

    def hear(self, reading: SignalReading, facts: SignalFacts, state: StationState) -> None:
        """Take what a source has told, and where the dish pointed then, if that is known."""
        where = heard_from(reading.at, facts, state)
        if reading.spectrum is not None and facts.id == self.chosen.id:
            self.spectra.append(reading.spectrum)
        self.of(facts).append(SignalSample(reading.at, reading.value, *where))
        self._holds.setdefault(facts.id, PeakHold(facts.scale)).hear(
            reading.at, reading.value, *where, beam_deg=None if state.beam is None else state.beam.mean_deg
        )

        pursuit = state.pursuit
        if pursuit is not None and pursuit.phase is Phase.FOLLOWING:
            number, hold = self._passes.get(facts.id, (None, None))
            if hold is None or number != pursuit.number:
                hold = PeakHold(facts.scale)
            # Without directions: the target moves, so a direction is none to come back to.
            hold.hear(reading.at, reading.value)
            self._passes[facts.id] = (pursuit.number, hold)

    def level_in(self, state: StationState) -> LevelNow | None:
        """Return how well it is heard now: against this pass alone while the dish follows, else since `forget_peak`."""
        pursuit = state.pursuit
        if pursuit is None or pursuit.phase is not Phase.FOLLOWING:
            return self.level
        number, hold = self._passes.get(self.heard.id, (None, None))
        return hold.now() if hold is not None and number == pursuit.number else None

    def forget_peak(self) -> None:
        """Begin anew with floor and peak of what is heard."""
        self._holds.pop(self.heard.id, None)
        self._passes.pop(self.heard.id, None)

    def mark(self, now: float, utc: datetime, state: StationState) -> Marker | None:
        """Mark the newest reading, as it is at this monotonic time and UTC; None where it is too old to be marked."""
        level, heard = self.level, self.heard
        if level is None or now - level.at > heard.pause_s:
            return None
        at = utc - timedelta(seconds=now - level.at)
        markers = self._markers.setdefault(heard.id, Markers())
        return markers.add(level.at, at, level.level, *heard_from(level.at, heard, state))

    def clear_markers(self) -> int:
        """Forget the markers of what is heard; return how many there were."""
        gone = self._markers.pop(self.heard.id, None)
        return 0 if gone is None else len(gone.kept)

    @property
    def markers(self) -> Sequence[Marker]:
        """Those of what is heard, the newest last."""
        kept = self._markers.get(self.heard.id)
        return () if kept is None else kept.kept

    @property
    def level(self) -> LevelNow | None:
        """How well it is heard, and where the peak was; None before the first reading."""
        hold = self._holds.get(self.heard.id)
        return None if hold is None else hold.now()

    @property
    def heard(self) -> SignalFacts:
        """Whose `samples` are shown: another source goes before the tuner while it tells, and until that tells more."""
        if self.chosen.id != TUNER:
            return self.chosen
        told = {name: samples[-1].at for name, samples in self._samples.items() if samples}
        newest = max(told.values(), default=0.0)
        telling = [name for name, at in told.items() if newest - at <= self._facts[name].pause_s]
        name = max(telling, key=lambda name: (name != TUNER, told[name]), default=None)
        return self.chosen if name is None else self._facts[name]

    @property
    def samples(self) -> Sequence[SignalSample]:
        """What that one told, the newest last."""
        return tuple(self.of(self.heard))
