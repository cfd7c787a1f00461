"""The settings of a dish with the menu `NVS>`, and its TV search, which a row of them switches."""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

from birdcage.protocol.nvs import DISABLE_TRACKER, NvsRow
from birdcage.protocol.trk.own_settings import TrkOwnSettings
from birdcage.protocol.trk.protocol import TrkProtocol
from birdcage.protocol.trk.settings import SettingsMemory
from birdcage.rotator.own_settings import OwnSettings, SettingKnown


class TrkNvsProtocol(TrkProtocol):
    """A `TrkProtocol` with settings (docs/reference/g2-settings.md)."""

    settings_known: ClassVar[Mapping[int, SettingKnown]] = {}
    """What sources tell of its rows."""

    @property
    def nvs(self) -> SettingsMemory:
        """`NVS>`: the settings."""
        return SettingsMemory(self.console)

    def read_nvs(self, index: int) -> NvsRow:
        """Read one row of the settings memory. NoReply (no_row) when there is no such row.

        Source: docs/reference/g2-settings.md.
        """
        return self.nvs.read(index)

    def write_nvs(self, index: int, value: str) -> NvsRow:
        """Write one row in RAM, save it to flash, and read it back. Takes effect after a power cycle."""
        return self.nvs.write_and_save(index, value)

    @property
    def own_settings(self) -> OwnSettings:
        """The settings memory, as that of any machine."""
        return TrkOwnSettings(lambda: self.nvs, self.settings_known)

    def settings_table(self) -> tuple[str, ...]:
        """Read the whole settings memory with `nvs`, `d`, as printed."""
        return self.nvs.printed()

    def kill_search(self) -> None:
        """Switch the TV search off for good: NVS 20 TRUE, saved (docs/reference/g2-settings.md, *The TV search*).

        Takes effect after a power cycle. From then on the dish does not home by itself.
        """
        self.save_search(disabled=True)

    def restore_search(self) -> None:
        """Walk `kill_search` back: NVS 20 FALSE, saved. Takes effect after a power cycle."""
        self.save_search(disabled=False)

    def save_search(self, *, disabled: bool) -> NvsRow:
        """Save NVS 20 where it is not so yet; return the row as it was read last."""
        row = self.read_nvs(DISABLE_TRACKER)
        if row.saved != ("TRUE" if disabled else "FALSE"):
            row = self.write_nvs(DISABLE_TRACKER, "1" if disabled else "0")
        return row
