"""Keeps the table of a dish's own settings in a file before anything is written there."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from birdcage.antenna.antenna import BirdcageAntenna
from birdcage.base.errors import ConfigError, StoreError
from birdcage.base.paths import write_aside_and_rename
from birdcage.rotator.settings_file import backup_path, settings_text
from birdcage.station.state_store import StateStore


class SettingsBackup:
    """Writes into a folder that the settings of the station name; without one nothing may be written."""

    def __init__(self, store: StateStore, antenna: BirdcageAntenna, folder: Path | None) -> None:
        self._store, self._antenna, self._folder = store, antenna, folder
        self._kept: tuple[tuple[object, ...], Path] | None = None
        """Of which dish the last backup was made, and where it is."""

    def keep(self, printed: Sequence[str]) -> Path:
        """Write the table, and return where it is. ConfigError, StoreError where it can't be kept."""
        if self._folder is None:
            raise ConfigError("No folder for a backup of the dish's settings. Nothing was written.")
        utc, facts = self._store.clock.utc(), self._antenna.rotator.facts
        path = backup_path(self._folder, facts.settings_name, facts.firmware, utc)
        text = settings_text(facts.name, facts.firmware, utc, printed, demo=self._store.state.demo)
        try:
            write_aside_and_rename(path, text.encode())
        except OSError as error:
            raise StoreError(f"The backup {path} can't be written ({error}): nothing was changed.") from error
        self._kept = self._dish(), path
        return path

    @property
    def kept(self) -> Path | None:
        """Where the backup is that this run has made of this dish since its last save; None before the first."""
        if self._kept is None or self._kept[0] != self._dish():
            return None
        return self._kept[1]

    def forget(self) -> None:
        """Flash was written: the next write is backed up anew."""
        self._kept = None

    def _dish(self) -> tuple[object, ...]:
        """Return what tells this dish from others. One whose link was gone meanwhile may be another one."""
        state = self._store.state
        boot = None if state.boot_log is None else state.boot_log.utc
        return state.port, state.demo, self._antenna.rotator.facts.firmware, state.link.since, boot
