"""The pocket view's numbers and words: where it points, what it does, what is wrong, how much cable is left."""

from __future__ import annotations

import re

from textual.geometry import Region

from birdcage_tui.drawing.canvas import Cells
from birdcage_tui.drawing.cell_text import fit, pad, shorten, wrap
from birdcage_tui.drawing.digits import angle_text, put_big, width_of
from birdcage_tui.panes.pointing import cable_gauge, motion_ink
from birdcage_tui.shown.allowed import can_home, can_release, can_sync
from birdcage_tui.shown.pursuit import pursuit_of
from birdcage_tui.shown.resume_words import resume_words
from birdcage_tui.shown.state_words import age_text, bad_day, calm, motion_text
from birdcage_tui.shown.stop_words import searching, stop_text
from birdcage_tui.shown.track_words import headline, live_words, los_words, next_words
from birdcage_tui.shown.view import View
from birdcage_tui.widgets.pane import Pane
from birdcage_tui.widgets.skew import has_skew, skew_row, skew_text

KEY = re.compile(r"\b(Enter|U) ")
"""A key keeps the word for what it does beside it."""
LABEL = 3
"""Columns of `AZ` or `EL` before its digits."""
LARGE_WIDTH = width_of("000.00°00.00°", large=True) + 2 * LABEL + 3
SMALL_WIDTH = width_of("000.00°00.00°") + 2 * LABEL + 1


def wrong_rows(view: View, width: int) -> tuple[str, list[str]]:
    """Return ink and rows of what is wrong; no rows when nothing is."""
    found = bad_day(view)
    if found is None:
        return "text", []
    ink, words = found
    rows = wrap(KEY.sub("\\1\N{NO-BREAK SPACE}", words), max(width - 2, 8))
    return ink, [row.replace("\N{NO-BREAK SPACE}", " ") for row in rows]


def digit_rows(width: int, height: int, words: int) -> int:
    """Return how many rows the angles take: 5 or 3 as big digits, 1 as text, 0 when the words need every row."""
    spare = height - max(words, 1)
    if width >= LARGE_WIDTH and spare >= 9:  # leaves two for the signal
        return 5
    if width >= SMALL_WIDTH and spare >= 3:
        return 3
    return 1 if spare >= 1 else 0


def _mending(view: View) -> str | None:
    """Return the command that the words of what is wrong name; None where they name none."""
    if can_release(view) is None:
        return "release"
    if view.state.awaits_sync:
        return "sync" if can_sync(view) is None else None
    if view.state.homed is False:
        return "home" if view.link_up and can_home(view) is None else None
    if searching(view):
        return "search"
    return "resume" if resume_words(view) else None


def whole(words: str, width: int) -> str:
    """Return as many whole sentences as fit; of a first one that does not, what it tells first."""
    while len(words) > width and ". " in words:
        words = words[: words.rindex(". ") + 1]
    return shorten(words, width)


class PocketReading(Pane):
    """Angles as large as there is room for; under them what is wrong, or what it does and what STOP can do."""

    cramped = False
    """Whether the terminal is too small for buttons."""
    digits = 3
    """Rows of the angles: 5, 3, 1 or 0."""

    def draw(self, cells: Cells, view: View) -> None:
        """Fill from the top. What is wrong is never cut short while there are rows for it."""
        ink, wrong = wrong_rows(view, cells.width)
        y = self._angles(cells, view, self.digits)
        if wrong:
            y = self._wrong(cells, view, y, ink, wrong)
        else:
            age_s = view.position_age_s
            old = f"{age_text(age_s)} old" if view.stale and age_s is not None else ""
            words = motion_text(view)
            error = live_words(view, brief=True)
            if headline(view) is not None and view.link_up:
                words = fit(headline(view, brief=True) or "", cells.width - 4 - len(error) - len(old))
            if error and not old:
                cells.right(cells.width - 1, y, error, "accent-strong")
            cells.put(1, y, words[: max(cells.width - 3 - len(old), 0)], motion_ink(view))
            cells.right(cells.width - 1, y, old, "warn")
            y += 1
        cable_y = cells.height - 1
        if self.cramped and not wrong and y < cells.height:
            cells.put(1, cable_y, f"Keys need 40x{12 + len(view.others)}. Space stops."[: cells.width - 2], "warn")
        elif y < cells.height:
            cable_gauge(cells, cable_y, view)
        if not wrong and y < cable_y:
            said = "" if view.moving else calm(view, brief=True)
            pursuit = pursuit_of(view.state)
            if pursuit is not None and (coming := next_words(view, cells.width - 2)):
                both = f"{coming}   {los_words(pursuit.plan)}".rstrip()
                said = both if len(both) <= cells.width - 2 else coming
            cells.put(
                1, y, whole(said or stop_text(view, cells.width - 2), cells.width - 2), "text" if view.moving else "dim"
            )
            y += 1
        if has_skew(view) and y < cable_y and self.digits > 1:
            skew_row(cells, 1, cable_y - 1, view)

    def _wrong(self, cells: Cells, view: View, y: int, ink: str, rows: list[str]) -> int:
        """Write what is wrong over the whole width; a press does what it asks for."""
        room = cells.height - y
        if len(rows) > room > 0:
            rows = [*rows[: room - 1], rows[room - 1][: max(cells.width - 4, 0)] + " …"]
        command = _mending(view)
        if command is not None and rows:
            self.hot.append((Region(0, y, cells.width, len(rows)), command))
        for row in rows:
            cells.put(0, y, pad(f" {row}", cells.width), ink)
            y += 1
        return y

    @staticmethod
    def _angles(cells: Cells, view: View, rows: int) -> int:
        position = view.state.position
        ink = "dim" if view.stale else "big"
        if rows == 0:
            return 0
        if rows == 1:
            az = "---.--" if position is None else f"{position.az_deg:6.2f}"
            el = "--.--" if position is None else f"{position.el_deg:5.2f}"
            mark = "~" if view.modelled else " "
            skew = f"  SK{skew_text(view)}" if has_skew(view) else ""
            cells.put(1, 0, f"AZ{mark}{az}°  EL{mark}{el}°{skew}"[: cells.width - 1], ink)
            return 1
        large = rows == 5
        az = " --.-- " if position is None else angle_text(position.az_deg, 3) + "°"
        el = "--.--" if position is None else angle_text(position.el_deg, 2) + "°"
        wide = width_of("000.00°", large=large)
        spare = cells.width - 2 - (LARGE_WIDTH if large else SMALL_WIDTH)
        start_el = 1 + LABEL + wide + 1 + max(0, min(6, spare))
        put_big(cells, 1 + LABEL, 0, az.rstrip(), ink, large=large)
        put_big(cells, start_el + LABEL, 0, el, ink, large=large)
        mark = "~" if view.modelled else ""
        cells.put(1, rows // 2, f"AZ{mark}", "dim")
        cells.put(start_el, rows // 2, f"EL{mark}", "dim")
        return rows
