"""Counts the replies of a station's dish by day, and hands them on now and then."""

from __future__ import annotations

from typing import Protocol

from birdcage.base.clock import Clock
from birdcage.base.journal import Journal
from birdcage.base.journal_rows import ReplyCount
from birdcage.station.state import LinkPhase, LinkState, StationState

EVERY_S = 60.0
"""How often it is written while the dish is asked."""


class ReplySource(Protocol):
    """Whose replies they are."""

    @property
    def dish(self) -> str:
        """The name of the dish; empty while none is known."""

    @property
    def adapter(self) -> str:
        """By which adapter it is reached."""


class ReplyTally:
    """Adds up what the link counts, from one state of the station to the next.

    What is tried while the dish is silent does not count: a dish that is switched off loses no replies.
    """

    def __init__(self, named: ReplySource, journal: Journal, clock: Clock) -> None:
        self._named, self._journal, self._clock = named, journal, clock
        self._link = LinkState()
        self._sums = [0, 0, 0, 0]
        self._written_at = clock.monotonic()

    def take(self, state: StationState) -> None:
        """Take in a state. Called with each one: it returns at once where the link is as before."""
        before, link = self._link, state.link
        if link is before:
            return
        self._link = link
        if link.asked == before.asked or before.state is not LinkPhase.UP:
            return
        now, then = _counts(link), _counts(before)
        if link.asked < before.asked:
            then = (0, 0, 0, 0)  # another line, which counts from nothing
        self._sums = [total + new - old for total, new, old in zip(self._sums, now, then, strict=True)]
        if self._clock.monotonic() >= self._written_at + EVERY_S:
            self.write()

    def write(self) -> None:
        """Hand on what was counted since."""
        self._written_at = self._clock.monotonic()
        if self._sums[0] and self._named.dish:
            day = self._clock.utc().date()
            self._journal.append(ReplyCount(self._named.dish, self._named.adapter, day, *self._sums))
            self._sums = [0, 0, 0, 0]


def _counts(link: LinkState) -> tuple[int, int, int, int]:
    return link.asked, link.unanswered, link.late, link.stray_bytes
