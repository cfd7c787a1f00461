"""What the app knows of maps of the sky: the one under way as the station tells it, any from the file, read beside."""

from __future__ import annotations

import threading
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from typing import TypeVar

from birdcage.base.clock import Clock
from birdcage.base.errors import BirdcageError
from birdcage.base.text import clean
from birdcage.skymap.map_file import MapHead, find_map, list_maps, read_map
from birdcage.skymap.map_request import KIND
from birdcage.station.access import FaceStation
from birdcage.station.events import Event, TaskChanged
from birdcage.station.task_state import TaskPhase

from birdcage_tui.shown.map_book import MapBook, MapRead

AGAIN_S, DETAILS_S = 5.0, 60.0
"""Between two readings of the file for the same map: where levels are missing, and where only times are."""
Found = TypeVar("Found")
Work = Callable[[], None]
Begin = Callable[[Work], None]
"""Does some work beside the app's thread."""


def in_a_thread(work: Work) -> None:
    """Do it on a thread that does not keep the app from ending."""
    threading.Thread(target=work, name="sky map file", daemon=True).start()


class MapFeed:
    """Nothing is read before `begin`. All of it is for the app's thread, and none of it waits for the disk."""

    def __init__(
        self, station: FaceStation, clock: Clock, soon: Callable[[Work], object], changed: Work, path: Path | None, *,
        beside: Begin = in_a_thread,
    ) -> None:  # fmt: skip
        """Without a file there are no maps."""
        self._station, self._clock, self._soon, self._changed = station, clock, soon, changed
        self._path, self.beside = path, beside
        self.book = MapBook()
        self.ended: dict[str, str] = {}
        """How the last task that made a map has ended, by the map's key: at its end, too, which may be a time."""
        self.problem = ""
        """Why the file can't be read, as a sentence; empty while all is well."""
        self._reads = False
        self._wanted = ""
        self._read_at: dict[str, float] = {}
        self._unsubscribe: Work | None = None

    def begin(self) -> None:
        """Meet the station, and a map that it makes already; after the first frame."""
        self._unsubscribe = self._station.subscribe(self._on_event, TaskChanged)
        for task in self._station.state.tasks:
            self._take(TaskChanged(self._clock.monotonic(), self._clock.utc(), task))

    def close(self) -> None:
        """Hear nothing more."""
        if self._unsubscribe is not None:
            self._unsubscribe()

    @property
    def ended_words(self) -> str | None:
        """How the map that is shown came to an end in this session; None where it did not."""
        return None if self.book.shown is None else self.ended.get(self.book.shown.key)

    def _on_event(self, event: Event) -> None:
        if isinstance(event, TaskChanged) and event.task.kind == KIND:
            self._soon(partial(self._take, event))

    def _take(self, event: TaskChanged) -> None:
        task, key = event.task, str(event.task.found.get("map", ""))
        if task.phase is TaskPhase.OVER:
            self.ended[key] = task.why
            self._read_at.pop(key, None)
        else:
            self.ended.pop(key, None)
        wanted = self.book.take(task)
        shown, pause_s = self.book.shown, AGAIN_S
        if wanted is None and shown is not None and shown.key == key and shown.heard > len(shown.samples):
            wanted, pause_s = key, DETAILS_S
        now = self._clock.monotonic()
        if wanted is not None and now - self._read_at.get(wanted, now - pause_s) >= pause_s:
            self._read_at[wanted] = now
            self._read(wanted)

    def open(self, key: str) -> None:
        """Show a map of the file, until another one begins."""
        self.book.chosen = key
        self._read(key)

    def list(self, tell: Callable[[Sequence[MapHead] | str], object]) -> None:
        """Read which maps are kept, the newest first, and `tell` it on the app's thread; or why that fails."""

        def read() -> Sequence[MapHead]:
            return [] if self._path is None else list_maps(self._path)

        self.do_beside(read, tell)

    def head(self, key: str, tell: Callable[[MapHead | str], object]) -> None:
        """Read what holds for a map, and `tell` it on the app's thread; or why that fails."""

        def read() -> MapHead | str:
            found = None if self._path is None else find_map(self._path, key)
            return found or "This map was deleted."

        self.do_beside(read, tell)

    def do_beside(self, read: Callable[[], Found | str], tell: Callable[[Found | str], object]) -> None:
        """Do what may take a while beside, and `tell` on the app's thread what came of it, or why it failed."""

        def told(found: Found | str) -> None:
            tell(found)

        def work() -> None:
            found: Found | str
            try:
                found = read()
            except (BirdcageError, ValueError) as error:
                found = str(error)
            except Exception as error:  # noqa: BLE001 - else whoever waits for it would wait for ever
                found = f"It failed: {type(error).__name__}, {clean(str(error))}"
            self._soon(partial(told, found))

        self.beside(work)

    def _read(self, key: str) -> None:
        """Read a map beside; where one is being read, it comes after that."""
        if self._path is None or not key:
            return
        if self._reads:
            self._wanted = key
            return
        self._reads, path = True, self._path

        def read() -> MapRead | None:
            head = find_map(path, key)
            return None if head is None else MapRead.of(read_map(path, head.number))

        self.do_beside(read, partial(self._have_read, key))

    def _have_read(self, key: str, found: MapRead | str | None) -> None:
        self._reads, self.problem = False, found if isinstance(found, str) else ""
        if isinstance(found, MapRead):
            if self.book.chosen in ("", key):
                self.book.read(key, found)
        else:
            self._read_at.pop(key, None)  # its first direction is not on the disk yet
        wanted, self._wanted = self._wanted, ""
        if wanted:
            self._read(wanted)
        self._changed()
