"""A tab of features: rows under their headings, the values of the axes abreast, a cursor to look closer and to set."""

from __future__ import annotations

from dataclasses import dataclass
from typing import cast

from birdcage.rotator.feature import Feature, FeaturePage
from textual.geometry import Region

from birdcage_tui.drawing.canvas import Cells
from birdcage_tui.drawing.cell_text import elide, fit, pad, wrap
from birdcage_tui.feeds.app_host import AppHost
from birdcage_tui.shown.state_words import age_text
from birdcage_tui.shown.system_sheet import SheetRow, absent_groups, cell_text, sheet_readings, sheet_rows
from birdcage_tui.shown.view import View
from birdcage_tui.system.cursor_pane import CursorPane, Detail
from birdcage_tui.system.feature_detail import detail_lines

LEAST_LABEL, MOST_LABEL = 24, 44
CELL, AGE = 14, 6
"""Columns of the value of an axis, and of an age."""
ASKED = 18
"""Columns for what the machine is asked, where there is room."""


@dataclass(frozen=True, slots=True)
class SheetColumns:
    """Where the parts of a row begin, and how wide they are; 0 columns: they are left out."""

    label: int
    value: int
    cells: int
    age: int
    asked: int

    @classmethod
    def of(cls, width: int, cells: int) -> SheetColumns:
        """Share out the columns of a pane whose rows have so many values at most."""
        fixed = 2 + 1 + AGE + CELL * cells
        asked = ASKED if width - fixed - ASKED >= LEAST_LABEL else 0
        label = max(min(width - fixed - asked, MOST_LABEL), 10)
        value = 2 + label + 1
        return cls(label, value, cells, value + CELL * cells, asked)


class SheetPane(CursorPane):
    """Rows of features. Left and right choose the axis."""

    HELP = (
        "What the dish tells of itself. -- is what it has not told. Each value has its age, and what the dish was "
        "asked for it. r reads all of the tab now. e sets what can be set: it asks first. Nothing is read while the "
        "tab is hidden, or while the dish moves."
    )

    def __init__(self, page: FeaturePage, *, id: str | None = None) -> None:  # noqa: A002
        super().__init__("system-sheet", id=id)
        self.page_of_features = page
        self.axis = 0
        self._below = self._most_below = 0
        """How far it is scrolled beyond the last row, to what stands there, and how far it can be."""

    def move(self, by: int) -> None:
        """Move the cursor by rows; on the last one, what stands below comes into sight."""
        last = self.view is not None and self.at >= self.count(self.view) - 1
        if last and (by > 0 or self._below):
            self._below = min(max(self._below + by, 0), self._most_below)
            cast(AppHost, self.app).paint()
        else:
            super().move(by)

    def rows(self, view: View) -> tuple[SheetRow, ...]:
        """Return what stands here."""
        return sheet_rows(view.state.dish, self.page_of_features)

    def chosen(self, view: View) -> Feature | None:
        """Return the feature under the cursor; None where there is none."""
        rows = self.rows(view)
        if not rows:
            return None
        row = rows[min(self.at, len(rows) - 1)]
        return row.cells[min(self.axis, len(row.cells) - 1)]

    def count(self, view: View) -> int:
        """Return how many rows there are."""
        return len(self.rows(view))

    def move_across(self, by: int) -> None:
        """Move the cursor to the value of another axis."""
        if self.view is not None and (rows := self.rows(self.view)):
            self.axis = min(max(self.axis + by, 0), len(rows[min(self.at, len(rows) - 1)].cells) - 1)
            cast(AppHost, self.app).paint()

    def choose(self, row: int, value: int) -> None:
        """Put the cursor on a value."""
        self.at, self.axis = row, value

    def detail(self, view: View, width: int) -> Detail | None:
        """Return what there is to say of the value under the cursor."""
        feature = self.chosen(view)
        return None if feature is None else Detail(feature.label, detail_lines(feature, view, width))

    def draw(self, cells: Cells, view: View) -> None:
        """Write the rows around the cursor under their headings."""
        rows = self.rows(view)
        self.hits = []
        if not rows:
            dish = view.state.dish
            words = "The dish is not known yet." if dish is None else f"The {dish.name} reports nothing here."
            cells.put(1, 0, words, "dim")
            for y, below in enumerate(rest_lines(view, self.page_of_features, cells.width), 1):
                cells.put(0, y, below, "dim")
            return
        self.at = min(self.at, len(rows) - 1)
        columns = SheetColumns.of(cells.width, max(len(row.cells) for row in rows))
        lines = self._lines(rows, airy=len(rows) + 2 * len({row.group for row in rows}) <= cells.height)
        here = lines.index(self.at)
        head = 1 if here and isinstance(lines[here - 1], str) else 0  # the heading of the row stays in sight
        rest = rest_lines(view, self.page_of_features, cells.width)
        whole = len(lines) + len(rest)
        top = self.scroll(here, len(lines), cells.height, head=head)
        self._most_below = max(whole - cells.height - top, 0) if self.at == len(rows) - 1 else 0
        self._below = min(self._below, self._most_below)
        top += self._below
        for y, line in enumerate(lines[top : top + cells.height]):
            if isinstance(line, str):
                self._head(cells, y, line, rows, columns)
            else:
                self._row(cells, y, line, rows[line], view, columns)
        for y, words in enumerate(rest, len(lines) - top):
            cells.put(0, y, words, "dim")

    @staticmethod
    def _lines(rows: tuple[SheetRow, ...], *, airy: bool) -> list[str | int]:
        """Return headings, numbers of rows, and an empty heading between two groups where there is room."""
        lines: list[str | int] = []
        group = None
        for number, row in enumerate(rows):
            if row.group != group:
                if lines and airy:
                    lines.append("")
                group = row.group
                lines.append(group)
            lines.append(number)
        return lines

    @staticmethod
    def _head(cells: Cells, y: int, group: str, rows: tuple[SheetRow, ...], columns: SheetColumns) -> None:
        if not group:
            return
        x = cells.put(0, y, group, "strong")
        axes = next((row.axes for row in rows if row.group == group and row.axes), ())
        end = columns.value - 1 if axes else cells.width
        cells.put(x + 1, y, "─" * (end - x - 1), "faint")
        for number, axis in enumerate(axes):
            cells.put(columns.value + CELL * number, y, axis, "dim")
        if axes:
            at = columns.value + CELL * len(axes)
            cells.put(at, y, "─" * (cells.width - at), "faint")

    def _row(self, cells: Cells, y: int, number: int, row: SheetRow, view: View, columns: SheetColumns) -> None:
        here = number == self.at
        cells.put(0, y, "▶" if here else " ", "accent-strong")
        x = cells.put(2, y, fit(row.label, columns.label).rstrip(), "strong" if here else "text")
        shared = row.unit if x + 2 + len(row.unit) < columns.value else ""
        cells.put(x + 1, y, shared, "dim")
        sheet, oldest = view.sheet, None
        for index, feature in enumerate(row.cells):
            told = cell_text(feature, sheet_readings(view), view.now, with_unit=not shared)
            width = CELL - 1 if len(row.cells) > 1 else max(CELL * columns.cells - 1, 4)
            x = columns.value + CELL * index
            failed = feature.id in sheet.failed and told.age_s is None
            value = "▲ not told" if failed else "…" if told.age_s is None and feature.id in sheet.asked else told.value
            ink = "warn" if failed else "dim" if told.age_s is None or told.is_old else "text"
            if here and self.has_focus and index == min(self.axis, len(row.cells) - 1):
                cells.put(x - 1, y, f" {pad(elide(value, width), width)}", "accent-row")
            else:
                cells.put(x, y, elide(value, width), ink)
            self.hits.append((Region(0 if index == 0 else x, y, cells.width, 1), number, index))
            if told.age_s is not None:
                oldest = max(oldest or 0.0, told.age_s)
        if oldest is not None:
            cells.right(columns.age + AGE - 1, y, age_text(oldest), "dim")
        if columns.asked:
            cells.put(columns.age + AGE + 1, y, elide(row.cells[0].asked, columns.asked - 2), "dim")


def rest_lines(view: View, page: FeaturePage, width: int) -> list[str]:
    """Return what stands below the rows: what other kinds of dish tell and this one does not, what F5 is for."""
    dish = view.state.dish
    if dish is None:
        return []
    groups = ", ".join(absent_groups(dish.firmware, page))
    absent = [f"Not on the {dish.name}, as no command is known: {groups}"] if groups else []
    measured = measured_lines(view) if page is FeaturePage.MOTORS else []
    lines = list[str]()
    for part in (measured, absent, [dish.console_only.get(page.value, "")]):
        if any(part):
            lines += ["", *(line for each in part for line in wrap(each, max(width - 1, 10), indent="  "))]
    return lines


def measured_lines(view: View) -> list[str]:
    """Return what the last motor test measured of each axis, against what it should be."""
    from birdcage.diagnostics.motor_test_words import figure_words, not_measured

    if view.state.dish is not None and (why := not_measured(view.state.dish)):
        return [why.removesuffix(" Nothing was sent.")]
    lines = []
    for test in view.health.motor_tests:
        speed = figure_words(test.speed, "deg/s", test.speed_nominal, "speed not measured")
        acceleration = figure_words(test.acceleration, "deg/s²", test.acceleration_nominal, "acceleration not measured")
        stall = "no stall" if test.stalled_at_deg is None else f"stalled at {test.stalled_at_deg:.1f}°"
        age = age_text((view.utc - test.utc).total_seconds())
        lines.append(f"Measured {test.axis}: {speed}, {acceleration}, {stall}, {age} ago")
    return lines or ["Not measured yet: t tests speed and acceleration against nominal, and watches for stalls."]
