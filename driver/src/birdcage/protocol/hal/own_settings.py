"""The settings of a Trav'ler as those of any machine: what RAM holds (`docs/reference/travler.md`, *Settings*)."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Mapping
from typing import Protocol

from birdcage.base.errors import CommandRefused, NoReply
from birdcage.base.reason import Reason
from birdcage.console.session import Console
from birdcage.protocol.hal.answers import parse_setting
from birdcage.protocol.hal.variant import NVS, VARIANTS, HalVariant
from birdcage.rotator.feature import Range
from birdcage.rotator.own_settings import SettingKnown, SettingRow, SettingsTable
from birdcage.rotator.setting_values import same_value

_SAVE_S = 10.0
"""How long a write to flash may take: no source says. Only a deadline depends on it."""
_ROW = re.compile(r"\s*(\d{1,6})[).:]?\s+(\S.*?)\s*", re.ASCII)
_VALUE = re.compile(r"[-+]?\d+(?:\.\d+)?|0[xX][0-9A-Fa-f]+|TRUE|FALSE", re.ASCII)
_NOTES = {
    "floor": "The lowest elevation that it goes to.",
    "floor.search": "The lowest elevation of its TV search.",
}
_ONE_EXAMPLE = (
    "The lowest elevation, by one example; on other Trav'lers that of the TV search. Here it may raise the floor of "
    "{floor:g}°, and never lower it."
)


def known_of(variant: HalVariant) -> Mapping[int, SettingKnown]:
    """Return what sources tell of the settings of one of the Trav'lers, by row."""
    danger = f"{variant.lower_down} Lower down it may run into its end stop, or a feed may hit."
    notes = _NOTES if variant.row_may_lower else {"floor": _ONE_EXAMPLE.format(floor=variant.el_deg[0])}
    return {
        index: SettingKnown(index, "deg", range=Range(-90.0, 90.0), danger=danger, note=notes[name])
        for name, index in sorted(variant.lowest.items(), key=lambda each: each[1])
    }


KNOWN = {variant.firmware: known_of(variant) for variant in VARIANTS}


class _Dish(Protocol):
    @property
    def console(self) -> Console: ...

    def settings_table(self) -> tuple[str, ...]: ...


class HalOwnSettings:
    """Implements `OwnSettings` by the menu `nvs`; `dish` is open when anything is asked."""

    tells_saved = False

    def __init__(self, dish: _Dish, known: Mapping[int, SettingKnown]) -> None:
        self._dish, self.known = dish, known

    def parse(self, printed: Iterable[str]) -> Mapping[int, SettingRow]:
        """Return the known rows by index. What is printed twice is none.

        How a row is printed no source tells: the first number behind its own is taken. Others stay lines: one of them
        is said to ruin the dish.
        """
        found = [row for line in printed if (row := _row_of(line, self.known)) is not None]
        often = Counter(row.index for row in found)
        return {row.index: row for row in found if often[row.index] == 1}

    def read(self) -> SettingsTable:
        """Read what `d` shows."""
        printed = self._dish.settings_table()
        return SettingsTable(printed, self.parse(printed))

    def write(self, index: int, value: str) -> SettingRow:
        """Change one row with `e`, and read it back with `e`."""
        run = self._dish.console.run
        run(NVS, f"e {index} {value}")
        shown = parse_setting(index, run(NVS, f"e {index}").lines)
        if shown is None:
            raise NoReply(f"The dish did not show row {index} after it was changed.", reason=Reason.GARBAGE)
        if not same_value(shown, value):
            raise CommandRefused(
                f"Told to set row {index} to {value}, the dish shows {shown} there. It was not saved.",
                reason=Reason.BAD_PARAMETER,
            )
        return SettingRow(index, "", shown, None, None)

    def save(self) -> None:
        """Write RAM to flash with `s`. What it says then no source tells: all that is no refusal counts as done."""
        self._dish.console.run(NVS, "s", takes_s=_SAVE_S)


def _row_of(line: str, known: Mapping[int, SettingKnown]) -> SettingRow | None:
    match = _ROW.fullmatch(line)
    if match is None:
        return None
    index, words = int(match[1]), match[2].split()
    values = [at for at, word in enumerate(words) if _VALUE.fullmatch(word)]
    if values and index in known:
        return SettingRow(index, " ".join(words[: values[0]]), words[values[0]], None, None)
    return None
