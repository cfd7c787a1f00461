"""What a GPS receiver told."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import datetime, timedelta

from birdcage.base.errors import BirdcageError
from birdcage.base.reason import Reason

LATE_S = 0.5
"""How late a report may be: receivers send it some tenths of a second after the moment that it names."""


class NoFix(BirdcageError):
    """No place by GPS; the message says what was seen. Reasons: silent, no_fix, no_gps, busy."""

    reason = Reason.NO_FIX


@dataclass(frozen=True, slots=True)
class GpsFix:
    """A place and a time, in WGS84 and UTC. What was not told is None."""

    latitude_deg: float
    longitude_deg: float
    height_m: float | None
    """Above the ellipsoid."""
    utc: datetime | None
    """The moment that the report names."""
    received_utc: datetime
    """What this machine's clock said when its last byte had come."""
    satellites: int | None
    hdop: float | None
    """How much the satellites' places blur the position: 1 is good, above 5 is poor."""
    source: str
    """`gpsd at localhost:2947`, `/dev/ttyACM0 at 9600 baud`."""

    @property
    def clock_offset_s(self) -> float | None:
        """How far this machine's clock is ahead of GPS, to about half a second; None when no time was told."""
        return None if self.utc is None else (self.received_utc - self.utc) / timedelta(seconds=1)
