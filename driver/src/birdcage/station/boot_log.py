"""Keeps what the dish printed while it started, from its first boot mark to its prompt."""

from __future__ import annotations

from collections.abc import Iterable
from datetime import datetime

from birdcage.station.state import BootLog
from birdcage.station.state_store import StateStore

MOST_LINES = 200
"""Lines kept of one start: many times what a dish prints."""
LONGEST = 200
"""Characters kept of a line."""


class BootLogKeeper:
    """The last log is in the state (`StationState.boot_log`) until the dish restarts again."""

    def __init__(self, store: StateStore) -> None:
        self._store = store
        self._is_starting = False

    def marked(self, line: str) -> None:
        """Hear a line that tells that the dish starts: the first one begins a log."""
        if not self._is_starting:
            self._is_starting = True
            self._keep(self._store.clock.utc(), ())
        self.hear(line)

    def hear(self, line: str) -> None:
        """Hear any other line: it belongs to the log while the dish starts."""
        log = self._store.state.boot_log
        if self._is_starting and log is not None and line.strip() and len(log.lines) < MOST_LINES:
            self._keep(log.utc, (*log.lines, line))

    def ended(self) -> None:
        """The prompt came, or the dish answers: what it prints from now on is no log of its start."""
        self._is_starting = False

    def asked_for(self, lines: Iterable[str]) -> None:
        """Take the whole log out of the answer to a line that had the dish restart."""
        self._keep(self._store.clock.utc(), tuple(line for line in lines if line.strip())[:MOST_LINES])
        self._is_starting = False

    def _keep(self, utc: datetime, lines: Iterable[str]) -> None:
        self._store.change(boot_log=BootLog(utc, tuple(line.rstrip()[:LONGEST] for line in lines)))
