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
from birdcage.rotator.ladder import MoveKind, Rung, StopBy, StopMeans, StopOrder
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
        kinds = (MoveKind.COMBINED, MoveKind.SINGLE) if motion is None else (self.kind,)
        ladder = (rung.means for kind in kinds for rung in self.rungs(kind) if rung.means is not StopMeans.POWER)
        first = next(ladder, StopMeans.WAIT)
        if motion is None or first in (StopMeans.COMMAND, StopMeans.ABORT):
            return self._power(first)
        rests_at = motion.eta(rate)
        return StopPower(rests_at - motion.azimuth.started, StopMeans.WAIT, True, rests_at)

    def at_once(self, unplanned: Unplanned, clock: Clock) -> StopAction:
        """Send a byte wherever it may do good: it moves nothing."""
        motion = self._antenna.motion
        if motion is not None and self._antenna.moving.is_kept:
            return DROPPED
        if self.commands and (motion is not None or unplanned is not Unplanned.NONE):
            return self.commanded()
        if motion is not None and motion.silent and self._abort is not None:
            if StopMeans.ABORT not in self.failed:
                return StopAction(StopMeans.ABORT, f"A byte that {self._ends} the slew was sent.", ENTER)
            return StopAction(
                StopMeans.WAIT,
                f"A byte was sent, which did not end a slew before. It ends in {self._left_s(motion, clock):.1f} s; "
                "nothing follows it. To stop it sooner, cut its power.", ENTER,
            )  # fmt: skip
        if motion is not None:
            what = "This move" if motion.silent else "A move of one axis"
            return StopAction(
                StopMeans.WAIT,
                f"{what} can't be recalled: it ends in {self._left_s(motion, clock):.1f} s, and nothing follows it.",
            )
        match unplanned:
            case Unplanned.SEEN:
                return self._unplanned_ended(f"A bare Enter was sent, and {self._search_ends}.")
            case Unplanned.UNKNOWN if self._abort is None:
                return LOOK
            case Unplanned.UNKNOWN:
                return StopAction(
                    StopMeans.LOOK,
                    f"A bare Enter was sent: it {self._ends} a combined move. Looking where the dish goes.", ENTER,
                )  # fmt: skip
            case Unplanned.NONE:
                return NOTHING_MOVED

    @property
    def _abort(self) -> Rung | None:
        return next((rung for rung in self._antenna.model.stop_ladder if rung.means is StopMeans.ABORT), None)

    @property
    def _ends(self) -> str:
        """How sure it is that the byte ends a slew."""
        rung = self._abort
        sure = rung is not None and (rung.proven or self.proven is StopMeans.ABORT)
        return "ends" if sure else "should end"

    @property
    def _search_ends(self) -> str:
        """What becomes of a TV search, as sure as that is."""
        sure = self._antenna.model.ends_search
        return "the TV search is being ended" if sure else "the line that may end a TV search follows"

    def _unplanned_ended(self, search: str) -> StopAction:
        """Return what ends a motion that was seen; `search` is what is said of a machine that may search."""
        rung = self._abort
        if rung is None:
            return StopAction(
                StopMeans.WAIT, "The dish was seen moving, and nothing is known to stop it. Cut its power."
            )  # fmt: skip
        if MoveKind.SEARCH in rung.ends:
            return StopAction(StopMeans.SEARCH, search, ENTER)
        return StopAction(rung.means, f"The dish was seen moving: a byte that {self._ends} a slew was sent.", ENTER)

    @staticmethod
    def _left_s(motion: DishMotion, clock: Clock) -> float:
        return max(0.0, motion.eta(clock.rate) - clock.monotonic())

    def on_sight(self, earlier: Position, earlier_at: float, later: Position, later_at: float) -> StopAction:  # noqa: ARG002
        """End whatever it is."""
        if self.commands:
            return self.commanded()
        return self._unplanned_ended(f"The dish was seen moving: a bare Enter was sent, and {self._search_ends}.")

    def answered(self, means: StopMeans) -> None:
        """Take note of how the slew ended."""
        if means is StopMeans.ABORT:
            with suppress(CommandRefused):  # it has ended in either case
                self._antenna.rotator.slew_is_over()

    def still_s(self, *, slowest: bool) -> float:  # noqa: ARG002
        """Return a time in which a dish that goes is seen to: its speeds can't be set."""
        return STILL_S

    def lasts_s(self, means: StopMeans, clock: Clock) -> float:
        """Return the stopping power, or what is left of the move, and some grace.

        Of a move that this program did not send, the longest that there is.
        """
        motion = self._antenna.motion
        if means is not StopMeans.WAIT:
            return super().lasts_s(means, clock)
        left_s = longest_s(self._antenna.model) if motion is None else self._left_s(motion, clock) * clock.rate
        return left_s + GRACE_S

    def is_there(self, clock: Clock) -> bool:
        """Give the move of one axis its time: it may hardly have begun."""
        motion = self._antenna.motion
        if motion is None or motion.silent or self.commands:
            return True
        return clock.monotonic() >= motion.eta(clock.rate)


class Block(Queue):
    """It takes no command of a move before the motor stands: none of one axis is stopped by another, or followed by it.

    Its own STOP command, and a byte that ends a silent slew, are no commands of moves.
    """

    answers_in_motion = False

    @property
    def looks_wait(self) -> bool:
        """Where the very axis that runs makes it wait."""
        return self._antenna.model.second_same is SecondMove.BLOCK

    @property
    def anywhere(self) -> bool:
        """It reads nothing in mid-move, but for its own STOP command."""
        return self.commands and super().anywhere

    def at_once(self, unplanned: Unplanned, clock: Clock) -> StopAction:
        """Send no new target: it would move the dish once it stands."""
        motion = self._antenna.motion
        if self.commands or (motion is not None and (motion.silent or self._antenna.moving.is_kept)):
            return super().at_once(unplanned, clock)
        if motion is None:
            return NOTHING_MOVED if unplanned is Unplanned.NONE else LOOK
        return StopAction(
            StopMeans.WAIT,
            f"This dish takes no command before its motor rests: the move ends in {self._left_s(motion, clock):.1f} s, "
            "and nothing follows it. To stop it sooner, cut its power.",
        )

    def on_sight(self, earlier: Position, earlier_at: float, later: Position, later_at: float) -> StopAction:
        """As above."""
        if self.commands:
            return super().on_sight(earlier, earlier_at, later, later_at)
        return StopAction(
            StopMeans.WAIT,
            "The dish was seen moving, and takes no command before its motor rests. To stop it sooner, cut its power.",
        )
