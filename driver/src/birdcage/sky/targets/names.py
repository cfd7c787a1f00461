"""What people call satellites: the names and numbers of the table of downlinks, and which of them are silent."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterable
from dataclasses import dataclass
from fnmatch import fnmatchcase

from birdcage.sky.downlinks import Downlink

_BRACKETS = re.compile(r"\(([^)]*)\)")


def plain(name: str) -> str:
    """Return a name without case, accents, blanks and punctuation: QO-100, qo 100 and QO100 are one."""
    folded = unicodedata.normalize("NFKD", name.casefold())
    return "".join(sign for sign in folded if sign.isalnum())


def names_of(name: str) -> frozenset[str]:
    """Return what a satellite of a list is called, plain: `ISS (ZARYA)` is `isszarya`, `iss` and `zarya`."""
    parts = (name, _BRACKETS.sub("", name), *_BRACKETS.findall(name))
    return frozenset(filter(None, map(plain, parts)))


@dataclass(frozen=True, slots=True)
class OffAir:
    """That a satellite is off the air, and who says so."""

    since: str
    """Day, month or year; empty if no source says it."""
    seen: str
    """What day, month or year the source speaks of."""
    source: str

    def words(self, name: str) -> str:
        """Return the sentence: `NOAA 19 has been silent since 2025-08-13 (source: NOAA, scijinks.gov).`."""
        when = (
            f"has been silent since {self.since}" if self.since else f"was off the air when last told of ({self.seen})"
        )
        return f"{name} {when} (source: {self.source})."

    @property
    def brief(self) -> str:
        """For a row: `silent since 2025-08-13`."""
        return f"silent since {self.since}" if self.since else "off the air"


@dataclass(frozen=True, slots=True)
class NamedSender:
    """A satellite, or a fleet, of the table of downlinks."""

    name: str
    norad_id: int
    """0 for a fleet, and where it is not known."""
    longitude_deg: float | None
    """Its place on the arc, east positive; None for what moves."""
    names: tuple[str, ...]
    """What else it is called; `*` stands for anything."""
    silence: OffAir | None
    """None if anything of it is on the air, or that is not known."""

    @property
    def plain_names(self) -> frozenset[str]:
        """All that it is called, plain; without those that stand for many."""
        return frozenset().union(*(names_of(each) for each in (self.name, *self.names) if "*" not in each))

    @property
    def patterns(self) -> tuple[str, ...]:
        """The names that stand for many, plain but for their `*`."""
        return tuple("*".join(map(plain, each.split("*"))) for each in self.names if "*" in each)

    def is_called(self, name: str) -> bool:
        """Return whether a plain name is one of its own."""
        return name in self.plain_names or any(fnmatchcase(name, each) for each in self.patterns)

    def is_of(self, norad_id: int, name: str) -> bool:
        """Return whether it is a satellite of a catalogue: by number where both have one, else by name."""
        if self.norad_id and norad_id:
            return self.norad_id == norad_id
        return any(self.is_called(each) for each in names_of(name))


def senders(downlinks: Iterable[Downlink]) -> tuple[NamedSender, ...]:
    """Return the satellites of a table, in its order: one for each number, or name where there is none."""
    rows: dict[object, list[Downlink]] = {}
    for each in downlinks:
        rows.setdefault(each.norad_id or plain(each.satellite), []).append(each)
    return tuple(map(_sender, rows.values()))


def _sender(rows: list[Downlink]) -> NamedSender:
    first = rows[0]
    names = dict.fromkeys(name for row in rows for name in (row.satellite, *row.names))
    names.pop(first.satellite)
    place = next((row.longitude_deg for row in rows if row.longitude_deg is not None), None)
    return NamedSender(first.satellite, first.norad_id, place, tuple(names), _silence(rows))


def _silence(rows: list[Downlink]) -> OffAir | None:
    if any(row.alive is not False for row in rows):
        return None
    last = max(rows, key=lambda row: row.silent_since)
    # What the source says, and the sources of frequency and polarisation, stand behind it.
    return OffAir(last.silent_since, last.date, last.source.split(";")[0].split(": ")[0].strip())
