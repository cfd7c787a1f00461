"""The targets that can be chosen: the catalogue as it is read anew after every change, bodies, slots, directions."""

from __future__ import annotations

from dataclasses import replace
from datetime import datetime
from pathlib import Path
from typing import TYPE_CHECKING

from birdcage.base.errors import StoreError
from birdcage.base.reason import Reason
from birdcage.base.store import fingerprint
from birdcage.pursuit.now import TargetMatch

if TYPE_CHECKING:
    from birdcage.sky.catalogue import CatalogueEntry
    from birdcage.sky.observer import Observer
    from birdcage.sky.targets import Resolution, Resolver, TargetCandidate

MOST = 40
"""Rows of an answer."""


class Finder:
    """Looks targets up. For one thread alone."""

    def __init__(self, catalogue: Path, downlinks: Path | None = None) -> None:
        self._path, self._downlinks = catalogue, downlinks
        self._seen: tuple[object, ...] | None = None
        self._entries: tuple[CatalogueEntry, ...] = ()
        self._resolver: Resolver | None = None
        self.problem = ""
        """Why the catalogue could not be read; what was read before still counts."""

    def refresh(self) -> bool:
        """Read the catalogue if its file has changed; return whether it had. The sets that ship where it is empty."""
        from birdcage.sky.catalogue import CatalogueEntry, SearchIndex
        from birdcage.sky.downlinks_read import load_downlinks
        from birdcage.sky.frozen import frozen
        from birdcage.sky.targets import Resolver
        from birdcage.sky.watch_source import read_entries

        seen = fingerprint(self._path)
        if seen == self._seen:
            return False
        self._seen = seen
        try:
            entries = read_entries(self._path)
        except StoreError as error:
            self.problem = str(error)
            if self._resolver is not None:
                return False
            entries = ()
        else:
            self.problem = ""
        self._entries = entries or tuple(CatalogueEntry(each, each.epoch) for each in frozen())
        self._resolver = Resolver(SearchIndex(self._entries), load_downlinks(self._downlinks))
        # Reading it makes files beside it that were not there before.
        self._seen = fingerprint(self._path)
        return True

    @property
    def favourites(self) -> tuple[CatalogueEntry, ...]:
        """The favourites, those of high priority first."""
        found = (each for each in self._entries if each.favourite)
        return tuple(sorted(found, key=lambda each: (-each.priority, each.name.casefold())))

    def entry(self, norad_id: int) -> CatalogueEntry | None:
        """Return what the catalogue has of a satellite; None for nothing, and for number 0."""
        return next((each for each in self._entries if norad_id and each.norad_id == norad_id), None)

    def resolve(self, text: str) -> Resolution:
        """Return what a text means, or why it means no single target."""
        from birdcage.sky.targets import Resolver

        return (self._resolver or Resolver()).resolve(text)

    def search(self, text: str, now: datetime, observer: Observer | None = None) -> tuple[tuple[TargetMatch, ...], str]:
        """Return what a text may mean, best first, and what is to be said of that: why it is none of them, or nothing.

        For an empty text the favourites, and then the bodies.
        """
        from birdcage.sky.ephemeris.bodies import BODIES
        from birdcage.sky.targets import Resolver, TargetCandidate
        from birdcage.sky.targets.model import BodyTarget

        typed = text.strip()
        if not typed:
            bodies = (TargetCandidate(BodyTarget(body), key) for key, body in BODIES.items())
            favourites = (_of_entry(each, now) for each in self.favourites)
            return (*favourites, *(_of_candidate(each, now, observer) for each in bodies))[:MOST], ""
        resolver = self._resolver or Resolver()
        meant = resolver.resolve(typed)
        rows = list(resolver.find(typed, MOST))
        if meant.found is not None and meant.found not in rows:
            rows.insert(0, meant.found)
        said = meant.problem if not rows or meant.reason is Reason.ABSENT else ""
        return tuple(_of_candidate(each, now, observer) for each in rows[:MOST]), said


def _of_candidate(candidate: TargetCandidate, now: datetime, observer: Observer | None) -> TargetMatch:
    from birdcage.sky.catalogue import CatalogueEntry
    from birdcage.sky.targets.model import SlotTarget

    if isinstance(candidate.hit, CatalogueEntry):
        found = _of_entry(candidate.hit, now)
        if candidate.silence is None:
            return found
        # To the month: a narrow list has no room for more.
        brief = replace(candidate.silence, since=candidate.silence.since[:7]).brief
        return replace(found, detail=f"{brief} · {candidate.hit.norad_id}", silent=True)
    target, detail = candidate.target, ""
    if isinstance(target, SlotTarget):
        never = observer is not None and target.look(observer, now).el_deg <= 0.0
        detail = "never rises here" if never else "nothing sends there" if target.slot.is_empty else "geostationary"
    return TargetMatch(candidate.text, target.name, target.kind, detail)


def _of_entry(entry: CatalogueEntry, now: datetime) -> TargetMatch:
    from birdcage.sky.catalogue.words import span

    age_s = (now - entry.elements.epoch).total_seconds()
    detail = f"{span(age_s)} old" if age_s >= 0.0 else f"epoch in {span(-age_s)}"
    if entry.elements.source == "frozen":
        detail = "frozen elements"
    if entry.norad_id:
        detail = f"{entry.norad_id} · {detail}"
    text = str(entry.norad_id) if entry.norad_id else entry.name
    return TargetMatch(text, entry.name or text, "satellite", detail, entry.favourite)
