"""Rows of the settings memory as `nvs`, `d` prints them (`docs/reference/g2-settings.md`, *A session*)."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass

DISABLE_TRACKER = 20
MIN_ELEVATION = 101
MAX_ELEVATION = 102


def row_id(index: int) -> str:
    """Return by what name a survey tells a row."""
    return f"nvs.{index}"


def row_label(index: int) -> str:
    """Return what a person is told of where a row stands."""
    return f"NVS {index}"


NvsValue = bool | int | float | str

_ROW = re.compile(r"^\s*(\d+)\)\s(.{26})\s*(\S+)\s+(\S+)\s+(\S+)\s*$")
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
    def value(self) -> NvsValue:
        """The value in force, typed."""
        return typed(self.current)

    @property
    def saved_value(self) -> NvsValue:
        """The value in flash, typed: it is in force from the next power cycle on."""
        return typed(self.saved)

    @property
    def default_value(self) -> NvsValue:
        """The factory's value, typed."""
        return typed(self.default)


@dataclass(frozen=True, slots=True)
class NvsEdit:
    """What `e <index> <value>` answers: the value until now and the new one, as printed."""

    index: int
    name: str
    before: str
    after: str


def typed(text: str) -> NvsValue:
    """Return a value as what it is: `TRUE`, `0x00000007`, `200`, `+0`, `65.00`; any other text as it stands."""
    if text in ("TRUE", "FALSE"):
        return text == "TRUE"
    if re.fullmatch(r"0[xX][0-9A-Fa-f]+", text):
        return int(text, 16)
    if re.fullmatch(r"[-+]?\d+", text):
        return int(text)
    if re.fullmatch(r"[-+]?\d+\.\d+", text):
        return float(text)
    return text


def same_value(printed: str, given: str) -> bool:
    """Return whether a dish that was given one text prints the other for it: `1` is `TRUE`, `18` is `18.00`."""
    one, other = typed(printed), typed(given.upper() if given.upper() in ("TRUE", "FALSE") else given)
    return one == other


def parse_nvs(lines: Iterable[str]) -> dict[int, NvsRow]:
    """Return the rows by index; header, ruler and other lines are passed over."""
    rows = {}
    for match in map(_ROW.match, lines):
        if match:
            rows[int(match[1])] = NvsRow(int(match[1]), match[2].strip(), *match.groups()[2:])
    return rows


def parse_edit(lines: Iterable[str]) -> NvsEdit | None:
    """Read ` 20) Disable Tracker Proc?           FALSE .       TRUE`; None when no line is of that form."""
    match = next((m for m in map(_EDITED.match, lines) if m), None)
    return NvsEdit(int(match[1]), match[2], match[3], match[4]) if match else None
