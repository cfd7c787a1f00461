"""A search for passes in a process of its own.

SGP4 and numpy hold the GIL while they work, and a STOP key waits for it several times on its way to the wire. From
another process they cost STOP nothing (docs/decisions/0025). Messages are pickles, each after its length.
"""

from __future__ import annotations

import os
import pickle
import struct
import subprocess
import sys
import threading
from collections import deque
from collections.abc import Callable
from datetime import datetime, timedelta
from pathlib import Path
from typing import IO, Any

from birdcage.sky.observer import Observer
from birdcage.sky.pass_row import PassRow
from birdcage.sky.reach_limits import ReachLimits
from birdcage.sky.search_job import MOST_OTHERS, OTHERS_HOURS

TELL_S = 5.0
"""The process is told the time that is looked at when it has gone on, or back, by that much."""
ENDED = object()
"""What is found where there is nothing more to find: the process has ended."""
_LENGTH = struct.Struct(">I")


class SearchFailed(Exception):
    """The process of the search has ended by itself, or could not be started."""


def send(pipe: IO[bytes], message: object) -> None:
    """Write one message."""
    data = pickle.dumps(message, pickle.HIGHEST_PROTOCOL)
    pipe.write(_LENGTH.pack(len(data)) + data)
    pipe.flush()


def receive(pipe: IO[bytes]) -> Any:  # noqa: ANN401 - as varied as messages are
    """Read one message; EOFError at the end of them."""
    head = pipe.read(_LENGTH.size)
    data = pipe.read(_LENGTH.unpack(head)[0]) if len(head) == _LENGTH.size else b""
    if not data:
        raise EOFError
    return pickle.loads(data)  # noqa: S301 - from a process that we have started


class SearchProcess:
    """The process: started with the first search, ended by `close`, or by itself once ours is gone."""

    def __init__(self, catalogue: Path, on_found: Callable[[], object]) -> None:
        """Search through the file `catalogue`; `on_found` is called, on another thread, at the end of a search."""
        self._catalogue, self._on_found = catalogue, on_found
        self._child: subprocess.Popen[bytes] | None = None
        self._job: RemoteSearch | None = None
        self._count = 0

    @property
    def pid(self) -> int | None:
        """Its number; None while there is none."""
        return None if self._child is None else self._child.pid

    def begin(self, observer: Observer, limits: ReachLimits, start: datetime, now: datetime) -> RemoteSearch:
        """Search the catalogue as it is now; a search that is under way is given up. SearchFailed if that can't be."""
        job = self._job = RemoteSearch(self, self.new_number(), start, now)
        self.tell("begin", job.number, observer, limits, start, now)
        return job

    def new_number(self) -> int:
        """Return a number for what is asked next: answers to what was asked before are dropped."""
        self._count += 1
        return self._count

    def is_doing(self, job: RemoteSearch) -> bool:
        """Return whether that is the search it works on."""
        return job is self._job

    def tell(self, *message: object) -> None:
        """Send a message. SearchFailed if no process reads it."""
        try:
            child = self._child or self._start()
            assert child.stdin is not None
            send(child.stdin, message)
        except OSError as error:
            raise SearchFailed(f"the process that searches for passes: {error}") from error

    def _start(self) -> subprocess.Popen[bytes]:
        child = self._child = subprocess.Popen(  # noqa: S603 - a module of ours
            [sys.executable, "-P", "-m", "birdcage.sky.search_worker", str(self._catalogue)],
            stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
            start_new_session=True,  # Ctrl+C, and a terminal that closes, are not meant for it
            env={**os.environ, "OPENBLAS_NUM_THREADS": "1"},  # each thread of that would want memory of its own
        )  # fmt: skip
        threading.Thread(target=self._read, args=(child,), name="search", daemon=True).start()
        return child

    def _read(self, child: subprocess.Popen[bytes]) -> None:
        assert child.stdout is not None
        found: Any = None
        while found is not ENDED:
            try:
                found = receive(child.stdout)
            except (EOFError, OSError, pickle.UnpicklingError):
                found = ENDED
            job = self._job
            if child is not self._child or job is None:
                return  # another one has taken its place, or it was closed
            job.found.append(found)
            if found is ENDED or found[-1]:
                self._on_found()

    def close(self) -> None:
        """End it; nothing is told any more."""
        self._job = None
        child, self._child = self._child, None
        if child is not None:
            child.kill()
            child.wait()


class RemoteSearch:
    """One search of that process: a `SearchJob`."""

    def __init__(self, process: SearchProcess, number: int, start: datetime, now: datetime) -> None:
        self.start, self.number = start, number
        self.idle = False
        self.progress: float | None = 0.0
        self.found: deque[Any] = deque()
        """What the process has told and `work` has not taken in; appended by another thread."""
        self._process, self._told = process, now
        self._rows: list[PassRow] = []
        self._in_order = True
        self._why = ""

    def ends(self) -> datetime:
        """Return up to when passes of all satellites are searched for."""
        return self.start + timedelta(hours=OTHERS_HOURS)

    def set_limits(self, limits: ReachLimits) -> None:
        """Take other limits: reach is worked out anew."""
        self._rows = []
        if self._process.is_doing(self):
            self.number, self.idle = self._process.new_number(), False
            self._process.tell("limits", self.number, limits)

    def work(self, now: datetime) -> bool:
        """Take in what was found; False if that is nothing. SearchFailed when the process has ended."""
        if self._process.is_doing(self) and abs(now - self._told) >= timedelta(seconds=TELL_S):
            self._told = now
            self._process.tell("now_is", now)
        news = False
        while self.found:
            news = self._take(self.found.popleft()) or news
        return news

    def _take(self, found: Any) -> bool:  # noqa: ANN401 - as it came
        if found is ENDED:
            raise SearchFailed(f"the process that searches for passes has ended{self._why}")
        if isinstance(found, str):
            self._why = f": {found}"
            return False
        number, rows, progress, idle = found
        if number != self.number:
            return False
        news = bool(rows) or (progress, idle) != (self.progress, self.idle)
        self.progress, self.idle = progress, idle
        if rows:
            self._rows += rows
            self._in_order = False
        return news

    def rows(self, now: datetime) -> tuple[PassRow, ...]:
        """Return the rows so far of passes that are not over, in order of AOS."""
        if not self._in_order:
            self._rows.sort(key=lambda row: row.passing.aos)
            self._in_order = True
        others, chosen = 0, []
        for row in self._rows:
            if row.passing.los > now and (row.favourite or others < MOST_OTHERS):
                others += not row.favourite
                chosen.append(row)
        return tuple(chosen)
