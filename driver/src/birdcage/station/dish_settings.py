"""Serves what is read, changed and saved of the settings that the dish keeps itself."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace

from birdcage.base.errors import CommandRefused, ConfirmationNeeded, LeaseDenied, NoReply, StoreError
from birdcage.base.reason import Reason
from birdcage.rotator.feature_table import ends_reading
from birdcage.rotator.own_settings import (
    OwnSettings,
    SettingRow,
    SettingsTable,
    SettingsWritten,
    UnfinishedWrite,
    row_id,
)
from birdcage.rotator.setting_values import danger_of, given_value, same_value
from birdcage.station.applying import refuse_while_moving
from birdcage.station.events import SettingsSaved
from birdcage.station.menu_visit import MenuVisit
from birdcage.station.parts import Parts
from birdcage.station.raw import CONSOLE
from birdcage.station.requests import SaveSettings, WriteSettings
from birdcage.station.settings_left import NotedRow, NotedWrite, is_settled, left_by, named
from birdcage.station.settings_note import SettingsNote


class OwnSettingsHandler:
    """Errors are raised, and become the future's. `on_written` is called when the dish was told to change something."""

    def __init__(self, parts: Parts, on_written: Callable[[], None]) -> None:
        self._parts, self._store, self._antenna, self._reader = parts, parts.store, parts.antenna, parts.reader
        self._backup, self._on_written, self._visit = parts.backup, on_written, MenuVisit(parts)
        self._note = SettingsNote(parts.store, parts.settings)

    def read(self) -> SettingsTable:
        """Read all, and say what an earlier write has left behind."""
        own = self._own()
        if self._store.state.holder == CONSOLE:
            raise LeaseDenied("A person has the console of the dish, so nothing else is asked. Wait until it is free.")
        refuse_while_moving(self._store, self._antenna, "The dish's settings are not read")
        self._parts.free_wire()
        return self._judged(self._visit.talk(own.read))

    def write(self, request: WriteSettings) -> SettingsWritten:
        """Change rows in RAM: checked before, backed up, noted, and checked behind."""
        own = self._own()
        refuse_while_moving(self._store, self._antenna, "The dish's settings are not changed")
        self._visit.make_free_for(request.holder)
        before: SettingsTable = self._visit.talk(own.read)
        new = self._planned(request, own, before)
        if not new:
            return SettingsWritten(None, self._judged(before))
        backup = self._back_up(own, before)
        rows = tuple(
            NotedRow(row.index, row.name, row.current, row.saved, new[row.index])
            for row in (before.rows[index] for index in new)
        )
        self._keep_note(request.holder, backup, rows)
        if any(row_id(index) in self._store.state.readings for index in new):
            self._store.change(surveyed=False)  # what a survey tells is read anew when the dish is free, whatever comes
        table: SettingsTable = self._visit.talk(lambda: self._write(own, before, new))
        return SettingsWritten(backup, table)

    def save(self, request: SaveSettings) -> SettingsTable:
        """Write RAM to flash, and see that flash holds it."""
        own = self._own()
        refuse_while_moving(self._store, self._antenna, "The dish's settings are not saved")
        self._visit.make_free_for(request.holder)
        before: SettingsTable = self._visit.talk(own.read)
        if request.shown is not None and (others := _not_as_shown(request.shown, before)):
            raise ConfirmationNeeded(
                f"What a save would keep is no longer what you were shown: {others}. Look again. Nothing was saved."
            )
        if own.tells_saved and not before.unsaved:
            return self._judged(before)
        if not request.agreed:
            raise ConfirmationNeeded(
                f"{_saved_words(own, before)} It counts from the next power cycle. Nothing was sent."
            )
        backup = self._back_up(own, before)
        noted = self._keep_note(
            request.holder, backup,
            tuple(NotedRow(row.index, row.name, row.saved or "", row.saved, row.current) for row in before.unsaved),
        )  # fmt: skip
        self._note.keep(replace(noted, saving=True))
        self._store.change(surveyed=False)
        table: SettingsTable = self._visit.talk(lambda: self._save(own))
        names = tuple(row.name or str(row.index) for row in before.unsaved)
        self._store.tell(SettingsSaved(*self._store.stamp(), names))
        self._note.drop()
        self._backup.forget()
        return table

    def _write(self, own: OwnSettings, before: SettingsTable, new: Mapping[int, str]) -> SettingsTable:
        self._on_written()
        for index, value in new.items():
            try:
                own.write(index, value)
            except NoReply as error:
                if ends_reading(error):
                    raise
                raise NoReply(_lost_words([before.rows[index]], new), reason=Reason.GARBAGE) from error
        table = own.read()
        if lost := [each for each in before.rows.values() if each.index not in table.rows]:
            raise NoReply(_lost_words(lost, new), reason=Reason.GARBAGE)
        strays = [row.index for row in table.rows.values() if _has_strayed(row, before, new)]
        if strays:
            raise CommandRefused(
                f"{named(strays)} changed too, unasked. Nothing was saved: a power cycle takes it back.",
                reason=Reason.BAD_PARAMETER,
            )
        return self._judged(table)

    def _save(self, own: OwnSettings) -> SettingsTable:
        self._on_written()
        own.save()
        table = own.read()
        if own.tells_saved and table.unsaved:
            raise CommandRefused(
                f"The dish says that it saved, and flash holds another value: {_changes(table)}. Save once more.",
                reason=Reason.BAD_PARAMETER,
            )
        return table

    def _own(self) -> OwnSettings:
        own: OwnSettings | None = self._antenna.rotator.own_settings
        if own is None:
            raise CommandRefused(
                f"The {self._antenna.rotator.facts.name} has no known settings of its own. Nothing was sent.",
                reason=Reason.UNSUPPORTED,
            )
        return own

    @staticmethod
    def _planned(request: WriteSettings, own: OwnSettings, table: SettingsTable) -> dict[int, str]:
        """Return the rows that are to change, with their values as printed."""
        if missing := [index for index in request.changes if index not in table.rows]:
            raise CommandRefused(
                f"The dish shows no row {missing[0]} that could be read. Nothing was written.", reason=Reason.NO_ROW
            )
        wanted = {
            index: given_value(table.rows[index], own.known.get(index), text) for index, text in request.changes.items()
        }
        new = {index: text for index, text in wanted.items() if not same_value(table.rows[index].current, text)}
        dangers = [f"Row {index}: {danger}" for index in new if (danger := danger_of(own.known.get(index)))]
        if dangers and not request.agreed:
            raise ConfirmationNeeded(f"{' '.join(dangers)} Nothing was written.")
        return new

    def _back_up(self, own: OwnSettings, table: SettingsTable) -> str:
        """Back the table up before the first write of this run; return where it is. StoreError past a damaged note."""
        self._note.read(self._antenna.rotator.facts.firmware)
        if (kept := self._backup.kept) is not None and kept.exists():
            return str(kept)
        if self._visit.talk(own.read).printed != table.printed:  # what noise has changed is no backup
            raise NoReply("Two readings of the settings differ, so there is no backup. Nothing was written. Try again.")
        return str(self._backup.keep(table.printed))

    def _keep_note(self, by: str, backup: str, rows: tuple[NotedRow, ...]) -> NotedWrite:
        firmware = self._antenna.rotator.facts.firmware
        noted = self._note.read(firmware)
        if noted is None:
            noted = NotedWrite(firmware, self._store.clock.utc(), by, backup, ())
        noted = noted.with_rows(rows)
        self._note.keep(noted)
        return noted

    def _judged(self, table: SettingsTable) -> SettingsTable:
        """Return a table that was just read, with what an earlier write has left; drop a note that is settled."""
        try:
            noted = self._note.read(self._antenna.rotator.facts.firmware)
        except StoreError as error:  # what the dish holds is told all the same
            return replace(table, unfinished=UnfinishedWrite(self._note.written(), "", None, (), (str(error),)))
        if noted is None:
            return table
        left = left_by(noted, table)
        if is_settled(left, saving=noted.saving):
            self._note.drop()
        return replace(table, unfinished=left)


def _has_strayed(row: SettingRow, before: SettingsTable, new: Mapping[int, str]) -> bool:
    was = before.rows.get(row.index)
    wanted = new.get(row.index, row.current if was is None else was.current)
    return not same_value(row.current, wanted)


def _not_as_shown(shown: Mapping[int, str], table: SettingsTable) -> str:
    """Return the rows whose value is not the one that was shown, in words; empty where all are as shown."""
    now, said = table.to_save, []
    for index in sorted({*shown, *now}):
        was, value = shown.get(index), now.get(index)
        if was is None:
            said.append(f"row {index} is {value} and was not shown")
        elif value is None:
            said.append(f"row {index} was {was} and has nothing to save now")
        elif not same_value(value, was):
            said.append(f"row {index} was {was} and is {value} now")
    return ", ".join(said)


def _lost_words(lost: list[SettingRow], new: Mapping[int, str]) -> str:
    was = " ".join(
        f"Row {row.index} was {row.current} and was to be {new[row.index]}." for row in lost if row.index in new
    )
    return (
        f"{named([row.index for row in lost])} not readable after the write. {was} Nothing was saved: a power cycle "
        "takes the write back."
    )


def _changes(table: SettingsTable) -> str:
    return ", ".join(f"row {row.index} {row.saved} -> {row.current}" for row in table.unsaved)


def _saved_words(own: OwnSettings, table: SettingsTable) -> str:
    if not own.tells_saved:
        return "Saving writes all that RAM holds to flash. This dish does not tell what flash holds now."
    return f"Saving writes all that RAM holds to flash: {_changes(table)}."
