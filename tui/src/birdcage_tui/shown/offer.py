"""One pass that a person has picked from a list, for the pursuit desk to plan."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import UTC, datetime
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from birdcage.tracking.plan import Plan

SAME_S = 120.0
"""As near as this two times of TCA are one pass: newer elements may have moved it."""


@dataclass(frozen=True, slots=True)
class Offer:
    """One pass of one satellite."""

    name: str
    norad_id: int
    tca_s: float
    """POSIX seconds."""

    @property
    def text(self) -> str:
        """What the desk is to choose."""
        return str(self.norad_id or self.name)

    @property
    def tca(self) -> datetime:
        """When it is highest: a time within the pass whatever its AOS is computed to be."""
        return datetime.fromtimestamp(self.tca_s, UTC)

    def is_of(self, plan: Plan | None) -> bool:
        """Return whether a plan is for this pass."""
        if plan is None or plan.aim.norad_id != self.norad_id:
            return False
        if plan.passing is None:
            return plan.day is not None and plan.day.always_up  # it has no other pass
        return abs(plan.passing.tca.timestamp() - self.tca_s) < SAME_S
