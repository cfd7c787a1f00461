"""What the panes of the page share: the moment shown, the choice of passes, and the chosen one."""

from __future__ import annotations

from datetime import UTC, datetime, timedelta

from birdcage_tui.passes.choose import PassFilter
from birdcage_tui.passes.machine import TimeMachine
from birdcage_tui.shown.sky_picture import ShownPass, SkyPicture
from birdcage_tui.shown.view import View

BACK_S = 3600.0
"""How far back the time machine goes, as far as passes are still known."""
EMPTY = SkyPicture(0.0)


def utc_of(t_s: float) -> datetime:
    """Return a time as UTC."""
    return datetime(1970, 1, 1, tzinfo=UTC) + timedelta(seconds=t_s)


class PassSelection:
    """One for the page."""

    def __init__(self) -> None:
        self.machine = TimeMachine()
        self.choice = PassFilter()
        self.chosen_key: tuple[int, str, int] | None = None
        """None: the first of the list, whatever that is."""
        self.world = False
        """Whether the map of the world stands in place of list, path and timeline."""
        self._kept: tuple[View, list[ShownPass], int] | None = None

    def changed(self) -> None:
        """Work out anew what is listed: another choice was made."""
        self._kept = None

    def sky(self, view: View) -> SkyPicture:
        """Return what is known of the sky."""
        return EMPTY if view.sky is None else view.sky

    def time(self, view: View) -> float:
        """Return the moment that is shown, POSIX seconds."""
        now_s = view.utc.timestamp()
        sky = self.sky(view)
        first = sky.rows[0].aos_s if sky.rows else now_s
        last = sky.until_s if sky.until_s is not None else now_s + 86400.0
        self.machine.bounds = (min(now_s, max(now_s - BACK_S, first)), max(last, now_s))
        return self.machine.time(now_s)

    def hearable(self, view: View) -> bool:
        """Return whether only what the feed in use hears is listed."""
        sky, wanted = self.sky(view), self.choice.hearable_only
        return bool(sky.feed) and (sky.hear_first if wanted is None else wanted)

    def _listed(self, view: View) -> tuple[list[ShownPass], int]:
        if self._kept is None or self._kept[0] is not view:
            rows = self.choice.of(self.sky(view).rows, self.time(view), hearable=self.hearable(view))
            self._kept = (view, rows, self._index(rows))
        return self._kept[1], self._kept[2]

    def rows(self, view: View) -> list[ShownPass]:
        """Return the passes of the list."""
        return self._listed(view)[0]

    def index(self, view: View) -> int:
        """Return which row is chosen; the first where the chosen pass is over or filtered out."""
        return self._listed(view)[1]

    def chosen(self, view: View) -> ShownPass | None:
        """Return the chosen pass; None when the list is empty."""
        rows, index = self._listed(view)
        return rows[index] if rows else None

    def _index(self, rows: list[ShownPass]) -> int:
        if self.chosen_key is not None:
            number, name, minute = self.chosen_key
            for index, row in enumerate(rows):
                if row.norad_id == number and row.name == name and abs(row.key[2] - minute) <= 1:
                    return index
        return 0

    def choose(self, row: ShownPass | None) -> None:
        """Choose a pass; None for whatever stands first."""
        self.chosen_key = None if row is None else row.key
        self.changed()

    def move(self, view: View, by: int) -> None:
        """Choose another row of the list."""
        rows, index = self._listed(view)
        if rows:
            self.choose(rows[min(max(index + by, 0), len(rows) - 1)])
