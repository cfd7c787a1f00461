"""Switches the firmware's own TV search, never without a copy of the dish's settings first."""

from __future__ import annotations

from pathlib import Path

from birdcage.antenna.antenna import BirdcageAntenna
from birdcage.base.errors import ConfigError, StoreError
from birdcage.base.paths import write_aside_and_rename
from birdcage.station.board import Board
from birdcage.station.look import Look
from birdcage.station.settings import StationSettings
from birdcage.station.state import Search


class SearchSwitch:
    """Backs the table up, writes, and looks again."""

    def __init__(self, board: Board, antenna: BirdcageAntenna, look: Look, settings: StationSettings) -> None:
        self._board, self._antenna, self._look, self._folder = board, antenna, look, settings.backup_folder

    def set(self, *, disabled: bool) -> Path:
        """Switch the search off for good, or back on; return the path of the backup."""
        protocol = self._antenna.protocol
        backup = self._back_up(protocol.settings_table())
        if disabled:
            protocol.kill_search()
        else:
            protocol.restore_search()
        self._look.survey()
        if self._board.state.search is not Search.OFF:
            # Written, but the search process that the dish started at power-up goes on until the next one.
            self._board.change(search=Search.UNKNOWN)
        return backup

    def _back_up(self, lines: tuple[str, ...]) -> Path:
        if self._folder is None:
            raise ConfigError("There is no folder for a backup of the dish's settings: nothing was written.")
        stamp = self._board.clock.utc().strftime("%Y%m%dT%H%M%SZ")
        path = self._folder / f"nvs-{self._antenna.protocol.name}-{stamp}.txt"
        demo = "# DEMO\n" if self._board.state.demo else ""
        try:
            write_aside_and_rename(path, (demo + "\n".join(lines) + "\n").encode())
        except OSError as error:
            raise StoreError(f"The backup {path} can't be written ({error}): nothing was changed.") from error
        return path
