"""The settings memory `NVS>` as that of any machine (docs/reference/g2-settings.md, *A session*)."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping

from birdcage.base.errors import NoReply
from birdcage.protocol.nvs import parse_once
from birdcage.protocol.trk.settings import SettingsMemory
from birdcage.rotator.own_settings import SettingKnown, SettingRow, SettingsTable


class TrkOwnSettings:
    """Implements `OwnSettings` by the menu `NVS>`; `memory` returns it, and raises LinkError when no port is open."""

    tells_saved = True

    def __init__(self, memory: Callable[[], SettingsMemory], known: Mapping[int, SettingKnown]) -> None:
        self.known = known
        self._memory = memory

    def parse(self, printed: Iterable[str]) -> Mapping[int, SettingRow]:
        """Return the rows by index. What is printed twice, or in another form, is none."""
        return {index: each.row for index, each in parse_once(printed).items()}

    def read(self) -> SettingsTable:
        """Read all with `d`."""
        printed = self._memory().printed()
        rows = self.parse(printed)
        if not rows:
            raise NoReply(f"The dish answered `d` with {len(printed)} lines, none of them a setting.")
        return SettingsTable(printed, rows)

    def write(self, index: int, value: str) -> SettingRow:
        """Write one row in RAM with `e`."""
        return self._memory().write(index, value).row

    def save(self) -> None:
        """Write RAM to flash with `s`."""
        self._memory().save()
