"""Writes the log of passes, on a thread of its own: into the journal, and into a file a pass."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from datetime import datetime
from pathlib import Path

from birdcage.base.errors import BirdcageError
from birdcage.pursuit.pass_csv import PassCsv
from birdcage.pursuit.pass_log_items import Item, PassBegan, PassEnded, PassLooked
from birdcage.pursuit.pass_log_store import PassStore
from birdcage.pursuit.pass_record import PassSample

MOST_HELD_BACK = 5000
"""Items that wait while the disk is full or the database locked: more than an hour of a pass."""


class PassLogWork:
    """For the writer's thread alone, but `problem`. Nothing is raised: a pass goes on whether it is kept or not."""

    def __init__(self, journal: Path, folder: Path, epoch_of: Callable[[int], datetime | None]) -> None:
        self._store = PassStore(journal)
        self._folder, self._epoch_of = folder, epoch_of
        self._file: PassCsv | None = None
        self._to_file: list[PassSample] = []
        self._to_store: list[Item] = []
        self._lost = 0
        self._store_problem = self._file_problem = ""

    @property
    def problem(self) -> str:
        """What is not being kept, and why, in sentences; empty when all is well."""
        lost = f"{self._lost} samples are missing in the log of passes." if self._lost else ""
        return " ".join(each for each in (self._store_problem, self._file_problem, lost) if each)

    def write(self, items: list[Item], dropped: int) -> None:
        """Write what has come in, and what could not be written before."""
        self._lost += dropped
        for item in items:
            self._to_store.append(self._filed(item))
        self._write_file()
        self._write_store()

    def _filed(self, item: Item) -> Item:
        """Do with an item what there is to do for the file of its pass."""
        if isinstance(item, PassBegan):
            head = item.head
            if head.norad_id is not None:
                head = replace(head, elements_epoch=self._epoch_of(head.norad_id))
            self._close_file()
            self._lost, self._file_problem = 0, ""
            try:
                self._file = PassCsv(self._folder, head)
            except OSError as error:
                self._file_problem = _no_file(self._folder, error)
            return PassBegan(head, None if self._file is None else str(self._file.path))
        if isinstance(item, PassLooked) and self._file is not None:
            self._to_file.append(item.sample)
        if isinstance(item, PassEnded):
            self._close_file()
        return item

    def _write_file(self) -> None:
        if self._file is None:
            return
        try:
            while self._to_file:
                self._file.write(self._to_file[:1])
                del self._to_file[0]
        except OSError as error:
            self._file_problem = _no_file(self._file.path, error)
            del self._to_file[:-MOST_HELD_BACK]
        else:
            self._file_problem = ""

    def _close_file(self) -> None:
        self._write_file()
        if self._file is not None:
            self._file.close()
        self._file = None
        self._to_file.clear()

    def _write_store(self) -> None:
        if not self._to_store:
            return
        import sqlite3  # when there is something to keep: a face paints without it

        try:
            self._store.write(self._to_store)
        except (BirdcageError, sqlite3.Error) as error:
            self._store_problem = f"Passes are not being kept in the journal: {error}"
            # The beginning of a pass is what all the rest hangs on: the oldest samples go first.
            while len(self._to_store) > MOST_HELD_BACK:
                oldest = next((at for at, each in enumerate(self._to_store) if isinstance(each, PassLooked)), 0)
                del self._to_store[oldest]
                self._lost += 1
        else:
            self._to_store.clear()
            self._store_problem = ""


def _no_file(path: Path, error: OSError) -> str:
    return f"The pass is not being written to {path}: {error.strerror or error}."
