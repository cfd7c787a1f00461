"""Which passes the list shows, and in which order."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence

from birdcage_tui.shown.sky_picture import ShownPass

SORTS = ("next event", "minutes in reach", "highest", "AOS")
"""What happens next first; the longest in reach first; the highest first; by rise."""
_NOT_A_WORD = re.compile(r"[\W_]+")
_KEYS: dict[str, Callable[[ShownPass], tuple[float, float]]] = {
    "minutes in reach": lambda row: (-row.reach_s, row.aos_s),
    "highest": lambda row: (-row.max_el_deg, row.aos_s),
    "AOS": lambda row: (row.aos_s, 0.0),
}


def _plain(text: str) -> str:
    return _NOT_A_WORD.sub(" ", text.casefold()).strip()


def matcher(text: str) -> Callable[[ShownPass], bool]:
    """Return what tells whether a pass is meant: every word begins a word of its names, number or groups.

    Case, hyphens and brackets do not count; `metop`, `noaa 20`, `57166`, `weather` and `ao-91` all find theirs.
    """
    words = _plain(text).split()
    known: dict[tuple[str, int, tuple[str, ...]], bool] = {}

    def meant(row: ShownPass) -> bool:
        key = (row.name, row.norad_id, row.groups)
        found = known.get(key)
        if found is None:
            names = [_plain(name) for name in (row.name, *row.also)]
            label = f" {' '.join(names)} {row.norad_id or ''} {' '.join(map(_plain, row.groups))}"
            tight = "".join(words)
            found = all(f" {word}" in label for word in words) or any(tight in n.replace(" ", "") for n in names)
            known[key] = found
        return found

    return meant if words else lambda _: True


class PassFilter:
    """Filter and order; the result is kept as long as nothing of that changes."""

    def __init__(self) -> None:
        self.filter = ""
        self.sort = SORTS[0]
        self.reachable_only = False
        self.favourites_only = False
        self.hearable_only: bool | None = None
        """None: as the sky begins."""
        self._of: Sequence[ShownPass] = ()
        self._kept: tuple[object, list[ShownPass]] | None = None
        self._left: tuple[int, list[ShownPass]] | None = None

    def next_sort(self) -> str:
        """Take the next order, and return its name."""
        self.sort = SORTS[(SORTS.index(self.sort) + 1) % len(SORTS)]
        return self.sort

    def of(self, rows: Sequence[ShownPass], t_s: float, *, hearable: bool = False) -> list[ShownPass]:
        """Return the passes to show at a moment: those that are not over, to the second.

        `hearable`: only what the feed in use hears.
        """
        key = (self.filter, self.sort, self.reachable_only, self.favourites_only, hearable)
        if self._kept is None or self._kept[0] != key or self._of is not rows:
            self._of, self._kept, self._left = rows, (key, self._chosen(rows, hearable)), None
        if self._left is None or self._left[0] != int(t_s):
            left = [row for row in self._kept[1] if row.los_s > t_s]
            if self.sort not in _KEYS:  # what comes next changes with every moment
                left.sort(key=lambda row: (row.next_event(t_s) or (row.los_s, ""))[0])
            self._left = int(t_s), left
        return self._left[1]

    def _chosen(self, rows: Sequence[ShownPass], hearable: bool) -> list[ShownPass]:
        """Leave out what is up all the time, too, unless it is asked for by name."""
        meant = matcher(self.filter)
        chosen = [
            row for row in rows
            if (not row.stays or self.filter)
            and (not self.reachable_only or row.reach_s > 0)
            and (not self.favourites_only or row.favourite)
            and (not hearable or row.hears)
            and meant(row)
        ]  # fmt: skip
        return sorted(chosen, key=_KEYS[self.sort]) if self.sort in _KEYS else chosen
