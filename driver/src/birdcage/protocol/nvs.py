"""Rows of the settings memory as `nvs`, `d` prints them (reference section 7.5)."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass

DISABLE_TRACKER = 20
MIN_ELEVATION = 101
MAX_ELEVATION = 102

_ROW = re.compile(r"^\s*(\d+)\)\s(.{26})\s*(\S+)\s+(\S+)\s+(\S+)\s*$")


@dataclass(frozen=True, slots=True)
class NvsRow:
    """One setting: the value in force, the one saved in flash, and the factory's, as printed."""

    index: int
    name: str
    current: str
    saved: str
    default: str


def parse_nvs(lines: Iterable[str]) -> dict[int, NvsRow]:
    """Return the rows by index; header, ruler and other lines are passed over."""
    rows = {}
    for match in map(_ROW.match, lines):
        if match:
            rows[int(match[1])] = NvsRow(int(match[1]), match[2].strip(), *match.groups()[2:])
    return rows
