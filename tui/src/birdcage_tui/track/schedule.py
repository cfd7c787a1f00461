"""Autotrack: whether it is on, and its timeline: what it would do in the next hours, or does."""

from __future__ import annotations

import re
from dataclasses import replace

from birdcage.pursuit.now import Scheduled

from birdcage_tui.drawing.canvas import Cells
from birdcage_tui.drawing.cell_text import cell_len, cut, fit, pad, wrap
from birdcage_tui.shown.pass_words import clock_text, length_text
from birdcage_tui.shown.pursuit import pursuit_of
from birdcage_tui.shown.track_words import DEMO, plain_name
from birdcage_tui.shown.view import View
from birdcage_tui.widgets.pane import Pane

NAME = 24
"""Columns of a name at most."""
MAX = "max "
PRIORITY = re.compile(r" \(priority -?\d+\)")
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
        x = self.button(cells, 0, 0, "track-autotrack", view, "● autotrack on" if on else "○ autotrack off")
        now_s = view.utc.timestamp()
        rows = [] if desk is None else [one for one in desk.schedule if one.reach_end.timestamp() > now_s]
        instead = _instead(view, rows) if on else None
        if instead is not None:
            rows = [_waiting(one, *instead) for one in rows]
        kept = sum(one.kept for one in rows)
        words = f"{kept} of {len(rows)} passes" if on else f"dry run: {kept} of {len(rows)} passes"
        if instead is not None:
            words = "x goes on with it" if instead[1] is None else f"goes on at {clock_text(instead[1], seconds=False)}"
        cells.put(x, 0, words if rows and len(words) <= cells.width - x else "", "dim")
        if not rows:
            for y, line in enumerate(wrap(EMPTY, max(cells.width - 2, 10)), 1):
                cells.put(1, y, line, "dim")
            return
        y = 1
        if cells.height >= 4:
            self._line(cells, rows, now_s)
            y = 3
        shown = rows[: max(cells.height - y, 0)]
        room = min(max((cell_len(plain_name(row.name)) for row in shown), default=0), NAME)
        labelled = all(_spare(cells, row, room) >= 0 for row in shown)
        for below, row in enumerate(shown):
            self._row(cells, y + below, row, room, labelled=labelled)

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
    def _row(cells: Cells, y: int, row: Scheduled, room: int, *, labelled: bool) -> None:
        """Write a pass; why it is left out or cut short gets the room of what matters less."""
        ink = "text" if row.kept else "dim"
        name = fit(plain_name(row.name), room)
        when = f"{'●' if row.kept else '○'} {row.reach_start:%H:%M:%S}"
        long = f" {length_text(row.reach_s):>5}  "
        highest = f" {MAX if labelled else ''}{row.max_elevation_deg:2.0f}°  "
        whys = _whys(row.why)
        layouts = ((long, pad(name, room), highest), (long, pad(name, room), "  "), ("  ", name, "  "))
        spare = cells.width - 1 - len(when)
        which, why = next(
            ((one, why) for one in layouts for why in whys if sum(map(cell_len, (*one, why))) <= spare),
            (layouts[-1], whys[-1]),
        )
        x = cells.put(1, y, when + which[0], ink)
        x = cells.put(x, y, which[1] + which[2], "target" if row.kept else "dim")
        cells.put(x, y, cut(why, max(cells.width - x, 1)), "dim")


def _spare(cells: Cells, row: Scheduled, room: int) -> int:
    """Return how many columns a row leaves that names its maximum and tells all of why it is left out."""
    return cells.width - len(f"  00:00:00 00m00   {MAX}90°  ") - 1 - room - cell_len(_whys(row.why)[0])


def _whys(why: str) -> tuple[str, ...]:
    """Return why a pass is left out, the longest first: `joined after METOP-C (priority 2)`, `after METOP-C`."""
    plain = why.replace(DEMO, "").replace(" (priority 0)", "")  # every pass has that one by itself
    brief = PRIORITY.sub("", plain).partition(", ")[0].removeprefix("joined ")
    return tuple(dict.fromkeys((plain, PRIORITY.sub("", plain), brief)))


def _instead(view: View, rows: list[Scheduled]) -> tuple[str, float | None] | None:
    """Return what a person follows while autotrack is on, and until when (None: until it is left); None for nothing."""
    pursuit = pursuit_of(view.state)
    if pursuit is None or not pursuit.plan.legs:
        return None
    plan, day = pursuit.plan, pursuit.plan.day
    first_s, end_s = plan.legs[0].start_s, plan.legs[-1].end_s
    for row in rows:
        same = (row.name, row.norad_id) == (plan.aim.name, plan.aim.norad_id)
        if same and row.reach_start.timestamp() <= end_s and row.reach_end.timestamp() >= first_s:
            return None
    return plan.aim.name, end_s if day is None else day.reach_end_s(view.utc.timestamp())


def _waiting(row: Scheduled, name: str, until_s: float | None) -> Scheduled:
    """Return a pass as one that is not followed, if it begins before what a person follows has ended."""
    waits = row.kept and (until_s is None or row.reach_start.timestamp() < until_s)
    return replace(row, kept=False, why=f"following {plain_name(name)}") if waits else row
