"""The dish's own tuner as a source: read by the station, within its budget of excursions from the motor menu."""

from __future__ import annotations

import threading
from collections.abc import Callable
from dataclasses import replace

from birdcage.signal.listeners import Listeners
from birdcage.signal.source import MONITOR, Hear, SignalFacts, SignalReading
from birdcage.station.access import StationAccess
from birdcage.station.events import Event, PursuitChanged, ReadingRead
from birdcage.station.pursuit_state import Phase
from birdcage.station.requests import Unwatch, Watch
from birdcage.station.watches import EXCURSION_PERIOD_S, RSSI_READS

TUNER = "tuner"
FEATURE = "rssi"
PAUSE_S = 8.5
"""It is asked every 5 s, while the dish follows every 9 s, in bursts of more than a second."""
STEADY_HZ = 10.0
"""How often it is asked where the signal alone counts; a slow wire makes that less."""

TUNER_FACTS = SignalFacts(
    TUNER, "tuner", "counts", None, RSSI_READS / EXCURSION_PERIOD_S, PAUSE_S, latency_s=None, dwell_s=None,
    decimals=0, span=100.0, least=0.0, of_dish=True, demo=False,
    where="The receiver in the dish. It is read while the dish rests.",
)  # fmt: skip
"""Of every dish's own tuner. The scale of its counts was never measured, nor how long it looks."""


class TunerSource:
    """What the station reads of `rssi`, whoever it reads that for: a watcher at rest, or a pass."""

    def __init__(self, station: StationAccess) -> None:
        self._station = station
        self._readings: Listeners[SignalReading] = Listeners()
        self._watchers: set[str] = set()
        self._lock = threading.Lock()
        self._in_pursuit = False
        """Whether it was read for the target that is followed."""
        self._unsubscribe = station.subscribe(self._on_event, ReadingRead, PursuitChanged)

    @property
    def facts(self) -> SignalFacts:
        """What its counts mean."""
        return replace(TUNER_FACTS, demo=self._station.state.demo)

    @property
    def trouble(self) -> str:
        """Why nothing is read: this dish has none."""
        dish = self._station.state.dish
        if dish is None or dish.has_rssi:
            return ""
        others = "s on F3 or --source NAME chooses another source. To keep it, set signal in the feed's table."
        return f"The {dish.name} has no tuner to read. {others}"

    def subscribe(self, hear: Hear) -> Callable[[], None]:
        """Tell every reading, on the station's thread."""
        return self._readings.add(hear)

    def watch(self, watcher: str, *, steady: bool = False) -> None:
        """Have the station read it while the dish rests: in bursts, or `STEADY_HZ` times a second."""
        with self._lock:
            self._watchers.add(watcher)
        rate_hz = STEADY_HZ if steady else 1.0
        self._station.submit(Watch(f"{TUNER} {watcher}", frozenset({FEATURE}), rate_hz, steady=steady))
        self._own()

    def unwatch(self, watcher: str) -> None:
        """Have it read no more for this watcher."""
        with self._lock:
            self._watchers.discard(watcher)
        self._station.submit(Unwatch(f"{TUNER} {watcher}"))
        self._own()

    def close(self) -> None:
        """Hear no more of the station."""
        self._unsubscribe()

    def _on_event(self, event: Event) -> None:
        if isinstance(event, ReadingRead) and event.feature == FEATURE:
            self._own(read=True)
            dish = self._station.state.dish
            n = None if dish is None or FEATURE not in dish.features else dish.features[FEATURE].samples
            self._readings.tell(SignalReading(float(event.value), event.unit, event.at, event.utc, TUNER, n=n))
        elif isinstance(event, PursuitChanged):
            self._own()

    def _own(self, *, read: bool = False) -> None:
        """Say who it is read for: the target that is followed from its first reading on, else whoever looks."""
        with self._lock:
            state = self._station.state
            pursuit, has = state.pursuit, state.dish is not None and state.dish.has_rssi
            followed = pursuit is not None and pursuit.phase is Phase.FOLLOWING
            self._in_pursuit = followed and (read or self._in_pursuit)
            name = MONITOR if self._watchers else ""
            if pursuit is not None and self._in_pursuit:
                name = pursuit.plan.aim.name
            owner = name if has else ""
            if owner != state.signal_owners.get(TUNER, ""):
                self._station.own_signal(TUNER, owner)
