"""Reads and writes the dish's own settings for the System page: edits wait in the app until they are written."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import Future
from dataclasses import replace
from functools import partial
from pathlib import Path

from birdcage.base.clock import Clock
from birdcage.base.errors import BirdcageError, ConfigError, StoreError
from birdcage.base.paths import write_aside_and_rename
from birdcage.rotator.facts import Facts
from birdcage.rotator.own_settings import SettingRow, SettingsTable, SettingsWritten
from birdcage.rotator.settings_compare import differences, restoring
from birdcage.rotator.settings_file import SettingsDump, backup_path, read_settings_file, settings_text
from birdcage.station.access import FaceStation
from birdcage.station.requests import ReadSettings, Request, SaveSettings, WriteSettings

from birdcage_tui.feeds.dish_seen import DishSeen
from birdcage_tui.feeds.sheet_feed import AGAIN_S, LOOKED_S
from birdcage_tui.shown.own_settings import OwnSettingsNow
from birdcage_tui.shown.system_sheet import OLD_S, waits_for
from birdcage_tui.shown.view import YOU

MOST_AT_ONCE = 25
"""Rows of one request: written well within the time that an answer of another program may take."""
MOST_BACKUPS = 40
"""Files to choose from, the newest."""


class OwnSettingsFeed:
    """For the app's thread; one request at a time."""

    def __init__(
        self, station: FaceStation, clock: Clock, soon: Callable[[Callable[[], None]], object],
        changed: Callable[[], object], say: Callable[[str], object], folder: Path | None,
    ) -> None:  # fmt: skip
        """`say` hears what was done; backups are looked for in `folder`, None: there are none."""
        self._station, self._clock, self._soon, self._changed = station, clock, soon, changed
        self._say, self._folder, self._seen = say, folder, DishSeen()
        self.now = OwnSettingsNow()
        self._looked_at = -LOOKED_S
        self._not_before = -math.inf
        self._undoes = False
        """Whether what is staged brings back what a write replaced: then it is no step to undo itself."""
        self._due = True
        """Whether the table is to be read as soon as the dish may be asked."""

    def notice(self) -> None:
        """Drop what was read of a dish, and staged for it, once it is another or has started anew."""
        if self._seen.is_another(self._station.state):
            self.now, self._undoes, self._due = OwnSettingsNow(), False, True

    def look(self) -> None:
        """Somebody looks at the table: read it on arrival, if it is old, and as soon as the dish rests."""
        state, now = self._station.state, self._clock.monotonic()
        self.notice()
        arrived, self._looked_at = now - self._looked_at > LOOKED_S, now
        if self.now.read_at is None or (arrived and now - self.now.read_at > OLD_S):
            self._due = True
        has = state.dish is not None and state.dish.has_own_settings
        if has and self._due and not self.now.busy and now >= self._not_before and not waits_for(state):
            self.read()

    def read(self, then: Callable[[], object] | None = None) -> None:
        """Read the whole table now, and then do something that goes by it."""

        def have(table: object) -> None:
            self._have_table(table)
            if then is not None:
                then()

        self._ask(ReadSettings(), "reading", have)

    def stage(self, index: int, value: str | None) -> None:
        """Have a row written with the next write; None: not any more."""
        staged = {row: text for row, text in self.now.staged.items() if row != index}
        self._undoes = False
        self._show(staged=staged if value is None else {**staged, index: value}, wrong="")

    def stage_all(self, values: Mapping[int, str]) -> None:
        """Have these rows written with the next write, and no others."""
        self._undoes = False
        self._show(staged=dict(values), wrong="")

    def write(self, changes: Sequence[tuple[SettingRow, str]]) -> None:
        """Write these values into the dish's memory, and nothing else; a person was shown both, and agreed.

        Nothing is written where a row is not as it was shown.
        """
        self.notice()
        rows = {} if self.now.table is None else self.now.table.rows
        if not changes or any(rows.get(row.index) != row for row, _ in changes):
            self._say("The dish's settings have changed meanwhile. Nothing was written. Press w again.")
            return
        values, undoes = {row.index: value for row, value in changes}, self._undoes
        self._write_next(values, {row.index: row.current for row, _ in changes}, {}, undoes=undoes)

    def _write_next(
        self, values: Mapping[int, str], before: Mapping[int, str], replaced: Mapping[int, str], *, undoes: bool
    ) -> None:  # fmt: skip
        """Write some of them, and then the rest; `before` is what they were, `replaced` what of it is written over."""
        part = dict(list(values.items())[:MOST_AT_ONCE])
        rest = {index: value for index, value in values.items() if index not in part}

        def have(written: object) -> None:
            assert isinstance(written, SettingsWritten), "the station's promise"
            left = {index: value for index, value in self.now.staged.items() if part.get(index) != value}
            done, steps = dict(replaced), self.now.undo
            if written.backup is not None:
                steps = steps[:-1] if replaced and not undoes else steps
                done |= {index: before[index] for index in part}
                steps = steps if undoes else (*steps, done)
            if undoes and not rest:
                steps = steps[:-1]
            self._show(table=written.table, read_at=self._clock.monotonic(), staged=left, undo=steps,
                       backup=written.backup or self.now.backup)  # fmt: skip
            if rest:
                self._write_next(rest, before, done, undoes=undoes)
            elif done:
                self._say(f"Written to the dish's memory. s saves it to flash. Backup: {self.now.backup}")
            else:
                self._say("The dish has these values already. Nothing was written.")

        self._ask(WriteSettings(part, YOU, agreed=True), "writing", have)

    def save(self, table: SettingsTable | None) -> None:
        """Save all that the dish's memory holds to flash; a person was shown that, and agreed.

        Nothing is saved where another table than the one that was shown is the last.
        """
        self.notice()
        if table is None or self.now.table is not table:
            self._say("The dish's settings have changed meanwhile. Nothing was saved. Press s again.")
            return

        def have(saved: object) -> None:
            self._have_table(saved)
            self._say("Saved to flash. It counts from the next power cycle: switch the dish off and on.")

        self._ask(SaveSettings(YOU, agreed=True, shown=table.to_save), "saving", have)

    def undo(self) -> bool:
        """Drop what is staged; with nothing staged, stage the values from before the last write. False for neither."""
        if self.now.staged:
            self.stage_all({})
            return True
        if not self.now.undo:
            return False
        self._show(staged=dict(self.now.undo[-1]), wrong="")
        self._undoes = True
        return True

    def _have_table(self, table: object) -> None:
        assert isinstance(table, SettingsTable), "the station's promise"
        self._due = False
        self._show(table=table, read_at=self._clock.monotonic(), unread="")

    def back_up(self) -> None:
        """Read the table anew, and write it to a file."""
        self.read(self._keep)

    def _keep(self) -> None:
        try:
            facts, table = self._known()
            if self._folder is None:
                raise ConfigError("There is no folder for backups.")
            utc = self._clock.utc()
            path = backup_path(self._folder, facts.settings_name, facts.firmware, utc)
            text = settings_text(facts.name, facts.firmware, utc, table.printed, demo=self._station.state.demo)
            write_aside_and_rename(path, text.encode())
        except BirdcageError as error:
            self._say(str(error))
        except OSError as error:
            self._say(f"The backup can't be written: {error.strerror}.")
        else:
            self._say(f"Backup: {path}")

    def backups(self) -> list[Path]:
        """Return the files of backups, the newest first."""
        if self._folder is None or not self._folder.is_dir():
            return []
        return sorted(self._folder.glob("*.txt"), key=lambda path: path.name.rpartition("-")[2], reverse=True)[
            :MOST_BACKUPS
        ]

    def stage_from(self, path: Path) -> str:
        """Stage what differs from a file; return a sentence. BirdcageError where it can't be restored here."""
        facts, table = self._known()
        dump, rows = self._dump(path, facts)
        demo = self._station.state.demo
        new = restoring(dump, rows, table, facts.firmware, facts.settings_known, path.name, demo=demo)
        self.stage_all(new)
        if new:
            differ = "1 row differs" if len(new) == 1 else f"{len(new)} rows differ"
            return f"{differ} from {path.name}. w shows and writes them, then s saves."
        if table.unsaved:
            return f"The dish's memory holds {path.name}, its flash not yet. s saves it."
        return f"The dish holds what {path.name} holds."

    def compare(self, path: Path) -> list[str]:
        """Return a line for each row that differs from a file. BirdcageError where it can't be read."""
        facts, table = self._known()
        dump, rows = self._dump(path, facts)
        if dump.firmware and dump.firmware != facts.firmware:
            raise StoreError(f"{path.name} is of firmware {dump.firmware}, and this dish speaks {facts.firmware}.")
        return [
            f"{each.index:>3}  {each.name}:  file {each.first or '--'},  dish {each.second or '--'}"
            for each in differences(rows, table.rows)
        ]

    def _known(self) -> tuple[Facts, SettingsTable]:
        facts, table = self._station.state.dish, self.now.table
        if facts is None or table is None:
            raise StoreError("The dish's settings are not read yet. r reads them.")
        return facts, table

    @staticmethod
    def _dump(path: Path, facts: Facts) -> tuple[SettingsDump, Mapping[int, SettingRow]]:
        from birdcage.rotator import machines

        dump, own = read_settings_file(path), machines.make(facts.firmware).own_settings
        if own is None:
            raise StoreError(f"The {facts.name} has no settings that can be read.")
        return dump, own.parse(dump.printed)

    def _ask(self, request: Request, busy: str, have: Callable[[object], None]) -> None:
        if self.now.busy:
            self._say("The dish is still busy with its settings. Try again in a moment.")
            return
        self._show(busy=busy, **({} if isinstance(request, ReadSettings) else {"wrong": ""}))
        future, epoch = self._station.submit(request), self._seen.epoch
        future.add_done_callback(lambda done: self._soon(partial(self._done, request, done, have, epoch)))

    def _done(
        self, request: Request, done: Future[object], have: Callable[[object], None], epoch: int
    ) -> None:  # fmt: skip
        if epoch != self._seen.epoch:
            return
        self._show(busy="")
        error = None if done.cancelled() else done.exception()
        if error is None and not done.cancelled():
            have(done.result())
        elif isinstance(request, ReadSettings):
            self._not_before, self._due = self._clock.monotonic() + AGAIN_S, True
            self._show(unread=str(error or ""))
        else:  # what that has left is read as soon as it can be
            self._due = True
            self._show(wrong=str(error or ""), read_at=None)
        self._changed()

    def _show(self, **changes: object) -> None:
        self.now = replace(self.now, **changes)  # type: ignore[arg-type]
        self._changed()
