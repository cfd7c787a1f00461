"""Autotrack: whether it is on, and its timeline: what it would do in the next hours, or does."""

from __future__ import annotations

from birdcage.pursuit.now import Scheduled

from birdcage_tui.canvas import Cells
from birdcage_tui.cell_text import cut, fit, pad, wrap
from birdcage_tui.pane import Pane
from birdcage_tui.passes.words import clock_text, length_text
from birdcage_tui.view import View

SPANS_S = (3600.0, 2 * 3600.0, 3 * 3600.0, 6 * 3600.0, 12 * 3600.0, 24 * 3600.0)
EMPTY = "No favourite in reach soon. On page 7, * marks favourites; their passes show here."


class SchedulePane(Pane):
    """A switch; under it a row for each pass: when, who, whether it is kept, and why not; a line of time above."""

    def __init__(self, *, id: str | None = None) -> None:  # noqa: A002
        super().__init__(id=id)
        self.border_title = "Autotrack"

    def draw(self, cells: Cells, view: View) -> None:
        """Write them."""
        desk = view.track
        on = desk is not None and desk.autotrack
        x = self.button(cells, 0, 0, "track-autotrack", view, "● ON: switch off" if on else "○ off: switch on")
        now_s = view.utc.timestamp()
        rows = [] if desk is None else [one for one in desk.schedule if one.reach_end.timestamp() > now_s]
        kept = sum(one.kept for one in rows)
        words = f"{kept} of {len(rows)} passes" if on else f"dry run: {kept} of {len(rows)} passes"
        cells.put(x, 0, words[: max(cells.width - x, 0)] if rows else "", "dim")
        if not rows:
            for y, line in enumerate(wrap(EMPTY, max(cells.width - 2, 10)), 1):
                cells.put(1, y, line, "dim")
            return
        y = 1
        if cells.height >= 4:
            self._line(cells, rows, now_s)
            y = 3
        for row in rows[: cells.height - y]:
            self._row(cells, y, row)
            y += 1

    @staticmethod
    def _line(cells: Cells, rows: list[Scheduled], now_s: float) -> None:
        """Draw all passes over one line of time; kept ones thick."""
        width = cells.width - 2
        last = max(one.reach_end.timestamp() for one in rows[:12]) - now_s
        span = next((each for each in SPANS_S if each >= last), SPANS_S[-1])
        cells.put(1, 1, "╌" * width, "line")
        for one in sorted(rows, key=lambda each: each.kept):
            first = int((one.reach_start.timestamp() - now_s) / span * width)
            end = max(int((one.reach_end.timestamp() - now_s) / span * width), first + 1)
            for column in range(max(first, 0), min(end, width)):
                cells.put(1 + column, 1, "━" if one.kept else "─", "target-strong" if one.kept else "dim")
        cells.put(1, 1, "▼", "accent-strong")
        cells.put(1, 2, "now", "dim")
        for part in (1, 2, 3):
            words = clock_text(now_s + span * part / 4, seconds=False)
            cells.put(1 + width * part // 4 - 2, 2, words, "dim")

    @staticmethod
    def _row(cells: Cells, y: int, row: Scheduled) -> None:
        when = f"{row.reach_start:%H:%M:%S} {length_text((row.reach_end - row.reach_start).total_seconds()):>5}"
        x = cells.put(1, y, f"{'●' if row.kept else '○'} {when}  ", "text" if row.kept else "dim")
        room = 24 if cells.width >= 76 else min(max(cells.width - x - 10, 10), 16)
        name = fit(row.name.removeprefix("DEMO "), room)  # row 1 says that it is the demo
        ink = "target" if row.kept else "dim"
        x = cells.put(x, y, f"{pad(name, room)} {row.max_reach_elevation_deg:3.0f}°  ", ink)
        cells.put(x, y, cut(row.why, max(cells.width - x, 1)), "dim")
