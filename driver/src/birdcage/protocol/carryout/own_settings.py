"""The one setting of a Carryout of 2003 that is known, as those of any machine (`docs/reference/carryout-2003.md`)."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping

from birdcage.base.errors import CommandRefused, NoReply
from birdcage.base.reason import Reason
from birdcage.console.session import Console
from birdcage.protocol.carryout.dialect import NVS
from birdcage.protocol.carryout.going import EL_MAX_ROW, EL_SPAN_DEG, HIGHEST_EL_DEG, ceiling_text
from birdcage.rotator.feature import Range
from birdcage.rotator.own_settings import SettingKnown, SettingRow, SettingsTable
from birdcage.rotator.setting_values import same_value

_SAVE_S = 10.0
"""How long a write to flash may take: no source says. Only a deadline depends on it."""

KNOWN: Mapping[int, SettingKnown] = {
    EL_MAX_ROW: SettingKnown(
        EL_MAX_ROW, "deg", range=Range(EL_SPAN_DEG[0], HIGHEST_EL_DEG),
        danger="Above the factory's 73° a feed may hit.",
        note="The highest elevation that it takes.",
    )
}  # fmt: skip


class CarryoutOwnSettings:
    """Implements `OwnSettings` by `e <row>` of the menu `nvs`: no source says that it lists its rows."""

    known = KNOWN
    tells_saved = False

    def __init__(self, console: Callable[[], Console]) -> None:
        self._console = console

    def parse(self, printed: Iterable[str]) -> Mapping[int, SettingRow]:
        """Return the row, where its value is to be seen."""
        text = ceiling_text(printed)
        return {} if text is None else {EL_MAX_ROW: SettingRow(EL_MAX_ROW, "", text, None, None)}

    def read(self) -> SettingsTable:
        """Read the row with `e`."""
        printed = self._console().run(NVS, f"e {EL_MAX_ROW}").lines
        rows = self.parse(printed)
        if not rows:
            raise NoReply(f"The dish showed no value of row {EL_MAX_ROW}.", reason=Reason.GARBAGE)
        return SettingsTable(printed, rows)

    def write(self, index: int, value: str) -> SettingRow:
        """Change the row with `e`, and read it back."""
        if index != EL_MAX_ROW:
            raise CommandRefused(f"No source tells of row {index}. Nothing was sent.", reason=Reason.NO_ROW)
        self._console().run(NVS, f"e {index} {value}")
        row = self.read().rows[index]
        if not same_value(row.current, value):
            raise CommandRefused(
                f"Told to set row {index} to {value}, the dish shows {row.current} there. It was not saved.",
                reason=Reason.BAD_PARAMETER,
            )
        return row

    def save(self) -> None:
        """Write RAM to flash with `s`. What it says then no source tells: all that is no refusal counts as done."""
        self._console().run(NVS, "s", takes_s=_SAVE_S)
