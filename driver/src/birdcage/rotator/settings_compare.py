"""Two tables of a machine's settings beside each other, and what it takes to make one of the other."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, replace

from birdcage.base.errors import CommandRefused
from birdcage.base.reason import Reason
from birdcage.rotator.own_settings import SettingKnown, SettingRow, SettingsTable
from birdcage.rotator.setting_values import given_value, same_value
from birdcage.rotator.settings_file import SettingsDump

_INDEX = re.compile(r"\s*(\d{1,6})(?!\w)", re.ASCII)
_NOTHING_SENT = "Nothing was sent."


@dataclass(frozen=True, slots=True)
class SettingDifference:
    """A row that differs; None on the side that does not have it."""

    index: int
    name: str
    first: str | None
    second: str | None


def value_words(row: SettingRow | None) -> str | None:
    """Return what a row holds, for a person: both values where RAM and flash differ."""
    if row is None or not row.is_unsaved:
        return None if row is None else row.current
    return f"{row.current} in RAM, {row.saved} saved"


def differences(first: Mapping[int, SettingRow], second: Mapping[int, SettingRow]) -> tuple[SettingDifference, ...]:
    """Return the rows whose values differ, in order."""
    found = []
    for index in sorted({*first, *second}):
        one, other = first.get(index), second.get(index)
        said = value_words(one), value_words(other)
        if said[0] != said[1]:
            named = one if one is not None else other
            assert named is not None
            found.append(SettingDifference(index, named.name, *said))
    return tuple(found)


def lines_of_no_row(printed: tuple[str, ...], rows: Mapping[int, SettingRow]) -> tuple[str, ...]:
    """Return the lines that begin as a row does and could not be read: they are kept as text, and never written."""
    numbered = ((int(match[1]), line) for line in printed if (match := _INDEX.match(line)))
    return tuple(line for index, line in numbered if index not in rows)


def restoring(
    dump: SettingsDump,
    rows: Mapping[int, SettingRow],
    table: SettingsTable,
    firmware: str,
    known: Mapping[int, SettingKnown],
    name: str,
    *,
    demo: bool,
) -> dict[int, str]:
    """Return what has to be written into RAM so that a save makes flash what a dump has as saved.

    `rows` are those of the dump, `name` is how its file is called, `demo` is whether the dish is simulated. Empty where
    RAM holds it already. CommandRefused, and nothing sent, for a dump that is another machine's, or of a simulated one
    for a real one, or has rows twice, or rows that the machine lacks; and where a save would also keep a change that
    the dump says nothing of. OutOfRange for a value that would have to be written and does not fit.
    """
    if dump.demo and not demo:
        raise _refused(f"{name} is of a simulated dish.")
    if dump.firmware and dump.firmware != firmware:
        raise _refused(f"{name} is of firmware {dump.firmware}, and this dish speaks {firmware}.")
    often = Counter(int(match[1]) for line in dump.printed if (match := _INDEX.match(line)))
    if twice := [index for index, count in often.items() if count > 1]:
        raise _refused(f"{name} has row {twice[0]} {often[twice[0]]} times.")
    if not rows:
        raise _refused(f"{name} holds no setting of such a dish.")
    new = {}
    for index, row in sorted(rows.items()):
        now = table.rows.get(index)
        if now is None:
            raise _refused(f"{name} has row {index} ({row.name}), which this dish does not show.")
        if now.name != row.name:
            raise _refused(f"Row {index} is called {now.name!r} on this dish and {row.name!r} in {name}.")
        if same_value(now.current, saved_of(row)):
            continue
        value = given_value(now, known.get(index), saved_of(row))
        if not same_value(now.current, value):
            new[index] = value
    if others := [row for row in table.unsaved if row.index not in rows]:
        raise _refused(
            f"Row {others[0].index} was changed in RAM ({others[0].saved} to {others[0].current}), a save would keep "
            f"that, and {name} has no such row. Save first, or switch the dish off and on."
        )
    return new


def saved_after(table: SettingsTable, new: Mapping[int, str]) -> dict[int, str]:
    """Return what a save writes to flash anew once `new` is in RAM, as `SettingsTable.to_save` tells it then."""
    rows = {index: replace(row, current=new.get(index, row.current)) for index, row in table.rows.items()}
    return dict(replace(table, rows=rows).to_save)


def saved_of(row: SettingRow) -> str:
    """Return the value that counts from the next power cycle on, as far as the machine tells."""
    return row.current if row.saved is None else row.saved


def is_saved(rows: Mapping[int, SettingRow], table: SettingsTable) -> bool:
    """Return whether the machine shows what `rows` have as saved as saved, too; of RAM where it tells no more."""
    return all(index in table.rows and same_value(saved_of(table.rows[index]), saved_of(row))
               for index, row in rows.items())  # fmt: skip


def _refused(sentence: str) -> CommandRefused:
    return CommandRefused(f"{sentence} {_NOTHING_SENT}", reason=Reason.BAD_PARAMETER)
