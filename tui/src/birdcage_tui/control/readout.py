"""Where the dish points, in big digits; what it does; what stops it."""

from __future__ import annotations

from birdcage_tui.drawing.canvas import Cells
from birdcage_tui.drawing.cell_text import cell_len, cut, pad, wrap
from birdcage_tui.drawing.digits import angle_text, put_big, width_of
from birdcage_tui.goto.goto_text import wind_of
from birdcage_tui.shown.pursuit import pursuit_of
from birdcage_tui.shown.state_words import age_text, motion_text, uncertainty_text
from birdcage_tui.shown.stop_words import stop_text
from birdcage_tui.shown.track_words import headline, live_words, plain_name
from birdcage_tui.shown.view import View
from birdcage_tui.widgets.pane import Pane


class ReadoutPane(Pane):
    """Side by side where there is room, else azimuth over elevation."""

    def __init__(self, *, id: str | None = None) -> None:  # noqa: A002
        super().__init__(id=id)
        self.border_title = "Pointing"

    def draw(self, cells: Cells, view: View) -> None:
        """Digits first; words as rows are left."""
        position = view.state.position
        ink = "dim" if view.stale else "big"
        az = " --.--" if position is None else angle_text(position.az_deg, 3) + "°"
        el = "--.--" if position is None else angle_text(position.el_deg, 2) + "°"
        whole = width_of("000.00°00.00°")
        beside = cells.width >= whole + 4
        large = cells.width >= width_of("000.00°00.00°", large=True) + 4 and cells.height >= 8
        if not beside:
            self._stacked(cells, view, az, el, ink)
            return
        rows = 5 if large else 3
        start_el = 1 + width_of("000.00°", large=large) + 3
        put_big(cells, 1, 0, az, ink, large=large)
        put_big(cells, start_el, 0, el, ink, large=large)
        y = rows
        if cells.height >= rows + 3:
            true = view.state.az_offset_deg or view.state.el_offset_deg or view.state.alignment.model is not None
            name = "azimuth true" if true else "azimuth"
            cells.put(1, y, name if position is None else f"{name}, {wind_of(position.az_deg)}", "dim")
            cells.put(start_el, y, "elevation", "dim")
            self._age(cells, start_el + 10, y, view)
            y += 1
        self._mark(cells, (1, start_el), view)
        self._words(cells, y, view)

    @staticmethod
    def _mark(cells: Cells, columns: tuple[int, int], view: View) -> None:
        """Set `~` before numbers that are modelled."""
        if view.modelled:
            for x in columns:
                cells.put(x - 1, 1, "~", "strong")

    def _stacked(self, cells: Cells, view: View, az: str, el: str, ink: str) -> None:
        right = 1 + width_of("000.00°")
        put_big(cells, 1, 0, az, ink)
        put_big(cells, 1 + width_of("0"), 3, el, ink)
        cells.put(right + 1, 0, "az", "dim")
        cells.put(right + 1, 3, "el", "dim")
        age_s, position = view.position_age_s, view.state.position
        if age_s is not None and view.stale:
            cells.put(right + 1, 1, age_text(age_s), "warn")
            cells.put(right + 1, 2, "old", "warn")
        elif position is not None:
            cells.put(right + 1, 1, wind_of(position.az_deg), "dim")
        if view.modelled:
            for y in (1, 4):
                cells.put(right + 1, y, "~mod", "text")
        self._words(cells, 6, view)

    @staticmethod
    def _age(cells: Cells, x: int, y: int, view: View) -> None:
        age_s = view.position_age_s
        position = view.state.position
        if view.modelled and position is not None:
            words, room = f"~ modelled {uncertainty_text(position)}".rstrip(), max(cells.width - x, 0)
            cells.put(x, y, words if len(words) <= room else "~ modelled"[:room], "text")
        elif age_s is not None and view.stale:
            cells.put(x, y, f"{age_text(age_s)} old"[: max(cells.width - x, 0)], "warn")

    @staticmethod
    def _words(cells: Cells, y: int, view: View) -> None:
        """Write what it does in one row, and what stops it in those that are left."""
        left = 0 if cells.width < 30 else 1
        ink = "dim" if view.waiting else "warn" if not view.link_up else "accent-strong" if view.moving else "text"
        pursuit = pursuit_of(view.state)
        words, room, error = motion_text(view), cells.width - left, live_words(view)
        if error and words.endswith(error) and cell_len(words) > room:  # the name gives way, never the number
            error = live_words(view, brief=True)
            name = headline(view, brief=True) or ""
            if cell_len(name) + 1 + len(error) > room and pursuit is not None:
                name = plain_name(pursuit.plan.aim.name)  # that it follows stands in row 1
            name = cut(name, room - len(error) - 1)
            words = f"{pad(name, room - len(error))}{error}"
        cells.put(left, y, cut(words, room), ink)
        rows = wrap(stop_text(view, 80), room)
        if y + 1 + len(rows) > cells.height:
            rows = wrap(stop_text(view), room)
        for row, words in enumerate(rows, y + 1):
            cells.put(left, row, words, "text" if view.moving else "dim")
