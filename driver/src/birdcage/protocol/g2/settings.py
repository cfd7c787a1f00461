"""The settings memory, `NVS>` (docs/reference/g2-settings.md, *A session*)."""

from __future__ import annotations

from typing import ClassVar

from birdcage.base.errors import CommandRefused, NoReply
from birdcage.base.reason import Reason
from birdcage.protocol.g2.room import Room
from birdcage.protocol.nvs import NvsRow, parse_edit, parse_nvs, same_value

UNITS = {
    27: "rpm",
    38: "s",
    41: "deg/s",
    80: "deg/s",
    81: "deg/s²",
    83: "steps/turn",
    85: "deg/s",
    88: "steps/turn",
    101: "deg",
    102: "deg",
    103: "deg",
}
"""Units of the rows whose unit a source tells (docs/reference/g2-settings.md, *Units*)."""

_TABLE_S = _SAVE_S = 10.0
"""How long the whole table and a write to flash may take: no source says. Only a deadline depends on it."""


class SettingsMemory(Room):
    """Reads and writes settings: `nvs.read(101).value` is the elevation floor in degrees (see `UNITS`)."""

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
        """Write one row in RAM, save all that RAM holds to flash, and read the row back.

        In force after a power cycle. CommandRefused (`bad_parameter`) when the dish changes another row or to another
        value (nothing is then saved: a power cycle takes it back), does not say that it saved, or shows another value
        as saved.
        """
        edit = parse_edit(self._run(f"e {index} {value}").lines)
        if edit is not None and (edit.index != index or not same_value(edit.after, value)):
            raise CommandRefused(
                f"Told to set NVS row {index} to {value}, the dish set row {edit.index} to {edit.after}. It was not "
                "saved: a power cycle takes it back.",
                reason=Reason.BAD_PARAMETER,
            )
        saved = self._run("s", takes_s=_SAVE_S)
        if not any("Success" in line for line in saved.lines):
            raise CommandRefused(f"The dish did not save: {' / '.join(saved.lines)!r}.", reason=Reason.BAD_PARAMETER)
        row = self.read(index)
        if not same_value(row.saved, value):
            raise CommandRefused(
                f"Told to save {value} in NVS row {index}, the dish shows {row.saved} there.",
                reason=Reason.BAD_PARAMETER,
            )
        return row
