"""A machine that takes a new target in mid-motion: moved whole, and stopped by one just ahead of it (decision 0004)."""

from __future__ import annotations

from typing import TYPE_CHECKING

from birdcage.antenna.motion import DishMotion
from birdcage.antenna.rest import STILL_DEG
from birdcage.antenna.sender import LATE_S
from birdcage.antenna.strategy.strategy import (
    DROPPED,
    LOOK,
    NOTHING_MOVED,
    MotionStrategy,
    StopAction,
    StopPower,
    Unplanned,
)
from birdcage.base.clock import Clock
from birdcage.base.geometry import shortest_turn
from birdcage.rotator.ladder import MoveKind, StopBy, StopMeans, StopOrder
from birdcage.rotator.values import Position

if TYPE_CHECKING:
    from birdcage.antenna.antenna import BirdcageAntenna

PRINTED_DEG = 0.01
"""Angles are printed in hundredths, as far as sources show: two that differ by less may be printed alike."""
CREEPS_DEG_S = 0.5
"""The least speed that readings in coarser numbers must tell from rest."""
AWAY_DEG = 0.15
"""Further from its STOP target than overshoot and print explain, a dish has run past it, and may come back."""
TURNS_S = 0.3
"""Around the moment at which a dish turns round, two readings agree; over so long one between them does not."""

BEHIND = StopAction(
    StopMeans.LOOK,
    "The dish has not confirmed the last line: a bare Enter was sent. Reading where it goes, to aim.",
    StopOrder(StopBy.KNOCK),
)
"""Behind a line that the dish may read later than it goes out, a target that is aimed now may lead it back."""


class Retarget(MotionStrategy):
    """Or by its own STOP command, where its ladder has one."""

    def __init__(self, antenna: BirdcageAntenna) -> None:
        super().__init__(antenna)
        self._seen: tuple[float | None, float | None] = (None, None)
        """The least speeds at which the motion that was last stopped was seen to go."""

    @property
    def _retargets(self) -> bool:
        return any(rung.means is StopMeans.RETARGET for rung in self.rungs(MoveKind.SINGLE))

    @property
    def unplanned(self) -> StopMeans:
        """Whatever stops a planned one: two readings tell where to aim."""
        return self.power(None, 1.0).means

    def power(self, motion: DishMotion | None, rate: float) -> StopPower:
        """Return the first rung that has not failed, and how long braking takes."""
        first = next((rung for rung in self.rungs(MoveKind.SINGLE) if rung.means is not StopMeans.POWER), None)
        if first is None:
            return StopPower(0.0, StopMeans.NONE, proven=True)
        if first.means is StopMeans.WAIT and motion is not None:
            rests_at = motion.eta(rate)
            return StopPower(rests_at - motion.azimuth.started, first.means, first.proven, rests_at)
        return self._power(first.means)

    def at_once(self, unplanned: Unplanned, clock: Clock) -> StopAction:
        """Send its own command, or aim ahead of the motion as it is modelled."""
        antenna = self._antenna
        motion = antenna.motion
        if motion is not None and antenna.moving.rests_until_let_out:
            return DROPPED if unplanned is Unplanned.NONE else LOOK
        if self.commands and (motion is not None or unplanned is not Unplanned.NONE):
            return self.commanded()
        if (motion is not None or unplanned is not Unplanned.NONE) and self._retargets:
            unsure = motion is not None and not antenna.commands.are_sure
            if antenna.rotator.line.unanswered_s() > LATE_S or unsure:
                return BEHIND
        if motion is not None:
            self._seen = motion.azimuth.least_speed_deg_s, motion.elevation.least_speed_deg_s
        if motion is not None and not self._retargets:
            return self._without_retarget(motion, clock)
        order = antenna.stop_aim.order() if self._retargets else None
        if order is not None:
            return StopAction(StopMeans.RETARGET, "A new target just ahead of the dish was sent.", order)
        return NOTHING_MOVED if unplanned is Unplanned.NONE else LOOK

    def _without_retarget(self, motion: DishMotion, clock: Clock) -> StopAction:
        """A new target did not stop it before: what the ladder has above that."""
        means, left_s = self.power(motion, clock.rate).means, max(0.0, motion.eta(clock.rate) - clock.monotonic())
        if means is StopMeans.RELEASE:
            return StopAction(means, "A new target did not stop this dish before: its motors are being released.")
        if means is StopMeans.WAIT:
            return StopAction(
                means, f"This dish takes new targets only at the end of a move: it ends in {left_s:.1f} s."
            )  # fmt: skip
        return StopAction(StopMeans.NONE, "This dish takes new targets only at the end of a move. Cut its power.")

    def on_sight(self, earlier: Position, earlier_at: float, later: Position, later_at: float) -> StopAction:
        """Aim ahead of the motion as it was seen."""
        if self.commands:
            return self.commanded()
        order = self._antenna.stop_aim.order_seen(earlier, earlier_at, later, later_at)
        return StopAction(StopMeans.RETARGET, "The dish was seen moving: retargeted ahead of it.", order)

    def still_s(self, *, slowest: bool) -> float:
        """Return how long an axis takes, at the least speed that may be in force, to be seen elsewhere."""
        model, motion, known = self._antenna.rotator.facts, self._antenna.motion, self._antenna.speeds_deg_s
        axes = model.azimuth, model.elevation
        seen = (None, None) if motion is None else self._seen
        printed_deg = self._antenna.rotator.printed_deg
        # A dish that brakes or turns round is slow for a moment: hundredths show it in that time, whole degrees do not.
        still_s = printed_deg / CREEPS_DEG_S if printed_deg > PRINTED_DEG else 0.0
        for axis, seen_deg_s in zip(axes, seen, strict=True):
            told_deg_s = None if slowest else known.get(axis.index)
            # One step a second is the least that a motor can be set to.
            speed_deg_s = told_deg_s or seen_deg_s or axis.step_deg
            still_s = max(still_s, (STILL_DEG + PRINTED_DEG + axis.step_deg) / speed_deg_s)
        return still_s

    def turns_s(self, dish: Position) -> float:
        """Ask for more where it stands away from its target: one that speeds up slower than modelled comes back."""
        motion = self._antenna.motion
        if motion is None:
            return 0.0
        off_az = abs(shortest_turn(motion.azimuth.slew.end_deg, dish.azimuth))
        off_deg = max(off_az, abs(motion.elevation.slew.end_deg - dish.elevation))
        return TURNS_S if off_deg > AWAY_DEG else 0.0
