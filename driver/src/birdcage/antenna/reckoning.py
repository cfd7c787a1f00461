"""Where a machine is that does not tell at rest: as its last move should have left it, and never more than that.

What it tells while it moves is shown as read. It says nothing of where it stands afterwards, but that it got there:
then the move is over sooner than by its time, or, where the last word came from far away, has failed.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from birdcage.antenna.gate import UNTOLD, MotionGate
from birdcage.antenna.motion import DishMotion, plan_axis
from birdcage.base.errors import MotionRefused, PositionUnknown
from birdcage.base.geometry import shortest_turn
from birdcage.base.reason import Reason
from birdcage.rotator.facts import Facts
from birdcage.rotator.values import Position

FRESH_S = 2.0
"""So long after the last word a machine counts as moving on; by the clock of the wire."""
THERE_DEG = 0.1
"""Told so near to its target it is there, or comes to rest there."""
UNTOLD_DEG_S = 30.0
"""No machine is known to be faster: so far it may have gone between two words, unseen."""
SHORT_DEG = 0.5


@dataclass(frozen=True, slots=True)
class ToldPosition:
    """Where it was by its own word, while it moved."""

    position: Position
    at: float
    """Monotonic seconds."""


class Reckoning:
    """Of one machine that reports no position at rest (`docs/decisions/0043-a-dish-that-does-not-tell.md`)."""

    def __init__(self) -> None:
        self._position: Position | None = None
        self._told: ToldPosition | None = None
        self._told_before: ToldPosition | None = None
        self.word: ToldPosition | None = None
        """The word of the machine itself that `at` gave last; None where that was reckoned."""
        self.since = -math.inf
        """Since when it should stand there; monotonic seconds."""
        self.moves_until = -math.inf
        """Until when it may still be on its way."""

    def begin(self, motion: DishMotion, rate: float) -> None:
        """A move has gone out."""
        self._position, self.moves_until = None, motion.over_by(rate)
        self._told = self._told_before = None

    def hear(self, position: Position, now: float) -> ToldPosition:
        """Take in where it was while it moved, told unasked."""
        self._told_before, self._told = self._told, ToldPosition(position, now)
        return self._told

    def told_in(self, motion: DishMotion) -> ToldPosition | None:
        """Return its last word since a motion began."""
        told = self._told
        return None if told is None or told.at < max(axis.started for axis in motion.axes) else told

    def tells_of_motion(self, now: float) -> bool:
        """Return whether it told a moment ago that it moves, though every move that was sent is over."""
        told = self._told
        return told is not None and told.at > self.moves_until and now < told.at + FRESH_S

    def over_by(self, motion: DishMotion, rate: float) -> float:
        """Return when a motion is over at the latest: from where it was told to be last, and in turn."""
        told, latest = self.told_in(motion), motion.over_by(rate)
        if told is None or any(axis.longest_s > axis.slew.duration_s for axis in motion.axes):
            return latest
        (az_deg, el_deg), here = motion.rest, told.position
        azimuth = plan_axis(motion.azimuth.axis, here.azimuth, az_deg)
        elevation = plan_axis(motion.elevation.axis, here.elevation, el_deg)
        return min(latest, told.at + (azimuth.duration_s + elevation.duration_s) / rate)

    def is_there(self, motion: DishMotion) -> bool:
        """Return whether it was told that it is at the target of a motion."""
        told = self.told_in(motion)
        return told is not None and apart_deg(told.position, Position(*motion.rest)) <= THERE_DEG

    def fell_short(self, motion: DishMotion) -> bool:
        """Return whether its last two words were of somewhere else than a motion leads, too far to have got there."""
        told, before = self.told_in(motion), self._told_before
        if told is None or before is None:
            return False
        unseen_deg = 2.0 * apart_deg(before.position, told.position) + UNTOLD_DEG_S * (told.at - before.at)
        return apart_deg(told.position, Position(*motion.rest)) > SHORT_DEG + unseen_deg

    def end(self, now: float) -> None:
        """A move is over, by its time or by its word."""
        self.moves_until = min(self.moves_until, now)

    def abandon(self, motion: DishMotion, now: float, rate: float) -> None:
        """Something may have ended the move on its way, or not."""
        self._position, self.moves_until = None, max(now, self.over_by(motion, rate))

    def tell(self, gate: MotionGate, motion: DishMotion | None, now: float, rate: float) -> Position:
        """Tell the gate where it should be, and return that; see `at`."""
        if gate.position is None and motion is None:
            self._position = None  # whatever made it doubtful
        try:
            dish = self.at(motion, now, rate)
        except PositionUnknown as unknown:
            gate.forget(unknown.reason)
            raise
        gate.see(dish)
        return dish

    def at(self, motion: DishMotion | None, now: float, rate: float) -> Position:
        """Return where it should be. PositionUnknown (`untold`) where no move that is over by its time says so.

        On its way, and where that has failed: where it was told to be.
        """
        self.word, told = None, None if motion is None else self.told_in(motion)
        if motion is not None and told is not None:
            if not self.is_there(motion) and (now < told.at + FRESH_S or self.fell_short(motion)):
                self.word = told
                return told.position
            self._position, self.since = Position(*motion.rest), now
        elif motion is not None:
            if now < motion.eta(rate) and not motion.start_known:
                raise self._untold("its first move is not over yet")
            self._position, self.since = motion.at(now, rate), now
        if self._position is None:
            raise self._untold("it was not sent anywhere yet, or was stopped on its way")
        return self._position

    def refuse_on_its_way(self, now: float) -> None:
        """Raise MotionRefused (`moving`) while a move that was given up may last: what another does then is unknown."""
        if now < self.moves_until:
            raise MotionRefused(
                f"The dish may still be on its way for {self.moves_until - now:.0f} s, and does not tell. Nothing was "
                "sent: wait until then.",
                reason=Reason.MOVING,
            )

    @staticmethod
    def _untold(why: str) -> PositionUnknown:
        return PositionUnknown(f"This dish does not tell where it points, and {why}.", reason=UNTOLD)


def apart_deg(one: Position, other: Position) -> float:
    """Return the larger of the axes' differences, azimuth the short way round."""
    return max(abs(shortest_turn(one.azimuth, other.azimuth)), abs(one.elevation - other.elevation))


def farthest(facts: Facts, az_deg: float, el_deg: float) -> Position:
    """Return from where the way to dish angles is the longest: what a first move is timed from."""

    def end(low_deg: float, high_deg: float, deg: float) -> float:
        return low_deg if deg - low_deg >= high_deg - deg else high_deg

    if facts.mapping is not None:
        there = facts.mapping.to_axes(az_deg, el_deg)[0]
        own = {axis.name: axis for axis in facts.axes if axis.name in there}
        ends = {name: end(own[name].min_deg, own[name].max_deg, deg) for name, deg in there.items()}
        return Position(*facts.mapping.to_sky(ends))
    azimuth, elevation = facts.azimuth, facts.elevation
    return Position(end(azimuth.min_deg, azimuth.max_deg, az_deg), end(elevation.min_deg, elevation.max_deg, el_deg))
