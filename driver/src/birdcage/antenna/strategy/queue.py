"""A machine that moves one thing at a time: moved leg by leg, and stopped between them (decision 0011)."""

from __future__ import annotations

from contextlib import suppress

from birdcage.antenna.motion import DishMotion, longest_s
from birdcage.antenna.strategy.strategy import (
    DROPPED,
    GRACE_S,
    LOOK,
    NOTHING_MOVED,
    MotionStrategy,
    StopAction,
    StopPower,
    Unplanned,
)
from birdcage.base.clock import Clock
from birdcage.base.errors import CommandRefused
from birdcage.rotator.facts import SecondMove
from birdcage.rotator.ladder import StopBy, StopMeans, StopOrder
from birdcage.rotator.values import Position

STILL_S = 0.3
"""On a dish that speeds up slowly, readings in shorter order agree in mid-move too."""
ENTER = StopOrder(StopBy.ABORT)


class Queue(MotionStrategy):
    """It takes a second move, and goes there after the first. A byte ends a combined move; a single one ends itself.

    An unplanned motion is its TV search, or a slew of somebody else's: a byte, and then the search is ended.
    """

    one_at_a_time = True

    @property
    def unplanned(self) -> StopMeans:
        """It ends by itself, and nothing follows it."""
        return StopMeans.COMMAND if self.commands else StopMeans.WAIT

    def power(self, motion: DishMotion | None, rate: float) -> StopPower:
        """Return braking, or the end of the move under way."""
        if motion is None:
            first = self._antenna.model.stop_ladder[0].means
            return self._power(first)
        if self.commands or motion.silent:
            return self._power(StopMeans.COMMAND if self.commands else StopMeans.ABORT)
        rests_at = motion.eta(rate)
        return StopPower(rests_at - motion.azimuth.started, StopMeans.WAIT, True, rests_at)

    def at_once(self, unplanned: Unplanned, clock: Clock) -> StopAction:
        """Send a byte wherever it may do good: it moves nothing."""
        motion = self._antenna.motion
        if motion is not None and self._antenna.is_kept:
            return DROPPED
        if self.commands and (motion is not None or unplanned is not Unplanned.NONE):
            return self._commanded()
        if motion is not None and motion.silent:
            return StopAction(StopMeans.ABORT, "A byte that ends the slew was sent.", ENTER)
        if motion is not None:
            return StopAction(
                StopMeans.WAIT,
                f"A move of one axis can't be recalled: it ends in {self._left_s(motion, clock):.1f} s, and nothing "
                "follows it.",
            )
        match unplanned:
            case Unplanned.SEEN:
                return StopAction(
                    StopMeans.SEARCH, "A bare Enter was sent, and the TV search is being ended.", ENTER
                )  # fmt: skip
            case Unplanned.UNKNOWN:
                return StopAction(
                    StopMeans.LOOK,
                    "A bare Enter was sent: it ends a combined move. Looking where the dish goes.", ENTER,
                )  # fmt: skip
            case Unplanned.NONE:
                return NOTHING_MOVED

    @staticmethod
    def _left_s(motion: DishMotion, clock: Clock) -> float:
        return max(0.0, motion.eta(clock.rate) - clock.monotonic())

    def on_sight(self, earlier: Position, earlier_at: float, later: Position, later_at: float) -> StopAction:  # noqa: ARG002
        """End whatever it is."""
        if self.commands:
            return self._commanded()
        return StopAction(
            StopMeans.SEARCH, "The dish was seen moving: a bare Enter was sent, and the TV search is ended.", ENTER
        )

    def answered(self, means: StopMeans) -> None:
        """Take note of how the slew ended."""
        if means is StopMeans.ABORT:
            with suppress(CommandRefused):  # it has ended in either case
                self._antenna.rotator.slew_is_over()

    def still_s(self, *, slowest: bool) -> float:  # noqa: ARG002
        """Return a time in which a dish that goes is seen to: its speeds can't be set."""
        return STILL_S

    def lasts_s(self, means: StopMeans, clock: Clock) -> float:
        """Return the stopping power, or what is left of the move, and some grace."""
        motion = self._antenna.motion
        if means is StopMeans.WAIT and motion is not None:
            return self._left_s(motion, clock) * clock.rate + GRACE_S
        return super().lasts_s(means, clock)

    def is_there(self, clock: Clock) -> bool:
        """Give the move of one axis its time: it may hardly have begun."""
        motion = self._antenna.motion
        if motion is None or motion.silent:
            return True
        return clock.monotonic() >= motion.eta(clock.rate)


class Block(Queue):
    """It takes no command of a move before the motor stands: nothing stops a move, and none follows it."""

    answers_in_motion = False

    @property
    def looks_wait(self) -> bool:
        """Where the very axis that runs makes it wait."""
        return self._antenna.model.second_same is SecondMove.BLOCK

    @property
    def anywhere(self) -> bool:
        """It reads nothing in mid-move."""
        return False

    def at_once(self, unplanned: Unplanned, clock: Clock) -> StopAction:
        """Send nothing: what is sent now would move the dish once it stands."""
        motion = self._antenna.motion
        if motion is not None and self._antenna.is_kept:
            return DROPPED
        if motion is None:
            return NOTHING_MOVED if unplanned is Unplanned.NONE else LOOK
        return StopAction(
            StopMeans.WAIT,
            f"This dish takes no command before its motor rests: the move ends in {self._left_s(motion, clock):.1f} s, "
            "and nothing follows it. To stop it sooner, cut its power.",
        )

    def on_sight(self, earlier: Position, earlier_at: float, later: Position, later_at: float) -> StopAction:  # noqa: ARG002
        """Send nothing, as above."""
        return StopAction(
            StopMeans.WAIT,
            "The dish was seen moving, and takes no command before its motor rests. To stop it sooner, cut its power.",
        )

    def answered(self, means: StopMeans) -> None:
        """Nothing was sent."""

    def lasts_s(self, means: StopMeans, clock: Clock) -> float:
        """Return what is left of the move; of one that this program did not send, the longest that there is."""
        if means is StopMeans.WAIT and self._antenna.motion is None:
            return longest_s(self._antenna.model) + GRACE_S
        return super().lasts_s(means, clock)
