"""What the commands of the NVS tab do: edit, write, save, back up, restore, compare; each asks before it writes."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from birdcage.base.errors import BirdcageError, OutOfRange
from birdcage.rotator.setting_values import danger_of, given_value
from textual.markup import escape

from birdcage_tui.shown.own_settings import SettingLine, differences
from birdcage_tui.system.ask_feature import DETAIL_WIDTH, LinesScreen, lines_screen
from birdcage_tui.system.own_settings_pane import OwnSettingsPane, known_rows
from birdcage_tui.widgets.choice_screen import ChoiceRow, ChoiceScreen
from birdcage_tui.widgets.dialogs import QuestionScreen
from birdcage_tui.widgets.fields_screen import FieldRow, FieldsScreen, Values

if TYPE_CHECKING:
    from birdcage_tui.feeds.own_settings_feed import OwnSettingsFeed
    from birdcage_tui.widgets.page import Page

JUST_S = 5.0
"""A table that is younger is as good as one that is read now."""
KEEPS = (
    "This saves all that the dish's memory holds in its flash. It counts from the next power cycle: switch the dish "
    "off and on."
)


class SettingsHands:
    """Does the commands of the tab on its page."""

    def __init__(self, page: Page) -> None:
        self._page = page

    @property
    def _feed(self) -> OwnSettingsFeed:
        return self._page.host.system.own_settings

    def do(self, name: str, pane: OwnSettingsPane) -> bool:
        """Carry out one on the list; return False for one that it does not know."""
        match name:
            case "up" | "down" as way:
                pane.move(1 if way == "down" else -1)
            case "page-up" | "page-down" as way:
                pane.move(pane.page_rows if way == "page-down" else -pane.page_rows)
            case "open":
                self._open(pane)
            case "edit":
                self._edit(pane)
            case "drop":
                self._drop(pane)
            case "modified":
                pane.only_modified, pane.at = not pane.only_modified, 0
                self._page.host.paint()
            case "write":
                self._fresh(self._write)
            case "save":
                self._fresh(self._save)
            case "undo":
                self._undo()
            case "backup":
                self._feed.back_up()
            case "restore":
                self._choose("Restore from", self._restore)
            case "compare":
                self._choose("Compare with", self._compare)
            case _:
                return False
        return True

    def _open(self, pane: OwnSettingsPane) -> None:
        if self._page.releases_first():
            return
        if (detail := pane.detail(self._page.host.view(), DETAIL_WIDTH)) is not None:
            self._page.app.push_screen(lines_screen(detail))

    def _edit(self, pane: OwnSettingsPane) -> None:
        view = self._page.host.view()
        line = pane.chosen(view)
        if line is None:
            self._page.host.say("No row is selected.")
            return
        self._page.app.push_screen(_field(line), lambda values: self._edited(line, values))

    def _edited(self, line: SettingLine, values: Values | None) -> None:
        if values is None:
            return
        value = given_value(line.row, line.known, values[0])
        same = value == line.row.current
        self._feed.stage(line.row.index, None if same else value)
        told = "The row has this value already." if same else "Not written yet. w shows the changes and writes them."
        self._page.host.say(told)

    def _drop(self, pane: OwnSettingsPane) -> None:
        line = pane.chosen(self._page.host.view())
        if line is None or line.staged is None:
            self._page.host.say("This row has no change to drop.")
        else:
            self._feed.stage(line.row.index, None)

    def _fresh(self, then: Callable[[bool], None]) -> None:
        """Do something by the table as it is now, read anew unless it was just read; tell whether that took a while.

        Somebody who has gone on to something else meanwhile is not disturbed.
        """
        self._feed.notice()
        view = self._page.host.view()
        read_at = view.own_settings.read_at
        if read_at is not None and view.now - read_at < JUST_S and not view.own_settings.busy:
            then(False)
            return

        def have() -> None:
            if self._page.is_free and self._page.part.id == "system-settings":
                then(True)
            else:
                self._page.dish.say("The dish's settings are read. Press the key again.")

        self._feed.read(have)

    def _write(self, late: bool) -> None:
        view = self._page.host.view()
        changes = differences(view.own_settings)
        if not changes:
            self._page.host.say("Nothing to write. e edits a row.")
            return
        known, lines, dangers = known_rows(view), list[str](), list[str]()
        for row, value in changes:
            unit = "" if (told := known.get(row.index)) is None or not told.unit else f" {told.unit}"
            lines.append(f"{row.index:>3}  {row.name}:  {row.current}  →  {value}{unit}")
        for row, _ in changes:
            if (danger := danger_of(known.get(row.index))) and danger not in dangers:
                dangers.append(danger)
        backup = "" if view.own_settings.backup else "A backup of the whole table is made first. "
        words = "\n".join(lines) + f"\n\n{backup}This changes the dish's memory. s saves it to flash."
        words += "".join(f"\n\n▲ {danger}" for danger in dangers)
        question = QuestionScreen("Write settings", words, f"write {_counted(len(changes), 'row')}", by_itself=late)
        self._page.app.push_screen(question, lambda yes: self._feed.write(changes) if yes else None)

    def _save(self, late: bool) -> None:
        now = self._page.host.view().own_settings
        rows = () if now.table is None else tuple(now.table.rows.values())
        unsaved = () if now.table is None else now.table.unsaved
        if not unsaved and all(row.saved is not None for row in rows):
            self._page.host.say("Nothing to save: flash holds what the memory holds.")
            return
        lines = [f"{row.index:>3}  {row.name}:  {row.saved}  →  {row.current}" for row in unsaved]
        staged = f"\n\n{_counted(len(now.staged), 'edit')} not written yet: not saved with it." if now.staged else ""
        words = "\n".join(lines) + ("\n\n" if lines else "") + KEEPS + staged
        question = QuestionScreen("Save to flash", words, "save", by_itself=late)
        self._page.app.push_screen(question, lambda yes: self._feed.save(now.table) if yes else None)

    def _undo(self) -> None:
        dropped = bool(self._feed.now.staged)
        if not self._feed.undo():
            self._page.host.say("Nothing was changed here that can be undone.")
        else:
            self._page.host.say("Edits dropped." if dropped else "The values from before. w writes them.")

    def _choose(self, title: str, then: Callable[[Path], None]) -> None:
        files: Sequence[Path] = self._feed.backups()
        if not files:
            self._page.host.say("No backups yet. B makes one.")
            return
        rows = [ChoiceRow(str(path), path.name, str(path.parent)) for path in files]

        def chosen(path: str | None) -> None:
            if path is not None:
                self._fresh(lambda _late: then(Path(path)))

        self._page.app.push_screen(ChoiceScreen(title, rows), chosen)

    def _restore(self, path: Path) -> None:
        self._tell(lambda: self._feed.stage_from(path))

    def _compare(self, path: Path) -> None:
        try:
            lines = self._feed.compare(path)
        except BirdcageError as wrong:
            self._page.host.say(str(wrong))
            return
        words = "\n".join(lines) or "The dish's flash and the file hold the same values."
        self._page.app.push_screen(LinesScreen(f"{path.name} and the dish", words))

    def _tell(self, deed: Callable[[], str]) -> None:
        try:
            self._page.host.say(deed())
        except BirdcageError as wrong:
            self._page.host.say(str(wrong))


def _field(line: SettingLine) -> FieldsScreen:
    row, known = line.row, line.known
    unit = "" if known is None else known.unit
    note = "" if known is None else known.note
    danger = f"▲ {danger_of(known)}" if danger_of(known) else ""
    default = "" if row.default is None else f" Default {row.default}."
    words = "\n".join(each for each in (f"Now {row.current} {unit}".rstrip() + f".{default}", note, danger) if each)
    limits = "" if known is None or known.range is None else f"{known.range} {unit}".strip()

    def wrong(values: Values) -> str:
        try:
            given_value(row, known, values[0])
        except OutOfRange as error:
            return str(error)
        return ""

    field = FieldRow(unit or "value", line.staged or "", limits or f"now {row.current}")
    enter = "Enter marks it to be written"
    return FieldsScreen(escape(f"Row {row.index}: {row.name}"), words, (field,), wrong, enter=enter)


def _counted(number: int, word: str) -> str:
    return f"{number} {word}{'' if number == 1 else 's'}"
