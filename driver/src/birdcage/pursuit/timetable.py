"""Autotrack's plan for the hours to come: the passes of the favourites, and which of them are followed."""

from __future__ import annotations

from datetime import datetime, timedelta
from typing import TYPE_CHECKING

from birdcage.pursuit.circumstances import Circumstances
from birdcage.pursuit.now import Scheduled

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

    from birdcage.pursuit.schedule_model import KeptPass, ScheduleCandidate
    from birdcage.sky.catalogue import CatalogueEntry

FIND_EVERY = timedelta(minutes=30)
CHOOSE_EVERY = timedelta(minutes=1)


class Timetable:
    """For the desk's thread alone."""

    def __init__(self, downlinks: Path | None = None) -> None:
        self._downlinks = downlinks
        self.rows: tuple[Scheduled, ...] = ()
        """In order of time: those that are kept, and those that are not."""
        self._candidates: Sequence[ScheduleCandidate] = ()
        self._key: tuple[object, ...] | None = None
        self._found_at: datetime | None = None
        self._chosen_at: datetime | None = None

    def refresh(self, favourites: Sequence[CatalogueEntry], at: Circumstances, present: KeptPass | None) -> bool:
        """Look for passes and choose among them where that is due; return whether there are other rows."""
        from birdcage.pursuit.schedule import schedule
        from birdcage.pursuit.schedule_candidates import find_candidates, slewing
        from birdcage.sky.watch_source import Watched

        limits, rules = at.mount.limits, at.settings.autotrack
        key = (tuple((each.elements, each.priority, each.time_offset_s) for each in favourites), at.observer,
               limits, rules)  # fmt: skip
        if key != self._key or not _fresh(self._found_at, at.now, FIND_EVERY):
            self._candidates = find_candidates(
                Watched.of(favourites), at.observer, limits, at.now, rules.hours, self._downlinks
            )
            self._key, self._found_at, self._chosen_at = key, at.now, None
        if _fresh(self._chosen_at, at.now, CHOOSE_EVERY):
            return False
        self._chosen_at, before = at.now, self.rows
        self.rows = schedule(self._candidates, rules, slewing(limits), at.now, present)
        return self.rows != before

    def choose_again(self) -> None:
        """Let the choice be made anew: something was begun or ended."""
        self._chosen_at = None

    def next(self, now: datetime) -> Scheduled | None:
        """Return the pass that is to be followed now, or comes next."""
        return next((row for row in self.rows if row.kept and row.reach_end > now), None)


def _fresh(then: datetime | None, now: datetime, lasts: timedelta) -> bool:
    return then is not None and timedelta() <= now - then < lasts
