"""The settings memory, `NVS>` (docs/reference/g2-settings.md, *A session*)."""

from __future__ import annotations

from typing import ClassVar

from birdcage.base.errors import CommandRefused, NoReply
from birdcage.base.reason import Reason
from birdcage.protocol.nvs import NvsRow, parse_edit, parse_nvs
from birdcage.protocol.trk.room import Room
from birdcage.rotator.setting_values import same_value

_TABLE_S = _SAVE_S = 10.0
"""How long the whole table and a write to flash may take: no source says. Only a deadline depends on it."""
_TYPED = {"TRUE": "1", "FALSE": "0"}
"""A switch is set by a digit: `e 20 1` is what its source has."""


class SettingsMemory(Room):
    """Reads and writes settings: `nvs.read(101).value` is the elevation floor in degrees."""

    menu: ClassVar[str] = "nvs"

    def read(self, index: int) -> NvsRow:
        """Read one row. NoReply (no_row) when there is no such row."""
        rows = parse_nvs(self._run(f"d {index}").lines)
        if index not in rows:
            raise NoReply(f"The dish showed no NVS row {index}.", reason=Reason.NO_ROW)
        return rows[index]

    def table(self) -> dict[int, NvsRow]:
        """Read all rows, by index; there are holes."""
        return parse_nvs(self.printed())

    def printed(self) -> tuple[str, ...]:
        """Read all rows, as printed."""
        return self._run("d", takes_s=_TABLE_S).lines

    def write(self, index: int, value: str) -> NvsRow:
        """Write one row in RAM, and read it back. A power cycle takes it back unless it is saved (`save`).

        CommandRefused (`bad_parameter`) when the dish changes another row, or to another value.
        """
        self._edit(index, value)
        row = self.read(index)
        if not same_value(row.current, value):
            raise CommandRefused(
                f"Told to set NVS row {index} to {value}, the dish shows {row.current} there. It was not saved: a "
                "power cycle takes it back.",
                reason=Reason.BAD_PARAMETER,
            )
        return row

    def save(self) -> None:
        """Save all that RAM holds to flash: it counts from the next power cycle on.

        CommandRefused (`bad_parameter`) when the dish does not say that it saved.
        """
        saved = self._run("s", takes_s=_SAVE_S)
        if not any("Success" in line for line in saved.lines):
            raise CommandRefused(f"The dish did not save: {' / '.join(saved.lines)!r}.", reason=Reason.BAD_PARAMETER)

    def write_and_save(self, index: int, value: str) -> NvsRow:
        """Write one row, save all that RAM holds, and read the row back.

        CommandRefused (`bad_parameter`) as `save`, and when the dish changes another row, or shows another
        value as saved.
        """
        self._edit(index, value)
        self.save()
        row = self.read(index)
        if not same_value(row.saved, value):
            raise CommandRefused(
                f"Told to save {value} in NVS row {index}, the dish shows {row.saved} there.",
                reason=Reason.BAD_PARAMETER,
            )
        return row

    def _edit(self, index: int, value: str) -> None:
        edit = parse_edit(self._run(f"e {index} {_TYPED.get(value, value)}").lines)
        if edit is not None and (edit.index != index or not same_value(edit.after, value)):
            raise CommandRefused(
                f"Told to set NVS row {index} to {value}, the dish set row {edit.index} to {edit.after}. It was not "
                "saved: a power cycle takes it back.",
                reason=Reason.BAD_PARAMETER,
            )
