"""How STOP gets a grip on a dish: by a new target ahead of it, or by a byte that ends its slew (SEAMS *STOP*)."""

from __future__ import annotations

from abc import ABC, abstractmethod
from contextlib import suppress
from dataclasses import dataclass

from birdcage.antenna.antenna import BirdcageAntenna
from birdcage.antenna.blocking import LATE_S
from birdcage.antenna.motion import longest_s, stop_power_s
from birdcage.antenna.rest import STILL_DEG
from birdcage.base.errors import CommandRefused
from birdcage.base.geometry import shortest_turn
from birdcage.rotator.facts import SecondMove
from birdcage.rotator.ladder import StopBy, StopOrder
from birdcage.rotator.values import Position
from birdcage.station.board import Board
from birdcage.station.state import Activity, Pointing, Search
from birdcage.station.untold import lose_track

GRACE_S = 1.0
"""How much longer than its stopping power a dish may take to rest, before STOP is reported as not working."""
PRINTED_DEG = 0.01
"""Angles are printed in hundredths, as far as sources show: two that differ by less may be printed alike."""
CREEPS_DEG_S = 0.5
"""The least speed that readings in coarser numbers must tell from rest."""
AWAY_DEG = 0.15
"""Further from its STOP target than overshoot and print explain, a dish has run past it, and may come back."""
TURNS_S = 0.3
"""Around the moment at which a dish turns round, two readings agree; over so long one between them does not."""
QUEUED_STILL_S = 0.3
"""On a dish that speeds up slowly, readings in shorter order agree in mid-move too."""


@dataclass(frozen=True, slots=True)
class Grip:
    """What is sent, and why; no order when nothing can be, or need be."""

    means: str
    sentence: str
    order: StopOrder | None = None


BEHIND = Grip(
    "look",
    "The dish has not confirmed the last line: a bare Enter was sent. Reading where it goes, to aim.",
    StopOrder(StopBy.KNOCK),
)
"""Behind a line that the dish may read later than it goes out, a target that is aimed now may lead it back."""
NOTHING = Grip("nothing moved", "Nothing was moving. Looking where the dish is.")
LOOK = Grip("look", "birdcage sent no motion. Looking where the dish goes, to aim.")


class StopWay(ABC):
    """One kind of dish."""

    anywhere = False
    """Whether what stops it does so in every menu."""
    unseen = "The dish does not know where it points, so it can't tell whether it moves. If it does, cut its power."
    """What is said when no reading proves it."""
    after = Activity.IDLE
    """What it is taken to do then."""

    def __init__(self, board: Board, antenna: BirdcageAntenna) -> None:
        self._board, self._antenna = board, antenna
        self.retarget_works: bool | None = None
        """Learnt from the first STOP in motion, where that is the means; None until then."""

    @abstractmethod
    def at_once(self) -> Grip:
        """Return what stops the motion that is known. Any thread; sends nothing."""

    @abstractmethod
    def on_sight(self, earlier: Pointing, later: Pointing) -> Grip:
        """Return what stops an unasked motion that two readings show."""

    @abstractmethod
    def still_s(self, *, slowest: bool) -> float:
        """Return for how long the readings must agree before it counts as at rest, in mechanical seconds.

        `slowest`: whether it may move as slowly as its motors can.
        """

    def turns_s(self, pointing: Pointing) -> float:  # noqa: ARG002 - only what aims can miss
        """Return for how many mechanical seconds readings must agree there at least: it may just be turning round."""
        return 0.0

    @abstractmethod
    def lasts_s(self, means: str) -> float:
        """Return how long this STOP may take from now on, in mechanical seconds."""

    def called(self) -> None:  # noqa: B027 - most dishes need no more
        """Take in that STOP was called. On the station's thread."""

    def answered(self, means: str) -> None:  # noqa: B027 - most dishes need no more
        """Do what else there is to do, once the dish has answered. May raise LinkError, NoReply or CommandRefused."""

    def is_there(self, now: float) -> bool:  # noqa: ARG002
        """Return whether readings that agree mean rest, and no motion that has hardly begun."""
        return True


class Retarget(StopWay):
    """A new target just ahead (decision 0004)."""

    def __init__(self, board: Board, antenna: BirdcageAntenna) -> None:
        super().__init__(board, antenna)
        self._seen: tuple[float | None, float | None] = (None, None)
        """The least speeds at which the motion that was last stopped was seen to go."""

    def at_once(self) -> Grip:
        """Aim ahead of the motion as it is modelled."""
        motion, activity = self._antenna.motion, self._board.state.activity
        if motion is not None or activity in (Activity.UNKNOWN, Activity.MOVING_UNASKED):
            unanswered_s = self._antenna.rotator.line.unanswered_s()
            unsure = motion is not None and not self._antenna.commands.are_sure
            if (unanswered_s > LATE_S or unsure) and self.retarget_works is not False:
                return BEHIND
        if motion is not None:
            self._seen = motion.azimuth.least_speed_deg_s, motion.elevation.least_speed_deg_s
        if self.retarget_works is not False:
            order = self._antenna.stop_order()
            if order is not None:
                return Grip("retarget", "A new target just ahead of the dish was sent.", order)
        elif motion is not None:
            return Grip("none", "This dish takes new targets only at the end of a move. Cut its power.")
        unknown = self._board.state.activity in (Activity.UNKNOWN, Activity.MOVING_UNASKED)
        return LOOK if unknown else NOTHING

    def on_sight(self, earlier: Pointing, later: Pointing) -> Grip:
        """Aim ahead of the motion as it was seen."""
        seen = [(Position(each.dish_az_deg, each.dish_el_deg), each.at) for each in (earlier, later)]
        order = self._antenna.stop_order_seen(*seen[0], *seen[1])
        return Grip("retarget", "The dish was seen moving: retargeted ahead of it.", order)

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

    def turns_s(self, pointing: Pointing) -> float:
        """Ask for more where it stands away from its target: one that speeds up slower than modelled comes back."""
        motion = self._antenna.motion
        if motion is None:
            return 0.0
        off_az = abs(shortest_turn(motion.azimuth.slew.end_deg, pointing.dish_az_deg))
        off_deg = max(off_az, abs(motion.elevation.slew.end_deg - pointing.dish_el_deg))
        return TURNS_S if off_deg > AWAY_DEG else 0.0

    def lasts_s(self, means: str) -> float:  # noqa: ARG002
        """Return the stopping power, and some grace."""
        return stop_power_s(self._antenna.model) + GRACE_S


class Queued(StopWay):
    """Any byte ends a silent slew; the move of one axis ends at its target, and nothing else is sent (decision 0011).

    An unasked motion is its TV search, or a slew of somebody else's: a byte, and then the search is ended.
    """

    anywhere = True

    def at_once(self) -> Grip:
        """Send a byte wherever it may do good: it moves nothing."""
        antenna, state = self._antenna, self._board.state
        motion, enter = antenna.motion, StopOrder(StopBy.ABORT)
        if motion is not None and motion.silent:
            return Grip("abort", "A byte that ends the slew was sent.", enter)
        if motion is not None and antenna.is_kept:
            return Grip("nothing moved", "The move was not sent yet, and is dropped. Looking where the dish is.")
        if motion is not None:
            left_s = max(0.0, motion.eta(self._board.clock.rate) - self._board.clock.monotonic())
            return Grip(
                "end of move",
                f"A move of one axis can't be recalled: it ends in {left_s:.1f} s, and nothing follows it.",
            )
        if state.activity is Activity.MOVING_UNASKED:
            return Grip("search", "A bare Enter was sent, and the TV search is being ended.", enter)
        if state.activity is Activity.UNKNOWN:
            return Grip("look", "A bare Enter was sent: it ends a combined move. Looking where the dish goes.", enter)
        return NOTHING

    def on_sight(self, earlier: Pointing, later: Pointing) -> Grip:  # noqa: ARG002
        """End whatever it is."""
        enter = StopOrder(StopBy.ABORT)
        return Grip("search", "The dish was seen moving: a bare Enter was sent, and the TV search is ended.", enter)

    def answered(self, means: str) -> None:
        """Take note of how the slew ended, or end the search and be in the motor menu again."""
        rotator = self._antenna.rotator
        if means == "abort":
            with suppress(CommandRefused):  # it has ended in either case
                rotator.slew_is_over()
        if means != "search":
            return
        self._antenna.maintenance.end_search()
        self._board.change(search=Search.OFF_UNTIL_POWER_UP)
        rotator.make_ready()

    def still_s(self, *, slowest: bool) -> float:  # noqa: ARG002
        """Return a time in which a dish that goes is seen to: its speeds can't be set."""
        return QUEUED_STILL_S

    def lasts_s(self, means: str) -> float:
        """Return the stopping power, or what is left of the move, and some grace."""
        clock, motion = self._board.clock, self._antenna.motion
        left_s = stop_power_s(self._antenna.model)
        if means == "end of move" and motion is not None:
            left_s = max(0.0, motion.eta(clock.rate) - clock.monotonic()) * clock.rate
        return left_s + GRACE_S

    def is_there(self, now: float) -> bool:
        """Give the move of one axis its time: it may hardly have begun."""
        motion = self._antenna.motion
        if motion is None or motion.silent:
            return True
        return now >= motion.eta(self._board.clock.rate)


class Blocked(Queued):
    """A dish that takes no command of a move before the motor stands: nothing stops a move, and none follows it."""

    anywhere = False

    def at_once(self) -> Grip:
        """Send nothing: what is sent now would move the dish once it stands."""
        antenna, motion = self._antenna, self._antenna.motion
        if motion is not None and antenna.is_kept:
            return Grip("nothing moved", "The move was not sent yet, and is dropped. Looking where the dish is.")
        if motion is None:
            return LOOK if self._board.state.activity in (Activity.UNKNOWN, Activity.MOVING_UNASKED) else NOTHING
        left_s = max(0.0, motion.eta(self._board.clock.rate) - self._board.clock.monotonic())
        return Grip(
            "end of move",
            f"This dish takes no command before its motor rests: the move ends in {left_s:.1f} s, and nothing follows "
            "it. To stop it sooner, cut its power.",
        )

    def on_sight(self, earlier: Pointing, later: Pointing) -> Grip:  # noqa: ARG002
        """Send nothing, as above."""
        return Grip(
            "end of move",
            "The dish was seen moving, and takes no command before its motor rests. To stop it sooner, cut its power.",
        )

    def answered(self, means: str) -> None:
        """Nothing else is to be done."""

    def lasts_s(self, means: str) -> float:
        """Return what is left of the move; of one that this program did not send, the longest that there is."""
        if means == "end of move" and self._antenna.motion is None:
            return longest_s(self._antenna.model) + GRACE_S
        return super().lasts_s(means)


class Untold(Queued):
    """A dish that tells neither where it is nor that it has stopped: what is sent may help, and is never confirmed."""

    unseen = "This dish does not tell whether it has stopped. If it moves, cut its power."
    after = Activity.UNKNOWN

    def at_once(self) -> Grip:
        """Send a byte, which ends a slew on relatives of this dish and moves nothing."""
        antenna, enter = self._antenna, StopOrder(StopBy.ABORT)
        motion, now = antenna.motion, self._board.clock.monotonic()
        if motion is not None and antenna.is_kept:
            return Grip("nothing moved", "The move was not sent yet, and is dropped.")
        until = antenna.reckoning.moves_until if motion is None else motion.over_by(self._board.clock.rate)
        if until <= now:
            return Grip("nothing moved", "By its time no move is under way. This dish does not tell.")
        return Grip(
            "none",
            "No STOP is known for this dish. A bare Enter was sent, which stops relatives of it. If it goes on, it "
            f"ends within {until - now:.0f} s. To stop it sooner, cut its power.",
            enter,
        )

    def called(self) -> None:
        """Whether it stops, and where, nothing will tell."""
        lose_track(self._antenna, self._board.clock)

    def answered(self, means: str) -> None:
        """Nothing else is to be done."""


def stop_way(board: Board, antenna: BirdcageAntenna) -> StopWay:
    """Return how this dish is stopped."""
    model = antenna.model
    if not model.tells_at_rest:
        return Untold(board, antenna)
    if not model.moves_in_turn:
        return Retarget(board, antenna)
    return (
        Blocked(board, antenna)
        if SecondMove.BLOCK in (model.second_same, model.second_other)
        else Queued(board, antenna)
    )


def closes_in(antenna: BirdcageAntenna, before: Pointing, now: Pointing) -> bool:
    """Return whether the dish is nearer to where it comes to rest by its model than it was a moment ago."""
    motion = antenna.motion
    if motion is None:
        return False
    az_deg, el_deg = motion.rest

    def away_deg(seen: Pointing) -> float:
        return max(abs(shortest_turn(seen.dish_az_deg, az_deg)), abs(seen.dish_el_deg - el_deg))

    return away_deg(now) < away_deg(before)
