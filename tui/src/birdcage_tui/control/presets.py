"""The list of directions with names."""

from __future__ import annotations

from collections.abc import Sequence
from typing import cast

from birdcage.base.presets import Preset
from textual import events
from textual.geometry import Region

from birdcage_tui.commands import BY_NAME
from birdcage_tui.control.sky_directions import SkyDirection, sky_directions
from birdcage_tui.drawing.canvas import Cells
from birdcage_tui.drawing.cell_text import cell_len, cut, elide, pad, wrap
from birdcage_tui.feeds.app_host import AppHost
from birdcage_tui.shown.view import View
from birdcage_tui.widgets.filter_box import FilterBox, FilteredPane
from birdcage_tui.widgets.page import Page

KEYS = (("preset-go", "go"), ("preset-add", "add"), ("preset-edit", "edit"), ("preset-delete", "del"),
        ("preset-filter", "find"), ("preset-undo", "undo"))  # fmt: skip
LEAST_NAME, LEAST_NOTE = 4, 6
"""Columns that a name gets at least, and from which on a note is worth showing."""
SKY = "In the sky now: Enter opens go-to"
FOR_SKY, LEAST_SKY = 5, 4
"""Rows for the words and keys around it, and how many directions are worth a heading."""
EMPTY = "No presets. a saves this direction."


class PresetsPane(FilteredPane):
    """Rows to choose from, and their keys."""

    HELP = (
        "Up and down select, Enter turns the dish there, e edits, d deletes, u restores. "
        "At rest, Esc goes back to the rose."
    )

    def __init__(self, *, id: str | None = None) -> None:  # noqa: A002
        super().__init__(id=id)
        self.cursor = 0
        self._top = 0
        self._sky: list[SkyDirection] = []
        self._rows: list[tuple[Region, int]] = []

    @property
    def scope(self) -> str:
        """What its commands have in `where`."""
        return "presets"

    def do(self, command: str) -> bool:
        """Have the page do it: it asks, and it keeps the file."""
        return self.query_ancestor(Page).do(command)

    def filter_by(self, words: str) -> None:
        """Show what these words let through, from the top."""
        self.filter, self.cursor = words, 0
        self.redraw()

    def shown(self, view: View) -> list[Preset]:
        """Return those that the filter lets through."""
        wanted = self.filter.casefold()
        return [preset for preset in view.presets if wanted in f"{preset.name}\n{preset.note}".casefold()]

    def chosen(self) -> Preset | None:
        """Return the one under the cursor; None when there is none."""
        view = cast(AppHost, self.app).view()
        shown = self.shown(view)
        return shown[min(self.cursor, len(shown) - 1)] if shown and self.chosen_sky() is None else None

    def chosen_sky(self) -> SkyDirection | None:
        """Return the direction of the sky under the cursor; None when that is on a preset."""
        index = self.cursor - (0 if self.view is None else len(self.shown(self.view)))
        return self._sky[index] if 0 <= index < len(self._sky) else None

    def move(self, by: int) -> None:
        """Move the cursor."""
        if self.view is not None:
            self.cursor = min(max(self.cursor + by, 0), max(len(self.shown(self.view)) + len(self._sky) - 1, 0))
            self.show(self.view)

    def draw(self, cells: Cells, view: View) -> None:
        """Write the rows around the cursor, what is wrong with the file, and the keys."""
        shown = self.shown(view)
        self._sky = self._sky_for(cells, view, len(shown))
        self.cursor = min(self.cursor, max(len(shown) + len(self._sky) - 1, 0))
        self._rows = []
        problem = cast(AppHost, self.app).presets.problem
        if not view.presets:
            words = f"▲ {problem}" if problem else EMPTY
            rows = len(self._wrapped(cells, words, cells.height))
            if rows >= cells.height and not cast(AppHost, self.app).presets.deleted:
                self._words(cells, 0, words, "warn" if problem else "dim", cells.height)
                self.heat(0, 0, cells.width, "preset-add")  # the sentence names the key, which has no row here
                return
            bottom = self._keys(cells, view, cells.height if self._sky else rows + 1)
            self._words(cells, 0, words, "warn" if problem else "dim", bottom)
            self._draw_sky(cells, rows + 1, 0)
            return
        bottom, y = self._keys(cells, view, cells.height), 0
        if problem:
            y = self._words(cells, y, f"▲ {problem}", "warn", min(3, bottom - 1))
        if not shown:
            self._words(cells, 0, f'No preset matches "{self.filter}". / changes the filter.', "dim", bottom)
        room = max(bottom - y, 0)
        last = min(self.cursor, max(len(shown) - 1, 0))
        self._top = min(max(self._top, last - room + 1), last)
        for index in range(len(shown))[self._top : self._top + room]:
            self._row(cells, y, shown, index)
            y += 1
        self._draw_sky(cells, y + 1, len(shown))

    def _sky_for(self, cells: Cells, view: View, above: int) -> list[SkyDirection]:
        """Return those that a tall list has room for under the presets, and that the filter lets through."""
        room = cells.height - above - FOR_SKY
        if room < LEAST_SKY:
            return []
        wanted = self.filter.casefold()
        return [one for one in sky_directions(view) if wanted in one.name.casefold()][:room]

    def _draw_sky(self, cells: Cells, y: int, first: int) -> None:
        if self._sky:
            cells.put(1, y, SKY, "dim")
        width = max((cell_len(one.name) for one in self._sky), default=0)
        width = max(min(width, cells.width - 17), LEAST_NAME)
        for index, one in enumerate(self._sky, first):
            y += 1
            here = index == self.cursor
            mark = "▶" if here else " "
            line = f"{mark} {pad(elide(one.name, width), width)} {one.az_deg:6.2f}° {one.el_deg:5.2f}°"
            ink = "accent-row" if here and self.has_focus else "text"
            cells.put(0, y, pad(line, cells.width), ink)
            if ink == "text":
                cells.put(0, y, mark, "accent-strong")
            self._rows.append((Region(0, y, cells.width, 1), index))

    def _row(self, cells: Cells, y: int, shown: Sequence[Preset], index: int) -> None:
        preset, here = shown[index], index == self.cursor
        ink = "accent-row" if here and self.has_focus else "text"
        angles = f"{preset.az_deg:6.2f}° {preset.el_deg:5.2f}°"
        longest = max(cell_len(each.name) for each in shown)
        if cells.width - len(angles) - 4 < longest:  # the whole name counts for more than a tenth of a degree
            angles = f"{preset.az_deg:3.0f}° {preset.el_deg:2.0f}°"
        name_width = max(min(cells.width - len(angles) - 4, longest), LEAST_NAME)
        note_width = cells.width - name_width - len(angles) - 6
        note = cut(preset.note, note_width) if note_width >= LEAST_NOTE else ""
        line = f"{'▶' if here else ' '} {pad(elide(preset.name, name_width), name_width)} {angles}  {note}"
        cells.put(0, y, pad(line, cells.width), ink)
        if ink == "text":
            cells.put(0, y, line[:1], "accent-strong")
            cells.put(2 + name_width + 1 + len(angles) + 2, y, note, "dim")
        self._rows.append((Region(0, y, cells.width, 1), index))

    def _keys(self, cells: Cells, view: View, below: int) -> int:
        """Write the keys from the bottom, or as high as row `below`; return the row in which they begin."""
        rows: list[list[tuple[str, str]]] = [[]]
        x = 1
        deleted = cast(AppHost, self.app).presets.deleted
        for command, word in KEYS:
            if command == "preset-undo" and not deleted:
                continue
            if not view.presets and command not in ("preset-add", "preset-undo"):
                continue
            length = len(BY_NAME[command].shown) + 4 + len(word)
            if x + length > cells.width and rows[-1]:
                rows.append([])
                x = 1
            rows[-1].append((command, word))
            x += length
        top = max(min(cells.height - len(rows), below), 0)
        for y, row in enumerate(rows, top):
            x = 1
            for command, word in row:
                x = self.button(cells, x, y, command, view, word)
        return top

    @staticmethod
    def _wrapped(cells: Cells, words: str, rows: int) -> list[str]:
        return wrap(words, max(cells.width - 2, 10), most=rows)

    def _words(self, cells: Cells, y: int, words: str, ink: str, rows: int) -> int:
        if rows <= 0:
            return y
        for line in self._wrapped(cells, words, rows):
            cells.put(1, y, line, ink)
            y += 1
        return y

    def on_focus(self) -> None:
        """Show the cursor, once Textual has taken the focus in."""
        self.call_later(self.redraw)

    def on_blur(self) -> None:
        """Show that keys go elsewhere."""
        self.call_later(self.redraw)

    def on_click(self, event: events.Click) -> None:
        """Choose a row; a second click in a row that is chosen is no Enter: the key below is."""
        offset = event.get_content_offset(self)
        for region, index in self._rows:
            if offset is not None and region.contains_point(offset):
                event.stop()
                self.cursor = index
                self.redraw()


class PresetsBox(FilterBox):
    """The list under its filter. Esc goes back to the rose."""

    def __init__(self, *, id: str | None = None) -> None:  # noqa: A002
        hints = ("part of a name; Enter applies it", "name; Enter applies")
        super().__init__(PresetsPane(id="presets"), *hints, field_id="preset-filter", id=id)

    def leave_list(self) -> bool:
        """Go back to the rose."""
        self.query_ancestor(Page).do("tab-manual")  # from the tab of the presets
        self.screen.set_focus(self.screen.query_one("#rose"))
        return True
