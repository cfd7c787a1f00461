"""Where each axis was sent last: `P` names both, so the one that is to stay is sent where it goes, or stands."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

from birdcage.base.geometry import shortest_turn

STILL_DEG, AWAY_DEG = 0.05, 0.5
SAME_DEG = 0.005
"""Less than what is sent can say."""
BEGINS_S = 3.0
"""An axis that stands still for so long after it was sent, and away from there, does not go there."""


@dataclass(frozen=True, slots=True)
class KnownAims:
    """What is known, in one piece; nothing once `AxisAims.forget` was called since."""

    era: int
    seen: Mapping[str, float] = field(default_factory=dict)
    sent: Mapping[str, float] = field(default_factory=dict)
    sent_at: float = 0.0


class AxisAims:
    """By the names of the axes. Any thread may forget, also in the midst of all else, which one thread does."""

    def __init__(self) -> None:
        self.era = 0
        """How often all was forgotten."""
        self._known = KnownAims(self.era)

    @property
    def known(self) -> KnownAims:
        """What is known at this moment."""
        known = self._known
        return known if known.era == self.era else KnownAims(self.era)

    def forget(self) -> None:
        """Nothing is known any more: an axis may no longer go where it was sent, and what was seen of it is old."""
        self.era += 1

    def knows(self, axis: str) -> bool:
        """Return whether it is known where an axis goes, or stands."""
        known = self.known
        return axis in known.sent or axis in known.seen

    def with_(self, to: Mapping[str, float], *, circle: bool) -> dict[str, float]:
        """Return where all axes go if some are sent elsewhere.

        `circle`: whether a whole turn off is the same place; an axis that is sent where it is then stays on its turn.
        """
        known = self.known
        aims = {**known.seen, **known.sent}
        if circle:
            to = {axis: aims[axis] if axis in aims and abs(shortest_turn(aims[axis], deg)) < SAME_DEG else deg
                  for axis, deg in to.items()}  # fmt: skip
        return {**aims, **to}

    def sent(self, aims: Mapping[str, float], at: float) -> None:
        """Note that all axes are sent there, at a monotonic time: before they are, so that STOP makes it void."""
        self._known = replace(self.known, sent=dict(aims), sent_at=at)

    def back_to(self, known: KnownAims) -> None:
        """Take back what was noted since: the server has refused it."""
        self._known = known

    def see(self, angles: Mapping[str, float], at: float, era: int, *, circle: bool) -> None:
        """Take in where the axes are: one that rests elsewhere was stopped, or sent elsewhere, by somebody else.

        `era`: that in which it was asked for. `circle`: whether a whole turn off is the same place.
        """
        known = self.known
        if era != known.era:
            return

        def off(axis: str, deg: float) -> float:
            return abs(shortest_turn(deg, angles[axis]) if circle else angles[axis] - deg)

        sent = known.sent
        if at >= known.sent_at + BEGINS_S:
            sent = {
                axis: deg for axis, deg in sent.items()
                if off(axis, deg) <= AWAY_DEG or axis not in known.seen or off(axis, known.seen[axis]) > STILL_DEG
            }  # fmt: skip
        self._known = replace(known, seen=dict(angles), sent=sent)
