"""Who sends what, where: the table that ships (`data/downlinks.toml`) and the user's own over it."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from fnmatch import fnmatchcase
from typing import Literal

Polarization = Literal["RHCP", "LHCP", "circular", "horizontal", "vertical", "linear"]
POLARIZATIONS: tuple[Polarization, ...] = ("RHCP", "LHCP", "circular", "horizontal", "vertical", "linear")
"""`circular` and `linear` are both hands and both planes, or which one is not known."""
_ODD = re.compile(r"[^a-z0-9*]")
SAME_SLOT_DEG = 0.6
"""As near as this two longitudes are one place on the arc: the least distance of two neighbours is about a degree."""


@dataclass(frozen=True, slots=True)
class Downlink:
    """One transmitter, or one band of a place on the arc."""

    satellite: str
    freq_min_hz: float
    freq_max_hz: float
    """The same as `freq_min_hz` where one frequency is told."""
    mode: str
    polarization: Polarization | None
    """None if it is not known."""
    alive: bool | None
    """Whether it was on the air at `date`; None if that is not known."""
    source: str
    """Who says so."""
    date: str
    """What day, month or year the source speaks of; when it was read, where it does not say. `2026-10-16`, `2025`."""
    silent_since: str = ""
    """The day, month or year in which it fell silent; empty for what is on the air, or where that is not known."""
    norad_id: int = 0
    """0 where it is not one satellite, or its number is not known."""
    longitude_deg: float | None = None
    """Its place on the arc, east positive; None for what moves. Of `slots.toml` where that knows the satellite."""
    names: tuple[str, ...] = ()
    """What else it is called in lists; `*` stands for anything."""
    note: str = ""
    symbol_rate_baud: float | None = None
    """Symbols a second, before any error correction is taken off; None if it has none, or it is not known."""
    pipeline: str = ""
    """What SatDump calls the way from this signal to its data; empty if it has none, or none was verified."""
    pipeline_live: bool = True
    """Whether SatDump decodes it while it is received; False: only from a recording."""
    own: bool = False
    """Whether it is of the user's own file."""

    @property
    def center_hz(self) -> float:
        """The middle of it."""
        return (self.freq_min_hz + self.freq_max_hz) / 2.0

    @property
    def kind(self) -> Literal["linear", "circular"] | None:
        """What kind its polarisation is; None if that is not known."""
        if self.polarization is None:
            return None
        return "circular" if self.polarization in ("RHCP", "LHCP", "circular") else "linear"

    @property
    def key(self) -> tuple[str, int, int]:
        """What the user's file replaces it by: satellite and frequency, to the kHz."""
        return plain(self.satellite), round(self.freq_min_hz / 1e3), round(self.freq_max_hz / 1e3)

    def is_of(self, norad_id: int, name: str) -> bool:
        """Return whether a satellite of a catalogue sends it: by number where both have one, else by name."""
        if self.norad_id and norad_id:
            return self.norad_id == norad_id
        return any(fnmatchcase(each, pattern) for each in called(name) for pattern in self.patterns)

    @property
    def patterns(self) -> tuple[str, ...]:
        """What it is called, as `called` returns names; `*` stands for anything."""
        return tuple(plain(each) for each in (self.satellite, *self.names))


def called(name: str) -> frozenset[str]:
    """Return what a satellite of a list is called: `RADFXSAT (FOX-1B)` is three names."""
    parts = (name, *re.findall(r"\(([^)]+)\)", name), re.sub(r"\(.*?\)", "", name))
    return frozenset(filter(None, map(plain, parts)))


def plain(name: str) -> str:
    """Return a name without what people write differently: case, spaces, hyphens."""
    return _ODD.sub("", name.casefold())


@dataclass(frozen=True, slots=True)
class Downlinks:
    """The whole table."""

    entries: tuple[Downlink, ...]
    problems: tuple[str, ...] = ()
    """What of the user's file could not be read, with file, line and key."""

    def __iter__(self) -> Iterator[Downlink]:
        return iter(self.entries)

    def __len__(self) -> int:
        return len(self.entries)

    def of(self, norad_id: int, name: str) -> tuple[Downlink, ...]:
        """Return what a satellite sends, as far as it is known."""
        return tuple(each for each in self.entries if each.is_of(norad_id, name))

    def at(self, longitude_deg: float) -> tuple[Downlink, ...]:
        """Return what comes from a place on the arc."""
        return tuple(
            each
            for each in self.entries
            if each.longitude_deg is not None
            and abs((each.longitude_deg - longitude_deg + 180.0) % 360.0 - 180.0) <= SAME_SLOT_DEG
        )
