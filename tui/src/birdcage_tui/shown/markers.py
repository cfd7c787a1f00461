"""Moments that a person has marked on the strip: when, how strong it was, and where the dish pointed."""

from __future__ import annotations

from collections import deque
from collections.abc import Sequence
from dataclasses import dataclass
from datetime import datetime

MOST = 9
"""Kept at once; then the oldest gives way."""


@dataclass(frozen=True, slots=True)
class Marker:
    """One of them. The level is in the unit of its source."""

    number: int
    at: float
    """Monotonic seconds."""
    utc: datetime
    level: float
    az_deg: float | None
    """True; None where that was not known."""
    el_deg: float | None


class Markers:
    """Those of one source, numbered from 1 on."""

    def __init__(self) -> None:
        self._kept: deque[Marker] = deque(maxlen=MOST)
        self._set = 0

    @property
    def kept(self) -> Sequence[Marker]:
        """The newest last."""
        return tuple(self._kept)

    def add(self, at: float, utc: datetime, level: float, az_deg: float | None, el_deg: float | None) -> Marker:
        """Set one more."""
        self._set += 1
        marker = Marker(self._set, at, utc, level, az_deg, el_deg)
        self._kept.append(marker)
        return marker
