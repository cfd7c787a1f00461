"""The satellites that are watched, and what the user says of them: the catalogue, or what ships while it is empty."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

from birdcage.sky.elements import ElementSet

if TYPE_CHECKING:
    from birdcage.sky.catalogue import CatalogueEntry


@dataclass(frozen=True, slots=True)
class Watched:
    """A catalogue as read at one moment."""

    elements: tuple[ElementSet, ...]
    note: str = ""
    """What has to be said of them: that they are old, or why the catalogue could not be read."""
    favourites: frozenset[int] = frozenset()
    """Places in `elements`, as those below."""
    priorities: Mapping[int, int] = field(default_factory=dict)
    time_offsets: Mapping[int, float] = field(default_factory=dict)
    """How many seconds later than computed a satellite comes."""

    @classmethod
    def of(cls, entries: Sequence[CatalogueEntry], note: str = "") -> Watched:
        """Return what the catalogue says of these satellites."""
        return cls(
            tuple(entry.elements for entry in entries),
            note,
            frozenset(index for index, entry in enumerate(entries) if entry.favourite),
            {index: entry.priority for index, entry in enumerate(entries) if entry.priority},
            {index: entry.time_offset_s for index, entry in enumerate(entries) if entry.time_offset_s},
        )

    def chosen(self, keep: Callable[[ElementSet], bool]) -> Watched:
        """Return those satellites that `keep` says yes to, with all that is said of them."""
        return self.part([index for index, one in enumerate(self.elements) if keep(one)])

    def part(self, places: Sequence[int]) -> Watched:
        """Return the satellites at some places, in that order, with all that is said of them."""
        new = {index: place for place, index in enumerate(places)}
        return Watched(
            tuple(self.elements[index] for index in places),
            self.note,
            frozenset(new[index] for index in self.favourites if index in new),
            {new[index]: value for index, value in self.priorities.items() if index in new},
            {new[index]: value for index, value in self.time_offsets.items() if index in new},
        )


def read_entries(path: Path) -> tuple[CatalogueEntry, ...]:
    """Return what the catalogue holds; nothing where there is no file, and none is made. StoreError if unreadable."""
    from birdcage.sky.catalogue import Catalogue

    if not path.exists():
        return ()
    with Catalogue(path) as catalogue:
        return catalogue.entries()


def read_catalogue(path: Path) -> Watched:
    """Return the same to be watched; the frozen set, with a note, if that is nothing. StoreError if unreadable."""
    entries = read_entries(path)
    return Watched.of(entries) if entries else frozen_set()


def frozen_set() -> Watched:
    """Return the elements that ship, with a note that says how old they are."""
    from birdcage.sky.frozen import frozen

    elements = frozen()
    newest = max(one.epoch for one in elements)
    return Watched(
        elements,
        f"The catalogue is empty. These are the {len(elements)} sets that ship with birdcage, the newest of "
        f"{newest:%Y-%m-%d}. They are too old for pointing.",
    )
