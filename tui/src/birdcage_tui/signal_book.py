"""What was heard: by the dish's own tuner, and by the receiver beside it, which goes first while it tells anything."""

from __future__ import annotations

from collections import deque
from collections.abc import Sequence
from datetime import datetime
from typing import TYPE_CHECKING

from birdcage.station.events import Event, ReadingRead
from birdcage.station.state import StationState

from birdcage_tui.view import RECEIVER, TUNER, Heard, Sample

if TYPE_CHECKING:
    from birdcage.pursuit.now import DeskNow

KEPT = 2000


class SignalBook:
    """Kept by the app. The tuner is read while the dish rests, a receiver's strength while a pass is on."""

    def __init__(self) -> None:
        self.tuner: deque[Sample] = deque(maxlen=KEPT)
        self.receiver: deque[Sample] = deque(maxlen=KEPT)
        self._read: datetime | None = None
        self._tells = False
        self._marked = False

    def hear(self, event: Event, state: StationState) -> None:
        """Take what the dish's tuner has told."""
        if isinstance(event, ReadingRead) and event.feature == "rssi":
            self.tuner.append(_sample(event.at, float(event.value), state))

    def tell(self, desk: DeskNow | None, at: float, state: StationState) -> None:
        """Take what the receiver shows at monotonic `at`: a strength counts once, however often it is shown."""
        radio = None if desk is None else desk.radio
        strength_db = None if radio is None else radio.strength_db
        self._tells = strength_db is not None
        if radio is None or strength_db is None or radio.strength_at in (None, self._read):
            return
        self._read, self._marked = radio.strength_at, radio.demo and not state.demo
        self.receiver.append(_sample(at, strength_db, state))

    @property
    def heard(self) -> Heard:
        """Who is listened to: the receiver while it tells its strength, and until the tuner tells something newer."""
        tuner, receiver = self.tuner, self.receiver
        if receiver and (self._tells or not tuner or receiver[-1].at >= tuner[-1].at):
            return Heard(f"DEMO {RECEIVER}" if self._marked else RECEIVER, "dB")
        return Heard(TUNER, "counts")

    @property
    def samples(self) -> Sequence[Sample]:
        """What that one told, the newest last."""
        return tuple(self.tuner if self.heard.by == TUNER else self.receiver)


def _sample(at: float, value: float, state: StationState) -> Sample:
    position = state.position
    if position is None or position.modelled:
        return Sample(at, value)
    return Sample(at, value, position.az_deg, position.el_deg)
