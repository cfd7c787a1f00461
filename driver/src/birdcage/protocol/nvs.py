"""Rows of the settings memory as `nvs`, `d` prints them (`docs/reference/g2-settings.md`, *A session*)."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass

from birdcage.rotator.own_settings import SettingRow
from birdcage.rotator.setting_values import SettingValue, typed

DISABLE_TRACKER = 20
SLEEP = 38
MIN_ELEVATION = 101
MAX_ELEVATION = 102


def row_label(index: int) -> str:
    """Return what a person is told of where a row stands."""
    return f"NVS {index}"


_ROW = re.compile(r"^\s*(\d{1,6})\)\s(.{26})\s*(\S+)\s+(\S+)\s+(\S+)\s*$", re.ASCII)
_EDITED = re.compile(r"^\s*(\d+)\)\s+(\S.*?)\s+(\S+)\s+\.\s*(\S+)\s*$")


@dataclass(frozen=True, slots=True)
class NvsRow:
    """One setting: the value in force, the one saved in flash, and the factory's, as printed."""

    index: int
    name: str
    current: str
    saved: str
    default: str

    @property
    def row(self) -> SettingRow:
        """It, as any machine's."""
        return SettingRow(self.index, self.name, self.current, self.saved, self.default)

    @property
    def is_of_one_kind(self) -> bool:
        """Whether all three values are switches, whole numbers, decimals or other text."""
        return len({type(each) for each in (self.value, self.saved_value, self.default_value)}) == 1

    @property
    def value(self) -> SettingValue:
        """The value in force, typed."""
        return typed(self.current)

    @property
    def saved_value(self) -> SettingValue:
        """The value in flash, typed: it is in force from the next power cycle on."""
        return typed(self.saved)

    @property
    def default_value(self) -> SettingValue:
        """The factory's value, typed."""
        return typed(self.default)


@dataclass(frozen=True, slots=True)
class NvsEdit:
    """What `e <index> <value>` answers: the value until now and the new one, as printed."""

    index: int
    name: str
    before: str
    after: str


def parse_nvs(lines: Iterable[str]) -> dict[int, NvsRow]:
    """Return the rows by index; header, ruler and other lines are passed over."""
    rows = {}
    for match in map(_ROW.match, lines):
        if match:
            rows[int(match[1])] = NvsRow(int(match[1]), match[2].strip(), *match.groups()[2:])
    return rows


def parse_once(lines: Iterable[str]) -> dict[int, NvsRow]:
    """Return the rows as `parse_nvs`, but none that may be misread.

    An index that is printed twice is none: which one counts is not known. Three values that are not of one kind are
    the words of a line of another form.
    """
    found = [match for match in map(_ROW.match, lines) if match]
    often = Counter(int(match[1]) for match in found)
    rows = parse_nvs(match[0] for match in found)
    return {index: row for index, row in rows.items() if often[index] == 1 and row.is_of_one_kind}


def parse_edit(lines: Iterable[str]) -> NvsEdit | None:
    """Read ` 20) Disable Tracker Proc?           FALSE .       TRUE`; None when no line is of that form."""
    match = next((m for m in map(_EDITED.match, lines) if m), None)
    return NvsEdit(int(match[1]), match[2], match[3], match[4]) if match else None
