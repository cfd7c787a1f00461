"""The settings that a machine keeps in its own memory: read as printed, changed in RAM, saved to flash as a whole.

Two memories: RAM, which a change goes to, and flash, which the machine reads when it gets power. A change counts from
the next power cycle on after it was saved; unsaved it is gone then.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from datetime import datetime
from enum import Enum
from typing import Protocol

from birdcage.rotator.feature import FeatureKind, Range
from birdcage.rotator.setting_values import same_value


def row_id(index: int) -> str:
    """Return by what name a survey tells a row (`Survey.settings`)."""
    return f"nvs.{index}"


@dataclass(frozen=True, slots=True)
class SettingRow:
    """One setting, its values as printed."""

    index: int
    name: str
    """As the machine prints it; empty where it prints none."""
    current: str
    """What RAM holds."""
    saved: str | None
    """What flash holds: in force from the next power cycle on. None where the machine does not tell."""
    default: str | None
    """The factory's value; None where the machine does not tell."""

    @property
    def is_unsaved(self) -> bool:
        """Whether flash holds another value; False where the machine does not tell."""
        return self.saved is not None and not same_value(self.saved, self.current)


@dataclass(frozen=True, slots=True)
class SettingKnown:
    """What a source tells of a row. A row without one is kept, shown, and changed only with a person's consent."""

    index: int
    unit: str = ""
    kind: FeatureKind = FeatureKind.NUMBER
    """A number, a switch or text."""
    range: Range | None = None
    """Of a number, in its unit; None if no source tells."""
    danger: str = ""
    """What a wrong value does, in sentences, which a person has to agree to; empty if none is known."""
    note: str = ""
    """What a person should know who reads it, in sentences."""


class RowState(Enum):
    """Where a row stands that was to be written, by what the machine shows now."""

    UNTOUCHED = "untouched"
    """As it was before."""
    IN_RAM = "in RAM only"
    """RAM has the new value and flash the old one: a power cycle takes it back."""
    SAVED = "saved"
    """Flash has the new value."""
    OTHER = "another value"
    """Neither the old value nor the new one."""
    UNTOLD = "not told"
    """RAM has the new value, a save had begun, and the machine does not tell what flash holds."""


@dataclass(frozen=True, slots=True)
class UnfinishedRow:
    """A row that was to be written: what it was, what it was to be, and where it stands."""

    index: int
    name: str
    before: str
    wanted: str
    state: RowState


@dataclass(frozen=True, slots=True)
class UnfinishedWrite:
    """Rows that were written, or were to be, and that no save has settled yet."""

    began: datetime
    by: str
    backup: str | None
    """The path of the table as it was before."""
    rows: tuple[UnfinishedRow, ...]
    sentences: tuple[str, ...]
    """What that means, and the way out."""


@dataclass(frozen=True, slots=True)
class SettingsTable:
    """All settings of one machine at one time."""

    printed: tuple[str, ...]
    """As the machine prints them, line by line: also lines that are no row of a known form."""
    rows: Mapping[int, SettingRow]
    """The rows that could be read, by index; there are holes."""
    unfinished: UnfinishedWrite | None = None
    """What an earlier write has left behind, where it has; a machine itself never tells this."""

    @property
    def unsaved(self) -> tuple[SettingRow, ...]:
        """The rows whose value in RAM is not the one in flash: what a save would keep."""
        return tuple(row for row in self.rows.values() if row.is_unsaved)

    @property
    def to_save(self) -> Mapping[int, str]:
        """What a save writes to flash anew, by row: the unsaved rows; all rows where the machine does not tell."""
        return {row.index: row.current for row in self.rows.values() if row.saved is None or row.is_unsaved}


@dataclass(frozen=True, slots=True)
class SettingsWritten:
    """What a write has come to."""

    backup: str | None
    """The path of the table as it was before the first write of this run; None where nothing had to be written."""
    table: SettingsTable
    """As it is now."""


class OwnSettings(Protocol):
    """What a machine offers for its settings. The owner's thread only, and only while the machine rests.

    What talks raises LinkError, NoReply and CommandRefused as `Rotator` does.
    """

    @property
    def known(self) -> Mapping[int, SettingKnown]:
        """What sources tell of its rows, by index: `Facts.settings_known`."""

    @property
    def tells_saved(self) -> bool:
        """Whether it prints what flash holds. Else only the next power-up tells."""

    def parse(self, printed: Iterable[str]) -> Mapping[int, SettingRow]:
        """Return the rows in lines that it has printed; lines of another form are left out. Sends nothing."""

    def read(self) -> SettingsTable:
        """Read all that it shows. NoReply (`garbage`) where it shows nothing."""

    def write(self, index: int, value: str) -> SettingRow:
        """Change one row in RAM, and return it as it was read back.

        CommandRefused (`bad_parameter`) when the machine changes another row, or to another value.
        """

    def save(self) -> None:
        """Write all that RAM holds to flash. CommandRefused when the machine does not say that it did."""
