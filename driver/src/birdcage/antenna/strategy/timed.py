"""A machine that does not tell where it stands: moved leg by leg, and taken to be there by time (decision 0043)."""

from __future__ import annotations

from contextlib import suppress

from birdcage.antenna.gate import UNTOLD
from birdcage.antenna.motion import AxisMotion, DishMotion
from birdcage.antenna.strategy.queue import ENTER, Queue
from birdcage.antenna.strategy.strategy import StopAction, StopPower, Unplanned
from birdcage.base.clock import Clock
from birdcage.base.errors import NoReply
from birdcage.rotator.ladder import MoveKind, StopBy, StopMeans, StopOrder

SOON_S = 5.0
UNPROVEN = "It does not tell whether it has stopped."


class Timed(Queue):
    """The only one whose position at rest is modelled. What is sent to stop it may help, and is never confirmed."""

    reads_position = False
    unseen = "This dish does not tell whether it has stopped. If it moves, cut its power."

    @property
    def one_at_a_time(self) -> bool:  # type: ignore[override]
        """By what is known of it now: it may tell when it is met."""
        return self._antenna.model.moves_in_turn

    @property
    def unplanned(self) -> StopMeans:
        """What is proven to end it, though nothing tells that it did."""
        can = (StopMeans.COMMAND, StopMeans.ABORT)
        rungs = self.rungs(MoveKind.COMBINED) + self.rungs(MoveKind.SINGLE)
        return next((rung.means for rung in rungs if rung.proven and rung.means in can), StopMeans.NONE)

    def power(self, motion: DishMotion | None, rate: float) -> StopPower:
        """Return what is proven to stop it, if anything is."""
        means = self.unplanned
        if means is StopMeans.NONE:
            ends_at = None if motion is None else self._antenna.reckoning.over_by(motion, rate)
            return StopPower(0.0, means, proven=True, rests_at=ends_at)
        return self._power(means)

    def at_once(self, unplanned: Unplanned, clock: Clock) -> StopAction:  # noqa: ARG002 - nothing shows one
        """Send what its ladder has; a byte moves nothing even where it is not proven to help."""
        antenna = self._antenna
        motion, now = antenna.motion, clock.monotonic()
        if motion is not None and antenna.moving.is_kept:
            return StopAction(StopMeans.NOTHING_MOVED, "The move was not sent yet, and is dropped.")
        until = antenna.reckoning.moves_until if motion is None else antenna.reckoning.over_by(motion, clock.rate)
        means, (said, order) = self.unplanned, self._sent()
        if until <= now and antenna.reckoning.tells_of_motion(now):
            return StopAction(
                means, f"The dish says that it moves, and nothing sent it. {said} If it goes on, cut its power.", order
            )  # fmt: skip
        if until <= now:
            rests = "By its time no move is under way, and this dish does not tell."
            done = means if means.is_sent else StopMeans.NOTHING_MOVED
            return StopAction(done, rests if order is None else f"{rests} {said}", order)
        goes_on = "Its move" if order is None else "If it goes on, it"
        ends = f"ends within {until - now:.0f} s. To stop it sooner, cut its power."
        return StopAction(means, f"{said} {goes_on} {ends}", order)

    def _sent(self) -> tuple[str, StopOrder | None]:
        """Return what is sent to stop it, wherever it may do good, and a sentence: somebody else may have sent it."""
        match self.unplanned:
            case StopMeans.COMMAND:
                return f"Its own STOP command was sent. {UNPROVEN}", StopOrder(StopBy.COMMAND)
            case StopMeans.ABORT:
                return f"What ends a combined move was sent. {UNPROVEN}", ENTER
        if any(rung.means is StopMeans.ABORT for rung in self.rungs(MoveKind.COMBINED)):
            return "No STOP is known for this dish. A bare Enter was sent, which stops relatives of it.", ENTER
        return "No STOP is known for this dish.", None

    def answered(self, means: StopMeans) -> None:
        """Nothing else is to be done."""

    @staticmethod
    def _off_model_deg(axis: AxisMotion, now: float, rate: float) -> float:
        """It is modelled as slow as such machines are: it may be there already."""
        return abs(axis.slew.end_deg - axis.modelled(now, rate)[0])

    def ends_soon(self, clock: Clock) -> bool:
        """Return whether it does: where it stands is known only then."""
        motion = self._antenna.motion
        return motion is None or (motion.start_known and motion.eta(clock.rate) - clock.monotonic() <= SOON_S)

    def end_motion(self, clock: Clock) -> None:
        """Stop it as far as that can be done: where it stands is not known then."""
        with suppress(NoReply):
            super().end_motion(clock)
        self.lose_track(clock)

    def lose_track(self, clock: Clock) -> None:
        """Whether its motion goes on, and where it ends, nothing will tell: only until when it may last is known."""
        antenna = self._antenna
        if antenna.motion is not None:
            antenna.reckoning.abandon(antenna.motion, clock.monotonic(), clock.rate)
            antenna.moving.forget()
            antenna.gate.forget(UNTOLD)
