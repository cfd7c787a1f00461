"""What all ways of moving and stopping a machine have in common (`docs/decisions/0045-strategies.md`)."""

from __future__ import annotations

from abc import ABC, abstractmethod
from contextlib import suppress
from dataclasses import dataclass
from enum import Enum
from typing import TYPE_CHECKING

from birdcage.antenna.motion import STOP_LATENCY_S, AxisMotion, DishMotion, stop_power_s
from birdcage.base.clock import Clock
from birdcage.base.errors import CommandRefused
from birdcage.base.geometry import shortest_turn
from birdcage.rotator.ladder import MoveKind, Rung, StopBy, StopMeans, StopOrder, rungs
from birdcage.rotator.values import Position

if TYPE_CHECKING:
    from birdcage.antenna.antenna import BirdcageAntenna

GRACE_S = 1.0
"""How much longer than its stopping power a dish may take to rest, before STOP is reported as not working."""

SHAPE = 0.14
"""How much of its way an axis may be off a model that knows its time alone: an even speed and one that rises and falls
all the way are an eighth of it apart."""


CLIMBED = frozenset({StopMeans.RETARGET, StopMeans.COMMAND, StopMeans.ABORT, StopMeans.RELEASE})
"""What a program can do itself."""


class Unplanned(Enum):
    """What is known of a motion that this program has not sent."""

    NONE = "none"
    """There is none."""
    UNKNOWN = "unknown"
    SEEN = "seen"


@dataclass(frozen=True, slots=True)
class StopAction:
    """What STOP does, and why; no order when nothing can be sent, or need be."""

    means: StopMeans
    sentence: str
    order: StopOrder | None = None


NOTHING_MOVED = StopAction(StopMeans.NOTHING_MOVED, "Nothing was moving. Looking where the dish is.")
LOOK = StopAction(StopMeans.LOOK, "birdcage sent no motion. Looking where the dish goes, to aim.")
DROPPED = StopAction(StopMeans.NOTHING_MOVED, "The move was not sent yet, and is dropped. Looking where the dish is.")


@dataclass(frozen=True, slots=True)
class StopPower:
    """What STOP can do about a motion, said before it is needed (`docs/safety.md`, *STOP and HELD*)."""

    seconds: float
    means: StopMeans
    proven: bool
    """Whether a source, or a STOP of this dish in motion, has shown that it works."""
    rests_at: float | None = None
    """When the move ends that STOP must wait for; monotonic seconds."""


class MotionStrategy(ABC):
    """How one machine is moved and stopped. `choice` chooses it; nothing else asks what kind of machine it is."""

    one_at_a_time = False
    """Whether nothing is sent before the move under way is over, or was ended."""
    reads_position = True
    """Whether it is asked where it stands; else that is modelled."""
    answers_in_motion = True
    """Whether it answers the command of a move while a motor runs."""
    unseen = "The dish does not know where it points, so it can't tell whether it moves. If it does, cut its power."
    """What is said of a STOP that no reading proves."""

    def __init__(self, antenna: BirdcageAntenna) -> None:
        self._antenna = antenna
        self.proven: StopMeans | None = None
        """By what a STOP in motion was seen to work."""
        self.failed: frozenset[StopMeans] = frozenset()
        """What was sent to a dish in motion, and did not stop it."""

    def forget_learnt(self) -> None:
        """Another machine may be at the end of the line."""
        self.proven, self.failed = None, frozenset()

    def found_to_work(self, means: StopMeans) -> None:
        """A dish in motion was seen to come to rest by it."""
        if means not in self.failed:
            self.proven = means

    def found_to_fail(self, means: StopMeans) -> None:
        """A dish in motion went on."""
        self.proven, self.failed = None, self.failed | {means}

    def rungs(self, kind: MoveKind) -> tuple[Rung, ...]:
        """Return the rungs that may end a kind of motion, best first: those with consent that have not failed."""
        antenna = self._antenna
        every = rungs(antenna.model.stop_ladder, kind, consent=antenna.stop_consent)
        return tuple(rung for rung in every if rung.means not in self.failed)

    @property
    def kind(self) -> MoveKind:
        """The kind of the motion under way, or of the next one."""
        motion = self._antenna.motion
        return MoveKind.COMBINED if motion is not None and motion.silent else MoveKind.SINGLE

    @property
    def looks_wait(self) -> bool:
        """Whether it answers no question for its position either while a motor runs."""
        return False

    @property
    def commands(self) -> bool:
        """Whether the machine's own STOP command goes before anything else."""
        first = self.rungs(self.kind)[:1]
        return bool(first) and first[0].means is StopMeans.COMMAND

    def commanded(self) -> StopAction:
        """Return its own STOP command; the motion under way brakes from now on."""
        self._antenna.stop_aim.model_stopped()
        return StopAction(StopMeans.COMMAND, "The machine's own STOP command was sent.", StopOrder(StopBy.COMMAND))

    @property
    def anywhere(self) -> bool:
        """Whether what stops it does so in every menu."""
        return any(rung.anywhere for rung in self._antenna.model.stop_ladder)

    def _power(self, means: StopMeans) -> StopPower:
        """Return what a rung can do."""
        known = any(rung.means is means and rung.proven for rung in self._antenna.model.stop_ladder)
        return StopPower(self.takes_s(means), means, known or self.proven is means)

    @abstractmethod
    def power(self, motion: DishMotion | None, rate: float) -> StopPower:
        """Return what STOP can do about a motion; without one, about the first that may begin."""

    @property
    @abstractmethod
    def unplanned(self) -> StopMeans:
        """By what STOP ends a motion that goes on without a plan of this program."""

    @abstractmethod
    def at_once(self, unplanned: Unplanned, clock: Clock) -> StopAction:
        """Return what stops the motion that is known. Any thread; sends nothing."""

    @abstractmethod
    def on_sight(self, earlier: Position, earlier_at: float, later: Position, later_at: float) -> StopAction:
        """Return what stops an unplanned motion that two readings of dish angles show."""

    @property
    def ends_slew(self) -> StopOrder | None:
        """What ends a slew before its time, and may be sent while it lasts; None if nothing is known to."""
        means = {rung.means for rung in self._antenna.model.stop_ladder if MoveKind.COMBINED in rung.ends}
        if StopMeans.ABORT in means:
            return StopOrder(StopBy.ABORT)
        return StopOrder(StopBy.COMMAND) if StopMeans.COMMAND in means else None

    def while_busy(self, kind: MoveKind) -> StopAction | None:
        """Return what ends a motion that the machine is busy with; None if nothing is known to.

        Any thread; sends nothing.
        """
        for rung in self.rungs(kind):
            if rung.ends_what_it_is_busy_with:
                by = StopBy.COMMAND if rung.means is StopMeans.COMMAND else StopBy.ABORT
                return StopAction(rung.means, f"What ends it was sent: {rung.sentence}.", StopOrder(by))
            if rung.means is StopMeans.KEY:
                return StopAction(rung.means, f"What may end it was sent: {rung.sentence}.", StopOrder(StopBy.ABORT))
        return None

    def next_rung(self, after: StopMeans) -> Rung | None:
        """Return the rung above one that did not stop the dish, as far as a program can climb it."""
        antenna = self._antenna
        every = rungs(antenna.model.stop_ladder, self.kind, consent=antenna.stop_consent)
        above = next((index + 1 for index, rung in enumerate(every) if rung.means is after), 0)
        return next((rung for rung in every[above:] if rung.means in CLIMBED and rung.means not in self.failed), None)

    @abstractmethod
    def still_s(self, *, slowest: bool) -> float:
        """Return for how long the readings must agree before it counts as at rest, in mechanical seconds.

        `slowest`: whether it may move as slowly as its motors can.
        """

    def turns_s(self, dish: Position) -> float:  # noqa: ARG002 - only what aims can miss
        """Return for how many mechanical seconds readings must agree there at least: it may just be turning round."""
        return 0.0

    def lasts_s(self, means: StopMeans, clock: Clock) -> float:  # noqa: ARG002 - only some wait for an end
        """Return how long this STOP may take from now on, in mechanical seconds."""
        return self.takes_s(means) + GRACE_S

    def takes_s(self, means: StopMeans) -> float:
        """Return how long it takes: as its rung says, else as long as braking; mechanical seconds."""
        rung = next((rung for rung in self._antenna.model.stop_ladder if rung.means is means), None)
        own_s = None if rung is None else rung.lasts_s
        return stop_power_s(self._antenna.model) if own_s is None else own_s

    def answered(self, means: StopMeans) -> None:  # noqa: B027 - most dishes need no more
        """Take in that the dish has answered. May raise LinkError, NoReply or CommandRefused."""

    def uncertainty_deg(self, clock: Clock) -> float:
        """Return within how many degrees the machine should be of where it is modelled now.

        An axis may be ahead of its model, or behind, by its way within one latency; where only times were measured,
        by a share of its whole way. It comes to rest up to its overshoot, and a step, off its target.
        """
        motion, now, rate = self._antenna.motion, clock.monotonic(), clock.rate
        model = self._antenna.model
        least_deg = max(axis.overshoot_deg + axis.step_deg for axis in (model.azimuth, model.elevation))
        if motion is None:
            return least_deg
        return least_deg + max(self._off_model_deg(axis, now, rate) for axis in (motion.azimuth, motion.elevation))

    @staticmethod
    def _off_model_deg(axis: AxisMotion, now: float, rate: float) -> float:
        here_deg, speed_deg_s = axis.modelled(now, rate)
        off_deg = abs(speed_deg_s) * STOP_LATENCY_S * rate
        if axis.axis.times is None:
            return off_deg
        begin_deg, end_deg = axis.slew.at(0.0)[0], axis.slew.end_deg
        furthest_deg = max(abs(here_deg - begin_deg), abs(end_deg - here_deg)) if here_deg != end_deg else 0.0
        return min(off_deg + SHAPE * abs(end_deg - begin_deg), furthest_deg)

    def closes_in(self, earlier: Position, later: Position) -> bool:
        """Return whether the dish is nearer to where it comes to rest by its model than it was a moment ago."""
        motion = self._antenna.motion
        if motion is None:
            return False
        az_deg, el_deg = motion.rest

        def away_deg(dish: Position) -> float:
            return max(abs(shortest_turn(dish.azimuth, az_deg)), abs(dish.elevation - el_deg))

        return away_deg(later) < away_deg(earlier)

    def is_there(self, clock: Clock) -> bool:  # noqa: ARG002
        """Return whether readings that agree mean rest, and no motion that has hardly begun."""
        return True

    def ends_soon(self, clock: Clock) -> bool:  # noqa: ARG002 - where positions are told it can be stopped anywhere
        """Return whether the move under way is best left alone: it ends within seconds."""
        return False

    def end_motion(self, clock: Clock) -> None:  # noqa: ARG002 - only some have to lose track
        """Stop what moves as far as that can be done, and hold nothing. LinkError, NoReply."""
        with suppress(CommandRefused):  # it ends its move, or takes no new target: then it rests where it was sent
            self._antenna.stop()

    def lose_track(self, clock: Clock) -> None:  # noqa: B027 - where positions are told there is none to lose
        """Take in that something came between the machine and its target: STOP, a lost line, a step of the clock."""
