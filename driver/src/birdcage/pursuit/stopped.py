"""What STOP or a hand has ended or interrupted, and could be taken up again at once, autotrack included."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import datetime
from typing import TYPE_CHECKING

from birdcage.pursuit.follower import told_reach_end
from birdcage.pursuit.now import Resumable
from birdcage.station.pursuit_state import Phase, Pursuit

if TYPE_CHECKING:
    from birdcage.pursuit.chosen_target import ChosenTarget
    from birdcage.pursuit.now import Scheduled
    from birdcage.tracking.plan import Plan

ASIDE = frozenset({Phase.YIELDED, Phase.INTERRUPTED})
"""Phases in which the dish rests, or is in other hands, until somebody asks for the pass again."""


@dataclass(slots=True)
class StoppedPursuit:
    """For the desk's thread alone."""

    choice: ChosenTarget | None = None
    plan: Plan | None = None
    autotrack: bool = False
    """Whether STOP has switched autotrack off."""
    row: Scheduled | None = None
    """The pass that autotrack had asked for."""

    def by_stop(self, choice: ChosenTarget, plan: Plan) -> None:
        """Note what STOP has ended."""
        self.choice, self.plan = choice, plan

    def autotrack_off(self, row: Scheduled | None) -> None:
        """Note that STOP has switched autotrack off."""
        self.autotrack, self.row = True, row

    def forget(self) -> None:
        """Forget it: something else is done now."""
        self.choice, self.plan, self.autotrack, self.row = None, None, False, None

    def shown(self, now: datetime, live: Pursuit | None, *, autotrack: bool) -> Resumable | None:
        """Return what could be taken up again; None while something is followed, and once its pass is over."""
        if live is not None:
            return self._of(live.plan, now, autotrack) if live.phase in ASIDE else None
        if self.plan is not None:
            found = self._of(self.plan, now, self.autotrack)
            if found is None:
                self.choice = self.plan = None
            else:
                return found
        return Resumable("autotrack", None, None, autotrack=True) if self.autotrack else None

    @staticmethod
    def _of(plan: Plan, now: datetime, autotrack: bool) -> Resumable | None:
        end = told_reach_end(plan)
        if not plan.legs or (end is not None and end <= now):
            return None
        return Resumable(plan.aim.name, plan, end, autotrack=autotrack)
