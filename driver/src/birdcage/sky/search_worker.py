"""The process that searches for passes: `python -m birdcage.sky.search_worker CATALOGUE`, begun by `search_process`.

It reads what to do from stdin and writes what it found to stdout. It ends when stdin ends, and so never
outlives the program that has begun it.
"""

from __future__ import annotations

import os
import queue
import sys
import threading
from contextlib import suppress
from datetime import datetime
from pathlib import Path
from typing import IO, Any

from birdcage.base.errors import StoreError
from birdcage.sky.observer import Observer
from birdcage.sky.pass_search_job import PassSearchJob
from birdcage.sky.reach_limits import ReachLimits
from birdcage.sky.search_process import receive, send
from birdcage.sky.watch_source import Watched, frozen_set, read_catalogue

NICENESS = 10
"""The dish comes first, on one core, too."""


class SearchWorker:
    """Does the last search that it was told to do."""

    def __init__(self, catalogue: Path, out: IO[bytes]) -> None:
        self._catalogue, self._out = catalogue, out
        self._watched: Watched | None = None
        self._job: PassSearchJob | None = None
        self._number = 0
        self._now: datetime | None = None

    def run(self, messages: queue.SimpleQueue[Any]) -> None:
        """Work until stdin ends."""
        while True:
            idle = self._job is None or self._job.idle
            with suppress(queue.Empty):
                what, *values = messages.get(block=idle)
                getattr(self, f"_{what}")(*values)
            if self._job is not None and self._now is not None:
                self._job.work(self._now)
                send(self._out, (self._number, self._job.fresh(), self._job.progress, self._job.idle))

    def _begin(self, number: int, observer: Observer, limits: ReachLimits, start: datetime, now: datetime) -> None:
        try:
            self._watched = read_catalogue(self._catalogue)
        except StoreError:  # the watch reads it, too, and says so
            self._watched = self._watched or frozen_set()
        self._number, self._now = number, now
        self._job = PassSearchJob(self._watched, observer, limits, start)

    def _limits(self, number: int, limits: ReachLimits) -> None:
        self._number = number
        if self._job is not None:
            self._job.set_limits(limits)

    def _now_is(self, now: datetime) -> None:
        self._now = now
        if self._job is not None:
            self._job.idle = False


def _listen(pipe: IO[bytes], messages: queue.SimpleQueue[Any]) -> None:
    try:
        while True:
            messages.put(receive(pipe))
    except BaseException:  # noqa: BLE001 - the end of the other process is ours, however it comes
        os._exit(0)


def main() -> None:
    """Search until stdin ends; what goes wrong is told before the end."""
    if hasattr(os, "nice"):
        os.nice(NICENESS)
    messages: queue.SimpleQueue[Any] = queue.SimpleQueue()
    threading.Thread(target=_listen, args=(sys.stdin.buffer, messages), daemon=True).start()
    out = sys.stdout.buffer
    try:
        SearchWorker(Path(sys.argv[1]), out).run(messages)
    except Exception as error:
        with suppress(OSError):
            send(out, f"{type(error).__name__}: {error}")
        raise SystemExit(1) from error


if __name__ == "__main__":
    main()
