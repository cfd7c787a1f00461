"""Decibels of a source that tells only counts: two levels that a person knows, and the straight line through them.

What the counts of these tuners mean was never measured: `docs/decisions` has a page on two known levels.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from birdcage.base.named_tables import NamedTables, TablesRead, number_of
from birdcage.signal.source import Scale, SignalFacts

MOST_DB = 200.0
HEADER = "# Levels that somebody knows in dB, two for each source and feed. A line between them is assumed.\n\n"


@dataclass(frozen=True, slots=True)
class KnownLevel:
    """One of them: what the source tells, and what that is in dB over whatever 0 dB was chosen to be."""

    value: float
    db: float


@dataclass(frozen=True, slots=True)
class LevelScale:
    """Of a source as one feed is mounted."""

    source: str
    feed: str
    low: KnownLevel
    high: KnownLevel

    @property
    def name(self) -> str:
        """What tells it from others in the file."""
        return f"{self.source} / {self.feed}"

    @property
    def db_per_step(self) -> float:
        """How many dB a step of 1 is."""
        return (self.high.db - self.low.db) / (self.high.value - self.low.value)

    def db(self, value: float) -> float:
        """Return a level in dB, by the straight line."""
        return self.low.db + (value - self.low.value) * self.db_per_step

    def covers(self, value: float) -> bool:
        """Return whether it lies between both levels: beyond them the line was seen nowhere."""
        return self.low.value <= value <= self.high.value

    def words(self, unit: str) -> str:
        """Return both levels in words."""
        return f"{self.low.value:g} {unit} = {self.low.db:g} dB, {self.high.value:g} {unit} = {self.high.db:g} dB"


def checked_scale(source: str, feed: str, one: KnownLevel, other: KnownLevel) -> LevelScale:
    """Return a scale of two levels in any order. ValueError says what is wrong with them, in a sentence."""
    low, high = sorted((one, other), key=lambda each: each.value)
    if not all(map(math.isfinite, (low.value, high.value))) or max(abs(low.value), abs(high.value)) > 1e9:
        raise ValueError("A level is a number as the source tells it")
    if not all(abs(each.db) <= MOST_DB for each in (low, high)):
        raise ValueError(f"Decibels lie from -{MOST_DB:g} to {MOST_DB:g}")
    if low.value == high.value:
        raise ValueError(f"Both levels are {low.value:g}. Two different ones make a scale")
    if low.db >= high.db:
        raise ValueError(f"The stronger level, {high.value:g}, must have more than {low.db:g} dB. It has {high.db:g}")
    return LevelScale(source, feed, low, high)


def why_no_scale(facts: SignalFacts) -> str:
    """Return why a source needs no such scale; empty for one whose values have none."""
    if facts.scale is Scale.LOG:
        return f"The {facts.label} tells decibels already."
    if facts.scale is Scale.LINEAR:
        return f"The {facts.label} tells power itself: ten times the value is 10 dB."
    return ""


def load_scales(path: Path) -> TablesRead[LevelScale]:
    """Read all of them; nothing is raised: what is wrong stands in `problems`."""
    return _FILE.load(path)


def find_scale(scales: Iterable[LevelScale], source: str, feed: str) -> LevelScale | None:
    """Return the one of this source with this feed; None if there is none."""
    return next((each for each in scales if (each.source, each.feed) == (source, feed)), None)


def keep_scale(path: Path, scale: LevelScale) -> TablesRead[LevelScale]:
    """Keep it in the place of an earlier one. ConfigError, nothing written: damaged, or can't be written."""
    if find_scale(load_scales(path).entries, scale.source, scale.feed) is None:
        return _FILE.add(path, scale)
    return _FILE.replace(path, scale.name, scale)


def remove_scale(path: Path, scale: LevelScale) -> TablesRead[LevelScale]:
    """Take it out. ConfigError, with nothing written, as with `keep_scale`."""
    return _FILE.delete(path, scale.name)


def _read(row: dict[str, object]) -> LevelScale:
    source, feed = row.get("source"), row.get("feed")
    if not isinstance(source, str) or not isinstance(feed, str) or not source or not feed:
        raise ValueError("two known levels name their source and feed")
    low, high = (
        KnownLevel(number_of(row, name, "the source's own unit"), number_of(row, f"{name}_db", "decibels"))
        for name in ("low", "high")
    )
    return checked_scale(source, feed, low, high)


def _cells(scale: LevelScale) -> dict[str, object]:
    return {
        "source": scale.source, "feed": scale.feed, "low": scale.low.value, "low_db": scale.low.db,
        "high": scale.high.value, "high_db": scale.high.db,
    }  # fmt: skip


_FILE = NamedTables("levels", "known levels", HEADER, read=_read, cells=_cells)
