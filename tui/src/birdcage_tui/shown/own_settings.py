"""The dish's own settings as the System page shows them: what is printed, and what a person is about to write."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from birdcage.rotator.own_settings import SettingKnown, SettingRow, SettingsTable
from birdcage.rotator.setting_values import same_value


@dataclass(frozen=True, slots=True)
class OwnSettingsNow:
    """What the tab shows. Pure data."""

    table: SettingsTable | None = None
    """None before it was read."""
    read_at: float | None = None
    """Monotonic seconds."""
    staged: Mapping[int, str] = field(default_factory=dict)
    """New values that are not written yet, by row."""
    busy: str = ""
    """What is being done, in a word or two; empty while nothing is."""
    wrong: str = ""
    """Why the last deed was not done, as a sentence."""
    unread: str = ""
    """Why the table could not be read, as a sentence."""
    backup: str = ""
    """The path of the backup that the first write of this run has made."""
    undo: tuple[Mapping[int, str], ...] = ()
    """Values from before each write of this run, the newest last."""


@dataclass(frozen=True, slots=True)
class SettingLine:
    """One row with all that is to be shown of it."""

    row: SettingRow
    known: SettingKnown | None
    staged: str | None

    @property
    def is_unsaved(self) -> bool:
        """Whether a power cycle would take its value back."""
        return self.row.saved is not None and not same_value(self.row.saved, self.row.current)

    @property
    def is_modified(self) -> bool:
        """Whether it is not what the factory put there, or is about to be another."""
        differs = self.row.default is not None and not same_value(self.row.default, self.row.current)
        return differs or self.is_unsaved or self.staged is not None


def setting_lines(
    now: OwnSettingsNow, known: Mapping[int, SettingKnown], wanted: str = "", *, only_modified: bool = False
) -> list[SettingLine]:
    """Return the rows whose number, name, value or unit holds all words of a filter; none before they were read."""
    if now.table is None:
        return []
    words = wanted.casefold().split()
    lines = []
    for index, row in sorted(now.table.rows.items()):
        line = SettingLine(row, known.get(index), now.staged.get(index))
        unit = "" if line.known is None else line.known.unit
        text = f"{index} {row.name} {row.current} {unit}".casefold()
        if all(word in text for word in words) and (line.is_modified or not only_modified):
            lines.append(line)
    return lines


def differences(now: OwnSettingsNow) -> list[tuple[SettingRow, str]]:
    """Return the rows that a write would change, with the new values."""
    if now.table is None:
        return []
    rows = now.table.rows
    return [(rows[index], value) for index, value in sorted(now.staged.items()) if index in rows]
