"""Keeps on disk what is about to be written to the dish's own settings, until that is settled.

A program that dies in the middle, or loses the line, leaves the note: the next one reads the table, and says in which
state each row is. See `docs/decisions/0077-settings-in-flash.md`.
"""

from __future__ import annotations

import json
from contextlib import suppress
from datetime import UTC, datetime
from pathlib import Path

from birdcage.base.errors import BadMessage, StoreError
from birdcage.base.paths import write_aside_and_rename
from birdcage.base.reason import Reason
from birdcage.link.identity import dish_folder
from birdcage.station.json_form import parse
from birdcage.station.json_shapes import FieldsShape
from birdcage.station.settings import StationSettings
from birdcage.station.settings_left import NotedWrite
from birdcage.station.state_store import StateStore

FILE = "settings-write.json"
LONGEST = 262_144


class SettingsNote:
    """`settings-write.json` in the folder of the dish. Of a dish without an identity it ends with the program."""

    def __init__(self, store: StateStore, settings: StationSettings) -> None:
        self._store, self._settings = store, settings
        self._shape = FieldsShape(NotedWrite)
        self._inside: dict[str, NotedWrite] = {}
        """By port, of dishes without an identity."""

    def read(self, firmware: str) -> NotedWrite | None:
        """Return what was noted of this dish; None if nothing is open.

        StoreError (`damaged`), which names the way out, for a note that can't be read; one of another firmware is none
        of this dish's.
        """
        file = self._file()
        if file is None:
            return self._inside.get(self._store.state.port)
        try:
            data = file.read_bytes()[:LONGEST]
        except FileNotFoundError:
            return None
        except OSError as error:
            raise self._unread(file, str(error)) from error
        try:
            noted: NotedWrite = self._shape.take(parse(data), "The note")
        except BadMessage:
            raise self._unread(file, "damaged") from None
        return noted if noted.firmware == firmware else None

    @staticmethod
    def _unread(file: Path, why: str) -> StoreError:
        return StoreError(
            f"{file} tells of an earlier write of the dish's settings, and can't be read ({why}). Until you rename it, "
            "no setting is written or saved. First compare the dish with your last backup: `birdcage nvs diff BACKUP`.",
            reason=Reason.DAMAGED,
        )

    def written(self) -> datetime:
        """Return when a note that can't be read was written, as far as the disk tells; now where it does not."""
        file = self._file()
        with suppress(OSError):
            if file is not None:
                return datetime.fromtimestamp(file.stat().st_mtime, UTC)
        return self._store.clock.utc()

    def keep(self, noted: NotedWrite) -> None:
        """Note it. StoreError where that can't be done: then nothing may be written."""
        file = self._file()
        if file is None:
            self._inside[self._store.state.port] = noted
            return
        try:
            write_aside_and_rename(file, json.dumps(self._shape.tell(noted, "The note")).encode())
        except OSError as error:
            raise StoreError(f"{file} can't be written ({error}). Nothing was changed on the dish.") from error

    def drop(self) -> None:
        """Nothing is open any more."""
        file = self._file()
        self._inside.pop(self._store.state.port, None)
        if file is not None:
            with suppress(OSError):  # then the next program judges the rows once more, and drops it
                file.unlink(missing_ok=True)

    def _file(self) -> Path | None:
        folder, identity = self._settings.state_folder, self._settings.identify(self._store.state.port)
        return None if folder is None or identity is None else dish_folder(folder, identity) / FILE
