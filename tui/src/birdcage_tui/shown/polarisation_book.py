"""What was heard of either polarisation, as the dish told it."""

from __future__ import annotations

from collections import deque
from collections.abc import Mapping, Sequence

from birdcage.rotator.feature import EVEN_LEVEL, ODD_LEVEL
from birdcage.station.events import ReadingRead

MOST = 400
"""Readings of each that are kept: half an hour, at one every five seconds."""

Levels = Mapping[str, Sequence[tuple[float, float]]]
"""By the id of the feature: monotonic seconds and value, the newest last."""


class PolarisationBook:
    """For one thread, apart from `wants`."""

    def __init__(self) -> None:
        self._heard: dict[str, deque[tuple[float, float]]] = {
            each: deque(maxlen=MOST) for each in (EVEN_LEVEL, ODD_LEVEL)
        }

    def wants(self, feature: str) -> bool:
        """Return whether it keeps a feature. Any thread."""
        return feature in self._heard

    def take(self, reading: ReadingRead) -> None:
        """Keep a reading of one of them."""
        self._heard[reading.feature].append((reading.at, float(reading.value)))

    @property
    def levels(self) -> Levels:
        """What was heard."""
        return {name: tuple(heard) for name, heard in self._heard.items()}
