"""A search for passes under way, as the watch of the sky sees it."""

from __future__ import annotations

from datetime import datetime
from typing import Protocol

from birdcage.sky.pass_row import PassRow
from birdcage.sky.reach_limits import ReachLimits

FAVOURITES_HOURS, OTHERS_HOURS = 48.0, 24.0
"""How far passes of favourites, and of the other satellites, are searched for."""
MOST_OTHERS = 1000
"""Reach is worked out for that many of the passes of satellites that are no favourites, the next ones first."""


class SearchJob(Protocol):
    """One search from one place: favourites first, then all. Not thread-safe; nothing in it waits."""

    start: datetime
    idle: bool
    """Whether all that was wanted at the last look was found."""

    @property
    def progress(self) -> float | None:
        """How much of the catalogue was searched; None when all of it was."""

    def ends(self) -> datetime:
        """Return up to when passes of all satellites are searched for."""

    def set_limits(self, limits: ReachLimits) -> None:
        """Take other limits: reach is worked out anew, passes stay."""

    def work(self, now: datetime) -> bool:
        """Do one bite, or take in what was found elsewhere; False if there was nothing."""

    def rows(self, now: datetime) -> tuple[PassRow, ...]:
        """Return the rows so far of passes that are not over, in order of AOS."""
