"""The NVS tab: every row that the dish prints, what would be written, a filter, and what a row is for."""

from __future__ import annotations

from collections.abc import Mapping

from birdcage.rotator.own_settings import SettingKnown
from textual.geometry import Region

from birdcage_tui.drawing.canvas import Cells
from birdcage_tui.drawing.cell_text import elide, fit, wrap
from birdcage_tui.shown.own_settings import SettingLine, setting_lines
from birdcage_tui.shown.state_words import age_text
from birdcage_tui.shown.system_sheet import waits_for
from birdcage_tui.shown.view import View
from birdcage_tui.system.cursor_pane import CursorPane, Detail, Line
from birdcage_tui.widgets.filter_box import FilterBox

NUMBER, VALUE, LEAST_NAME, MOST_NAME = 5, 12, 20, 30
NOT_READ = "Not read yet. r reads them."
UNKNOWN_ROW = "No source says what this row does. It is kept and shown."
NO_SAVED = "This dish does not print what flash holds: only the next power-up tells."


def known_rows(view: View) -> Mapping[int, SettingKnown]:
    """Return what sources tell of the rows of this dish."""
    return {} if view.state.dish is None else view.state.dish.settings_known


class OwnSettingsPane(CursorPane):
    """Rows to choose from. Edits are marked, and nothing is written before `w`."""

    HELP = (
        "The dish's own settings. Current is in force in its memory, Saved is in its flash, Default is the factory's. "
        "e edits a row here, w writes all edits to the memory after you have seen old and new, s saves the memory to "
        "flash. It counts from the next power cycle. The first write makes a backup."
    )

    def __init__(self, *, id: str | None = None) -> None:  # noqa: A002
        super().__init__("system-settings", id=id)
        self.only_modified = False

    def lines(self, view: View) -> list[SettingLine]:
        """Return the rows that the filter lets through."""
        return setting_lines(view.own_settings, known_rows(view), self.filter, only_modified=self.only_modified)

    def count(self, view: View) -> int:
        """Return how many there are."""
        return len(self.lines(view))

    def chosen(self, view: View) -> SettingLine | None:
        """Return the row under the cursor; None where there is none."""
        lines = self.lines(view)
        return lines[min(self.at, len(lines) - 1)] if lines else None

    def draw(self, cells: Cells, view: View) -> None:
        """Write head, rows, and what has to be said below them."""
        now, lines = view.own_settings, self.lines(view)
        self._tell(view, len(lines))
        self.hits = []
        y = self._said(cells, view)
        if now.table is None or not lines:
            cells.put(1, 0, self._empty(view), "dim")
            return
        self.at = min(self.at, len(lines) - 1)
        name = max(min(cells.width - 2 - NUMBER - 3 * VALUE - 6, MOST_NAME), LEAST_NAME)
        cells.put(2, 0, f"{'row':>{NUMBER - 2}}  {'name':<{name}}", "dim")
        for index, word in enumerate(("current", "saved", "default")):
            cells.right(2 + NUMBER + name + VALUE * (index + 1), 0, word, "dim")
        room = max(y - 1, 1)
        top = self.scroll(self.at, len(lines), room)
        for number, line in enumerate(lines[top : top + room], top):
            self._row(cells, 1 + number - top, line, number == self.at, name)
            self.hits.append((Region(0, 1 + number - top, cells.width, 1), number, 0))

    def _row(self, cells: Cells, y: int, line: SettingLine, here: bool, name: int) -> None:
        row, lit = line.row, here and self.has_focus
        if lit:
            cells.put(0, y, " " * cells.width, "accent-row")
        ink, dim = ("accent-row", "accent-row") if lit else ("text", "dim")
        cells.put(0, y, "▶" if here else " ", ink if lit else "accent-strong")
        cells.put(2, y, f"{row.index:>{NUMBER - 2}}  {fit(row.name or '--', name)}", ink)
        x = 2 + NUMBER + name
        for index, value in enumerate((row.current, row.saved, row.default), 1):
            shown = elide("--" if value is None else value, VALUE - 1)
            cells.right(x + VALUE * index, y, shown, ink if index == 1 else dim)
        at = x + VALUE * 3 + 1
        for mark, words, tone in marks(line):
            if at + 3 + len(words) > cells.width and words:
                words = ""  # noqa: PLW2901 - the sign alone fits
            at = cells.put(at, y, f"{mark} {words}".rstrip() + " ", ink if lit else tone)

    def _said(self, cells: Cells, view: View) -> int:
        """Write at the bottom what is wrong, or left behind by an earlier write; return the row where it begins."""
        now, lines = view.own_settings, list[Line]()
        width = max(cells.width - 2, 10)
        unfinished = None if now.table is None else now.table.unfinished
        if (wrong := now.wrong or (now.unread if now.table is not None else "")) and not now.busy:
            lines += [("warn", line) for line in wrap(f"▲ {wrong}", width, most=4)]
        if (
            unfinished is not None and unfinished.backup != now.backup
        ):  # what this app has just written it shows as such
            lines += [("warn", line) for line in wrap(f"▲ {' '.join(unfinished.sentences)}", width, most=4)]
        top = cells.height - len(lines)
        for y, (ink, words) in enumerate(lines, top):
            cells.put(1, y, words, ink)
        return top

    def _tell(self, view: View, count: int) -> None:
        """Say in the frame how many rows there are, what is staged, how old the table is."""
        now, words = view.own_settings, list[str]()
        if now.table is not None:
            words.append(f"{count} of {len(now.table.rows)} rows")
            if now.staged:
                words.append(f"{len(now.staged)} to write")
            if now.table.unsaved:
                words.append(f"{len(now.table.unsaved)} unsaved")
            if now.read_at is not None:
                words.append(f"read {age_text(view.now - now.read_at)} ago")
        if now.busy:
            words.append(f"{now.busy} …")
        told = ", ".join(words)
        if told != (self.border_subtitle or ""):
            self.border_subtitle = told

    def _empty(self, view: View) -> str:
        dish, now = view.state.dish, view.own_settings
        if dish is None:
            return "The dish is not known yet."
        if not dish.has_own_settings:
            return f"The {dish.name} has no settings that can be read."
        if now.table is None:
            return "Reading the settings …" if now.busy else now.unread or waits_for(view.state) or NOT_READ
        if self.filter:
            return f'No row matches "{self.filter}". / changes the filter.'
        return "No row differs from the factory's value. o shows all."

    def detail(self, view: View, width: int) -> Detail | None:
        """Return what a source tells of the row, and what a wrong value does."""
        line = self.chosen(view)
        if line is None:
            return None
        row, known, lines = line.row, line.known, list[Line]()

        def say(ink: str, words: str) -> None:
            lines.extend((ink, each) for each in wrap(words, max(width, 10)) if words)

        unit = "" if known is None else f" {known.unit}".rstrip()
        if line.staged is not None:
            say("accent-strong", f"{row.current}  →  {line.staged}{unit}, not written yet")
        else:
            say("strong", f"{row.current}{unit}")
        if line.is_unsaved:
            say("warn", f"Not saved: the next power-up brings back {row.saved}.")
        if known is None:
            say("dim", UNKNOWN_ROW)
        else:
            say("warn", f"▲ {known.danger}" if known.danger else "")
            say("text", known.note)
            say("dim", f"Range {known.range}{unit}." if known.range is not None else "")
        if row.saved is None:
            say("dim", NO_SAVED)
        say("dim", f"`birdcage nvs get {row.index}` reads it in a shell.")
        return Detail(f"Row {row.index}: {row.name}".rstrip(": "), lines)


class SettingsBox(FilterBox):
    """The list under its filter."""

    def __init__(self) -> None:
        hints = ("part of a name, number or value; Enter applies it", "name or number; Enter applies")
        self.list = OwnSettingsPane(id="system-settings")
        super().__init__(self.list, *hints, field_id="settings-filter")


def marks(line: SettingLine) -> list[tuple[str, str, str]]:
    """Return sign, words and ink of what is special about a row."""
    found = []
    if line.staged is not None:
        found.append(("→", line.staged, "accent-strong"))
    if line.is_unsaved:
        found.append(("◍", "unsaved", "warn"))
    elif line.is_modified and line.staged is None:
        found.append(("*", "", "text"))
    if line.known is not None and line.known.danger:
        found.append(("▲", "", "warn"))
    return found
