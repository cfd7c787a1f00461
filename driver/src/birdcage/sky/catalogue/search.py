"""Search as one types: over ten thousand satellites within milliseconds a keystroke.

Rows stand in the order in which equals are shown (favourites, then priority, then name), so that each kind of match
is one pass over plain strings that ends as soon as there are enough.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence

from birdcage.sky.catalogue.entry import CatalogueEntry

_NOT_A_WORD = re.compile(r"[\W_]+")


class SearchIndex:
    """Finds satellites by name, number, group, tag or international designator. Nothing in it changes."""

    def __init__(self, entries: Iterable[CatalogueEntry]) -> None:
        rows = sorted(entries, key=lambda each: (not each.favourite, -each.priority, each.name.casefold()))
        self._entries = tuple(rows)
        self._names = [f" {_plain(each.name)}" for each in rows]
        self._tight = [name.replace(" ", "") for name in self._names]
        self._numbers = [str(each.norad_id) if each.norad_id else "" for each in rows]
        self._labels = [
            f" {' '.join(map(_plain, (*each.groups, *each.tags, each.elements.international_designator)))}"
            for each in rows
        ]
        self._all = [
            f"{name} {number}{labels}"
            for name, number, labels in zip(self._names, self._numbers, self._labels, strict=True)
        ]

    def __len__(self) -> int:
        return len(self._entries)

    def names(self) -> tuple[str, ...]:
        """Return what all of them are called."""
        return tuple(each.name for each in self._entries if each.name)

    def search(self, text: str, limit: int = 20) -> tuple[CatalogueEntry, ...]:
        """Return the best matches, best first.

        First the very number, then names that begin so, names with a word that begins so, numbers that begin so,
        groups and tags, names that contain it, and last what has words that begin like each of these.

        Case, hyphens and brackets do not count. An empty text gives what stands first in the order.
        """
        wanted = _plain(text)
        if limit <= 0:
            return ()
        if not wanted:
            return self._entries[:limit]
        found: dict[int, None] = {}
        for row in self._ranked(wanted):
            found.setdefault(row)
            if len(found) == limit:
                break
        return tuple(self._entries[row] for row in found)

    def _ranked(self, wanted: str) -> Iterator[int]:
        """Yield rows, best first, some more than once."""
        begins, tight = f" {wanted}", wanted.replace(" ", "")
        number = wanted.lstrip("0") if wanted.isdigit() else None
        if number is not None:
            yield from (row for row, each in enumerate(self._numbers) if each == number)
        yield from (row for row, each in enumerate(self._names) if each.startswith(begins))
        yield from (row for row, each in enumerate(self._names) if begins in each)
        if number:
            yield from (row for row, each in enumerate(self._numbers) if each.startswith(number))
        yield from (row for row, each in enumerate(self._labels) if begins in each)
        yield from (row for row, each in enumerate(self._names) if wanted in each)
        yield from (row for row, each in enumerate(self._tight) if tight in each)
        if " " in wanted:
            rows: Sequence[int] = range(len(self._all))
            for word in wanted.split():
                rows = [row for row in rows if f" {word}" in self._all[row]]
            yield from rows


def _plain(text: str) -> str:
    return _NOT_A_WORD.sub(" ", text.casefold()).strip()
