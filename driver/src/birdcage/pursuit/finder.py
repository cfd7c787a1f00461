"""The targets that can be chosen: the catalogue as it is read anew after every change, bodies, slots, directions."""

from __future__ import annotations

from datetime import datetime
from pathlib import Path
from typing import TYPE_CHECKING

from birdcage.base.errors import StoreError
from birdcage.base.store import fingerprint
from birdcage.pursuit.now import Found

if TYPE_CHECKING:
    from birdcage.sky.catalogue import Entry, SearchIndex
    from birdcage.sky.targets import Target

MOST = 40
"""Rows of an answer."""


class Finder:
    """Looks targets up. For one thread alone."""

    def __init__(self, catalogue: Path) -> None:
        self._path = catalogue
        self._seen: tuple[object, ...] | None = None
        self._entries: tuple[Entry, ...] = ()
        self._index: SearchIndex | None = None
        self.problem = ""
        """Why the catalogue could not be read; what was read before still counts."""

    def refresh(self) -> bool:
        """Read the catalogue if its file has changed; return whether it had. The sets that ship where it is empty."""
        from birdcage.sky.catalogue import Entry, SearchIndex
        from birdcage.sky.frozen import frozen
        from birdcage.sky.watch_source import read_entries

        seen = fingerprint(self._path)
        if seen == self._seen:
            return False
        self._seen = seen
        try:
            entries = read_entries(self._path)
        except StoreError as error:
            self.problem = str(error)
            if self._index is not None:
                return False
            entries = ()
        else:
            self.problem = ""
        self._entries = entries or tuple(Entry(each, each.epoch) for each in frozen())
        self._index = SearchIndex(self._entries)
        # Reading it makes files beside it that were not there before.
        self._seen = fingerprint(self._path)
        return True

    @property
    def favourites(self) -> tuple[Entry, ...]:
        """The favourites, those of high priority first."""
        found = (each for each in self._entries if each.favourite)
        return tuple(sorted(found, key=lambda each: (-each.priority, each.name.casefold())))

    def entry(self, norad_id: int) -> Entry | None:
        """Return what the catalogue has of a satellite; None for nothing, and for number 0."""
        return next((each for each in self._entries if norad_id and each.norad_id == norad_id), None)

    def target(self, text: str) -> Target:
        """Return the target that is meant. UnknownTarget with a sentence."""
        from birdcage.sky.targets import parse_target

        return parse_target(text, self._index)

    def search(self, text: str, now: datetime) -> tuple[Found, ...]:
        """Return what a text may mean, best first; for an empty one the favourites, and then the bodies."""
        from birdcage.sky.targets import UnknownTarget

        typed = text.strip()
        if not typed:
            return (*(_of_entry(each, now) for each in self.favourites), *_bodies(""))[:MOST]
        try:
            meant = self.target(typed)
        except UnknownTarget:
            meant = None
        found = [] if meant is None or meant.kind in ("satellite", "body") else [_of_target(meant, typed)]
        found += _bodies(typed)
        if self._index is not None:
            found += [_of_entry(each, now) for each in self._index.search(typed, MOST)]
        found += [each for each in _slots(typed) if each.name not in {one.name for one in found}]
        return tuple(found[:MOST])


def _of_entry(entry: Entry, now: datetime) -> Found:
    from birdcage.sky.catalogue.words import span

    age_s = (now - entry.elements.epoch).total_seconds()
    detail = f"{span(age_s)} old" if age_s >= 0.0 else f"epoch in {span(-age_s)}"
    if entry.elements.source == "frozen":
        detail = "frozen elements"
    if entry.norad_id:
        detail = f"{entry.norad_id} · {detail}"
    text = str(entry.norad_id) if entry.norad_id else entry.name
    return Found(text, entry.name or text, "satellite", detail, entry.favourite)


def _of_target(target: Target, typed: str) -> Found:
    return Found(typed, target.name, target.kind, "geostationary" if target.kind == "slot" else "")


def _bodies(typed: str) -> list[Found]:
    from birdcage.sky.ephemeris.bodies import BODIES

    wanted = typed.casefold()
    return [Found(key, body.name, "body") for key, body in BODIES.items() if key.startswith(wanted)]


def _slots(typed: str) -> list[Found]:
    from birdcage.sky.slots import slots
    from birdcage.sky.targets.model import SlotTarget

    wanted = typed.casefold()
    return [
        Found(slot.label, SlotTarget(slot).name, "slot", "geostationary")
        for slot in slots()
        if any(wanted in name.casefold() for name in (slot.label, slot.name, *slot.aliases))
    ]
