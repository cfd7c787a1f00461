"""The next passes of the chosen target, to choose from."""

from __future__ import annotations

from typing import TYPE_CHECKING, cast

from textual import events

from birdcage_tui.drawing.canvas import Cells
from birdcage_tui.drawing.cell_text import wrap
from birdcage_tui.feeds.app_host import AppHost
from birdcage_tui.shown.pass_words import EDGES, length_text, reasons_text
from birdcage_tui.shown.pursuit import plan_of
from birdcage_tui.shown.track_words import left_text, pass_words, reach_words
from birdcage_tui.shown.view import View
from birdcage_tui.widgets.pane import Pane

if TYPE_CHECKING:
    from birdcage.sky.pass_row import PassRow


def passes_of(view: View) -> tuple[PassRow, ...]:
    """Return the passes of the choice that are not over."""
    rows = () if view.track is None else view.track.passes
    return tuple(row for row in rows if row.passing.los > view.utc)


def _no_passes(view: View) -> str:
    """Return why there are none."""
    plan = plan_of(view)
    standing = "" if plan is None or plan.day is None else plan.day.standing
    if standing:
        return f"{standing[0].upper()}{standing[1:]}: it makes no passes."
    if plan is None or plan.passing is not None or not (told := pass_words(plan)):
        return "No passes soon."
    if plan.day is not None:  # its rising, setting and reach stand in the first rows of the tab
        return f"{plan.aim.name} needs no pass to be followed: its times are in the rows at the top."
    return f"{plan.aim.name} {told}, {reach_words(plan, 80, view.utc.timestamp())}."


class TrackPasses(Pane):
    """Rows with a cursor; the one whose plan is drawn has a mark."""

    def __init__(self, *, id: str | None = None) -> None:  # noqa: A002
        super().__init__(id=id)
        self.border_title = "Passes of the target"
        self.cursor = 0
        self._top = 0

    def move(self, by: int) -> None:
        """Move the cursor."""
        if self.view is not None:
            self.cursor = min(max(self.cursor + by, 0), max(len(passes_of(self.view)) - 1, 0))
            self.show(self.view)

    def chosen(self, view: View) -> PassRow | None:
        """Return the one under the cursor; None when there is none."""
        rows = passes_of(view)
        return rows[min(self.cursor, len(rows) - 1)] if rows else None

    def draw(self, cells: Cells, view: View) -> None:
        """Write the columns' names, then the rows around the cursor."""
        rows = passes_of(view)
        if not rows:
            chosen = view.track is not None and view.track.choice is not None
            words = _no_passes(view) if chosen else "No target selected."
            for y, line in enumerate(wrap(words, max(cells.width - 2, 10))):
                cells.put(1, y, line, "dim")
            return
        cells.put(2, 0, "AOS      from    max  to     reach  rises in", "dim")
        self.cursor = min(self.cursor, len(rows) - 1)
        room, plan = max(cells.height - 1, 1), plan_of(view)
        self._top = max(min(self._top, self.cursor, len(rows) - room), self.cursor - room + 1, 0)
        for y, row in enumerate(rows[self._top : self._top + room], 1):
            here = self._top + y - 1 == self.cursor
            drawn = plan is not None and plan.passing is not None and \
                abs((plan.passing.tca - row.passing.tca).total_seconds()) < 60.0  # fmt: skip
            self._row(cells, y, row, view, here, drawn=drawn)

    @staticmethod
    def _row(cells: Cells, y: int, row: PassRow, view: View, here: bool, *, drawn: bool) -> None:
        passing = row.passing
        left_s = (passing.aos - view.utc).total_seconds()
        when = "up now" if left_s <= 0 else left_text(left_s)
        length = length_text(row.reach.total_s) if row.reach.intervals else "none"
        losses = row.reach.words(but=EDGES)
        words = (f"{passing.aos:%H:%M:%S} {passing.aos_azimuth_deg:3.0f}°  {passing.max_elevation_deg:4.0f}° "
                 f"{passing.los_azimuth_deg:4.0f}°  {length:>6}  {when:<8} ")  # fmt: skip
        words += reasons_text(", ".join(losses), max(cells.width - 2 - len(words), 0))
        ink = "accent-row" if here else "text" if row.reach.intervals else "dim"
        cells.put(0, y, f"{'●' if drawn else ' '} ", ink if here else "target")
        cells.put(2, y, words.ljust(cells.width - 2) if here else words, ink)

    def on_click(self, event: events.Click) -> None:
        """Choose a row, and show its plan."""
        offset = event.get_content_offset(self)
        if offset is None or self.view is None or not 1 <= offset.y <= len(passes_of(self.view)) - self._top:
            return
        event.stop()
        self.cursor = self._top + offset.y - 1
        cast(AppHost, self.app).action_command("track-take")
