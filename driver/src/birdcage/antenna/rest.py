"""Whether a dish stands still, by its last two readings."""

from __future__ import annotations

from birdcage.base.geometry import shortest_turn
from birdcage.rotator.values import Position

STILL_DEG = 0.015
"""Two readings this close, one poll apart, are a dish at rest: both axes print hundredths."""
APART_S = 0.09
"""Two readings closer together than this do not tell a dish at rest from one that moves."""


class RestWatch:
    """Takes readings in the dish's own frame."""

    def __init__(self) -> None:
        self._last: tuple[Position, float] | None = None
        self.rests = False
        """Whether the last two readings that were far enough apart agree."""

    def see(self, position: Position, at: float) -> None:
        """Take in a reading, made at monotonic seconds."""
        before, self._last = self._last, (position, at)
        if before is not None and at - before[1] >= APART_S:
            off_az = abs(shortest_turn(before[0].azimuth, position.azimuth))
            self.rests = max(off_az, abs(before[0].elevation - position.elevation)) <= STILL_DEG
