"""What is known of the receiver at one moment."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import datetime
from enum import Enum


class RadioState(Enum):
    """How it stands with the receiver."""

    OFF = "off"
    """No address is set, or it is left alone: no pass is on, and its level is not watched."""
    CONNECTING = "connecting"
    TUNED = "tuned"
    LISTENING = "listening"
    """Its level is read and nothing else: no pass is on, and it stays as its owner has tuned it."""
    LOST = "lost"
    """It does not answer; it is tried again, and the pass goes on without it."""
    REFUSED = "refused"
    """It answers and does not do what it is asked; `sentence` says what."""


@dataclass(frozen=True, slots=True)
class RadioNow:
    """The receiver, as shown. What is not known is None."""

    state: RadioState = RadioState.OFF
    address: str = ""
    name: str = ""
    """Of the satellite."""
    downlink_hz: float | None = None
    """As sent."""
    doppler_hz: float | None = None
    """Added to it at the receiver's place."""
    tuned_hz: float | None = None
    """What the receiver was last told, after the LO was subtracted."""
    read_back_hz: float | None = None
    """What it says that it is tuned to."""
    strength_db: float | None = None
    """`l STRENGTH`: dB, over S9 with a real radio, over full scale with an SDR."""
    strength_refused: int | None = None
    """The code behind RPRT with which it refused `l STRENGTH`."""
    strength_at: datetime | None = None
    """When that was read: the middle between the question and its answer."""
    strength_read_s: float | None = None
    """The same in monotonic seconds."""
    recording: bool | None = None
    """Whether it was told AOS and not LOS yet, and took it; None if it does not know these words.

    That is no proof of a recording: SDR++ takes AOS with its recording switched off, too.
    """
    sentence: str = ""

    @property
    def demo(self) -> bool:
        """Whether it is a simulated one: what it hears is marked beside a real dish, too."""
        return self.address.startswith("sim:")
