"""A horizon that a map proposes, while a person accepts its points one by one."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from birdcage.skymap.horizon_lesson import HorizonEdge


@dataclass(frozen=True, slots=True)
class MapOffer:
    """Of one map."""

    key: str
    """Of the map."""
    points: tuple[HorizonEdge, ...]
    accepted: frozenset[int] = frozenset()
    at: int = 0
    """The point that the cursor is on."""

    @property
    def point(self) -> HorizonEdge:
        """The one under the cursor."""
        return self.points[self.at]

    def moved(self, step: int) -> MapOffer:
        """Return it with the cursor so many points further, and at the end no further."""
        return replace(self, at=min(max(self.at + step, 0), len(self.points) - 1))

    def toggled(self) -> MapOffer:
        """Accept the point under the cursor, or take that back, and go to the next."""
        return replace(self, accepted=self.accepted ^ {self.at}).moved(1)

    def all_toggled(self) -> MapOffer:
        """Accept every point, or none where all are accepted."""
        every = frozenset(range(len(self.points)))
        return replace(self, accepted=frozenset() if self.accepted == every else every)

    @property
    def count(self) -> str:
        """How many are accepted: `3 of 12 accepted`."""
        return f"{len(self.accepted)} of {len(self.points)} accepted"

    def words(self) -> tuple[str, ...]:
        """What the point under the cursor says, in parts from the most important on."""
        point = self.point
        sure = "clear down to here" if point.is_clear else f"blocked up to here, ±{point.sigma_deg:.1f}°"
        mark = "accepted" if self.at in self.accepted else "not accepted"
        return (
            f"point {self.at + 1} of {len(self.points)}", f"az {point.az_deg:.1f}° el {point.el_deg:.1f}°", mark, sure,
        )  # fmt: skip


HEADS = (
    "Horizon proposed. Arrows choose a point, a accepts it, A all, Enter keeps {}, q discards",
    "Horizon: a accepts, A all, Enter keeps {}, q discards",
    "a accepts, Enter keeps {}",
)
"""What the keys do, the longest first; with how many are accepted."""
AWAY = ("Horizon proposed, {} accepted. i returns to it", "Horizon proposed: i returns to it", "i: horizon")
"""How to get back to it, while the map does not have the focus: arrows step the dish then."""
RELEASES = ("Horizon proposed. Enter {} first, and keeps nothing yet", "Horizon: Enter {} first", "Enter {}")
"""What Enter does in place of keeping it: release, acknowledge or accept, as row 1 says."""
