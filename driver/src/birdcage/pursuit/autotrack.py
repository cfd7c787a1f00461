"""Autotrack: whether it is on, and what it wants followed now."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import datetime, timedelta
from typing import TYPE_CHECKING

from birdcage.pursuit.follower import IN_MID_PASS
from birdcage.pursuit.now import Scheduled
from birdcage.pursuit.schedule_model import KeptPass
from birdcage.pursuit.timetable import Timetable
from birdcage.station.pursuit_state import Phase, Pursuit

if TYPE_CHECKING:
    from collections.abc import Sequence

    from birdcage.pursuit.circumstances import Circumstances
    from birdcage.sky.catalogue import CatalogueEntry

AGAIN_S = 15.0
"""A pass that was not taken on is asked for again after so many monotonic seconds."""
PARKS_FIRST = timedelta(minutes=3)
"""With more time than this until the next pass the dish goes to its park direction before that is asked for."""
ENDS = IN_MID_PASS | {Phase.COUNTDOWN, Phase.PARKING}
"""Phases after the end of a pass, until it is parked: the countdown is to the motion to the park direction then."""
BEGUN = IN_MID_PASS | {Phase.COUNTDOWN, Phase.PREPOSITIONING, Phase.READY}


@dataclass(slots=True)
class Autotrack:
    """For the desk's thread alone."""

    timetable: Timetable
    on: bool = False
    just_on: bool = False
    """Whether a person has switched it on and nothing was followed since: they have just asked for the first pass."""
    row: Scheduled | None = None
    """The pass that it has asked for last."""
    tried_at: float = float("-inf")

    def switch(self, on: bool) -> None:
        """Switch it."""
        self.on = self.just_on = on
        self.row, self.tried_at = None, float("-inf")

    def refresh(self, favourites: Sequence[CatalogueEntry], at: Circumstances, live: Pursuit | None) -> bool:
        """Keep the timetable; return whether it shows anything else."""
        return self.timetable.refresh(favourites, at, self._present(live))

    def wants(self, now: datetime, monotonic: float, live: Pursuit | None, *, of_person: bool) -> Scheduled | None:
        """Return the pass that is to be asked for now; None for none.

        `live` is what is being followed, `of_person` whether somebody chose that by hand: it stays then.
        """
        row = self.timetable.next(now)
        if not self.on or row is None or (live is not None and of_person):
            return None
        if live is not None and self.row is not None and row.is_same_pass(self.row):
            return None
        if live is not None and live.phase in BEGUN and self.row is not None and now < self.row.reach_end:
            return None  # what has begun is followed to its end
        if live is not None and live.phase in ENDS and row.reach_start - now > PARKS_FIRST:
            return None  # it parks first, as after a pass that a person has chosen
        if self.row is not None and row.is_same_pass(self.row) and monotonic < self.tried_at + AGAIN_S:
            return None
        return row

    def asked_for(self, row: Scheduled, monotonic: float) -> None:
        """Note that a pass was asked for."""
        self.row, self.tried_at, self.just_on = row, monotonic, False

    def _present(self, live: Pursuit | None) -> KeptPass | None:
        if not self.on or self.row is None or live is None:
            return None
        return KeptPass(self.row, following=live.phase in BEGUN)
