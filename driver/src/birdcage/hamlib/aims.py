"""Where each axis was sent last: `P` names both, so the one that is to stay is sent where it goes, or stands."""

from __future__ import annotations

from collections.abc import Mapping

STILL_DEG, AWAY_DEG = 0.05, 0.5
BEGINS_S = 3.0
"""An axis that stands still for so long after it was sent, and away from there, does not go there."""


class AxisAims:
    """By the names of the axes. Any thread may forget; one thread does all else."""

    def __init__(self) -> None:
        self._seen: Mapping[str, float] = {}
        self._sent: Mapping[str, float] = {}
        self._sent_at = 0.0

    def forget(self) -> None:
        """Nothing is known any more."""
        self._seen, self._sent = {}, {}

    def forget_sent(self) -> None:
        """An axis may no longer go where it was sent: it is what is seen of it that counts."""
        self._sent = {}

    def knows(self, axis: str) -> bool:
        """Return whether it is known where an axis goes, or stands."""
        return axis in self._sent or axis in self._seen

    def with_(self, to: Mapping[str, float]) -> dict[str, float]:
        """Return where all axes go if some are sent elsewhere."""
        return {**self._seen, **self._sent, **to}

    def sent(self, aims: Mapping[str, float], at: float) -> None:
        """Note that all axes were sent there, at a monotonic time."""
        self._sent, self._sent_at = dict(aims), at

    def see(self, angles: Mapping[str, float], at: float) -> None:
        """Take in where the axes are: one that rests elsewhere was stopped, or sent elsewhere, by somebody else."""
        before, self._seen = self._seen, dict(angles)
        if at < self._sent_at + BEGINS_S:
            return
        self._sent = {
            axis: deg for axis, deg in self._sent.items()
            if abs(angles[axis] - deg) <= AWAY_DEG
            or abs(angles[axis] - before.get(axis, angles[axis] + AWAY_DEG)) > STILL_DEG
        }  # fmt: skip
