"""What the last commands did, in one sentence each, with the time."""

from __future__ import annotations

from collections import deque
from datetime import datetime

from birdcage_tui.shown.view import CommandNote

KEPT = 64


class Notes:
    """The newest last. The same again is one; nothing clears the last without being kept."""

    def __init__(self) -> None:
        self.last = ""
        """What is shown now; empty when that was cleared."""
        self._told: deque[CommandNote] = deque(maxlen=KEPT)
        self._once: set[str] = set()

    @property
    def told(self) -> tuple[CommandNote, ...]:
        """All that is kept."""
        return tuple(self._told)

    def tell_once(self, words: str, utc: datetime) -> None:
        """Show a sentence that was not shown in this run."""
        if words not in self._once:
            self._once.add(words)
            self.tell(words, utc)

    def tell(self, words: str, utc: datetime) -> None:
        """Show a sentence, and keep it."""
        self.last = words
        if self._told and self._told[-1].words == words:
            self._told.pop()
        if words:
            self._told.append(CommandNote(utc, words))
