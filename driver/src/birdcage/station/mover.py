"""One motion at a time: what every dish's has in common. How it is sent and followed differs by its firmware."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from concurrent.futures import Future
from dataclasses import dataclass, replace

from birdcage.antenna.antenna import BirdcageAntenna
from birdcage.antenna.motion import AGAINST_DEG_S
from birdcage.antenna.strategy.retarget import CREEPS_DEG_S, PRINTED_DEG
from birdcage.antenna.strategy.strategy import StopPower
from birdcage.base.errors import BirdcageError, MotionRefused, NoReply, NotTaken, Stopped
from birdcage.base.geometry import separation, shortest_turn
from birdcage.base.reason import Reason
from birdcage.rotator.ladder import StopMeans
from birdcage.rotator.values import Position
from birdcage.station.dish_reader import DishReader
from birdcage.station.events import ActivityChanged, End, MoveEnded, MoveProgress, MoveStarted
from birdcage.station.signals import Signals
from birdcage.station.state import MOVING, Activity, Motion, Pointing
from birdcage.station.state_store import StateStore

POLL_S = 0.1
ARRIVED_DEG = 0.08
"""The rest position lies up to 0.06 deg from the command, and a step on top (`docs/reference/consoles.md`,
*Overshoot*)."""
STREAM_S = 3.0
"""Targets of one holder closer together than this are a stream, which may be leap-frogged."""
REST_S = 1.0
"""How long a dish that goes where it likes must stand still to have arrived."""
STALL_S = 1.0
"""How long a dish may stand still away from its target, after the time at which it should have moved."""

UNTAKEN_S = 0.3
"""How long after its answer a dish that has taken a move is seen moving at the latest."""
BUSY = "busy with the last move"
"""What is told of a dish that waits for a motor before it takes another command."""

DAMAGE = (Reason.GARBAGE, Reason.BLOCKED)
"""Reasons of an answer that came, and made no sense."""


@dataclass(slots=True)
class Job:
    """A motion that somebody waits for."""

    az_deg: float
    el_deg: float
    holder: str
    future: Future[object]
    follow: bool = False
    miss_deg: float = 0.0
    """How far from the direction that was asked for it goes at the nearest, on the sky."""
    skew_deg: float | None = None
    """Where the skew is sent; azimuth and elevation then stay where they are."""
    whole: bool = False
    """Whether both axes were sent at once, and not in legs."""
    brisk: bool = False
    """Whether one reading there, asked for after the time at which the dish must rest, is its arrival."""
    to_rest: bool = False
    """Where it goes is the firmware's own business: it has arrived when it rests."""
    heard_first: bool = False
    """Whether something is read there before it is looked whether the dish is there."""
    looks: int = 0
    """How often it was looked at."""
    answered: float = 0.0
    """When the dish had answered its last command; monotonic seconds."""
    still_since: float | None = None
    last: Pointing | None = None
    damaged: bool = False
    """Whether the last answer made no sense: one may be spoilt on its way, two are a line that cannot be trusted."""


class Mover(ABC):
    """Latest wins: a new target supersedes the motion under way."""

    def __init__(self, store: StateStore, antenna: BirdcageAntenna, reader: DishReader, signals: Signals) -> None:
        self._store, self._antenna, self._reader, self._signals = store, antenna, reader, signals
        self._job: Job | None = None
        self.due: float | None = None
        """When to look at the motion next; None while nothing moves."""
        self.target: tuple[float, float] | None = None
        """The last direction that was commanded (true), from which a jog steps."""
        self._last_follow: tuple[str, float] | None = None
        self._is_busy = False
        """Whether the dish was told to wait for a motor, and has not answered since."""

    def busy(self) -> None:
        """The dish does not answer a motor command: it waits for the motor that runs."""
        shown = self._store.state.motion
        if self._job is not None and shown is not None and self._store.state.activity is Activity.SLEWING:
            # STOP is not read either before that motor stands.
            self._store.change(motion=replace(shown, stop_means=StopMeans.NONE, stop_power_s=None, rests_at=None))
            self._is_busy = True
            self.activity(Activity.SLEWING, BUSY)

    @property
    def is_moving(self) -> bool:
        """Whether a motion is under way that this program sent."""
        return self._job is not None

    @abstractmethod
    def go(self, job: Job, *, clamp: bool = False, leapfrog: bool = False) -> None:
        """Begin a motion. What the gate refuses is raised, and the motion under way goes on."""

    @abstractmethod
    def _follow(self, job: Job) -> None:
        """Judge whether the dish has arrived, is under way, or is stuck."""

    def check_skew(self, deg: float) -> None:
        """Raise MotionRefused where `turn_skew` would."""
        self._antenna.gate.check_skew(deg)

    def turn_skew(self, job: Job) -> None:
        """Turn the skew to `job.skew_deg`. MotionRefused where that can't be done."""
        assert job.skew_deg is not None, "this is a motion of the skew"
        self.check_skew(job.skew_deg)
        raise MotionRefused(
            "The skew of this dish can't be turned from here. Nothing was sent.", reason=Reason.UNSUPPORTED
        )

    def _next_look(self) -> float:
        """Return when to look at the motion next."""
        return self._antenna.rotator.next_look(self._store.clock.monotonic() + POLL_S)

    def await_rest(self, job: Job) -> None:
        """Follow a motion of the firmware's own until the dish rests."""
        job.to_rest = True
        self.forget_target()
        self._job, self.due = job, self._next_look()

    def await_stream_end(self) -> None:
        """Follow a dish that was sent one target after the other until it rests at, or near, the last one."""
        moves = self._antenna.motion is not None or self._store.state.activity in MOVING
        if self._job is None and moves:
            self.await_rest(Job(0.0, 0.0, self._store.state.holder or "", Future()))
            self.activity(Activity.SLEWING, "")

    def tick(self) -> None:
        """Look at the motion under way."""
        job = self._job
        if job is None:
            self.due = None
        elif job.to_rest:
            self._follow_to_rest(job)
        else:
            self._follow(job)

    def _follow_to_rest(self, job: Job) -> None:
        pointing, now = self._read(job), self._store.clock.monotonic()
        long_enough_s = max(REST_S / self._store.clock.rate, 3 * POLL_S)
        if pointing is not None and job.still_since is not None and now - job.still_since >= long_enough_s:
            self._arrive(job, pointing)

    def _read(self, job: Job) -> Pointing | None:
        """Read where the dish is, and note since when it stands still; None when it is not known now."""
        try:
            pointing = self._reader.position()
        except NoReply as damage:
            if job.damaged or self._job is not job or damage.reason not in DAMAGE:
                raise
            job.damaged, self.due = True, self._next_look()
            return None
        if self._job is not job:
            return None  # STOP was taken in the middle of the exchange
        job.damaged = False
        if self._is_busy:
            self._is_busy = False
            self.activity(Activity.SLEWING, "")
        now = self._store.clock.monotonic()
        self.due = self._next_look()
        if pointing is None:
            self.fail(End.FAULT, "the dish no longer knows where it is", Stopped("The dish lost its position."))
            return None
        still = job.last is not None and self._reader.is_still(pointing, job.last)
        job.last = pointing
        job.still_since = (job.still_since or now) if still else None
        return pointing

    @property
    def _arrived_deg(self) -> float:
        """How near its target a dish has arrived: what it prints may be half its last digit off."""
        printed_deg = self._antenna.rotator.printed_deg
        return ARRIVED_DEG if printed_deg <= PRINTED_DEG else ARRIVED_DEG + printed_deg / 2.0

    def _is_seen_still(self, job: Job) -> bool:
        """Return whether it stands: readings agree, for as long as one that creeps shows the same digits."""
        printed_deg, since = self._antenna.rotator.printed_deg, job.still_since
        creeps_s = printed_deg / CREEPS_DEG_S if printed_deg > PRINTED_DEG else 0.0
        return since is not None and self._store.clock.monotonic() >= since + creeps_s

    def _ends_untaken(self, job: Job, pointing: Pointing) -> bool:
        """End a motion that the dish has not taken: what it answered is not known, and it has stood still since."""
        antenna, motion, now = self._antenna, self._antenna.motion, self._store.clock.monotonic()
        if job.still_since is None or motion is None or now < job.answered + UNTAKEN_S:
            return False
        answers = antenna.commands.not_taken(Position(pointing.dish_az_deg, pointing.dish_el_deg), motion)
        if not answers:
            return False
        said = " / ".join(answer.said for answer in answers if answer.said)
        sentence = (
            f"The dish answered {said!r} and did not move." if said else "The dish answered nothing and did not move."
        )
        antenna.moving.end()
        self.fail(End.NOT_TAKEN, End.NOT_TAKEN.value, NotTaken(sentence))
        self.activity(Activity.IDLE, "")
        return True

    def _is_stuck(self, job: Job, eta: float) -> bool:
        """Return whether the dish has stood still for too long after it should have moved."""
        clock = self._store.clock
        since = job.still_since
        return since is not None and clock.monotonic() > max(eta, since) + max(STALL_S / clock.rate, 3 * POLL_S)

    def _begin(
        self, job: Job, commanded: tuple[float, float], start: Pointing | None, now: float, eta: float,
        power: StopPower,
    ) -> None:  # fmt: skip
        """Follow a motion from now on, and show it."""
        job.az_deg, job.el_deg = commanded
        self._job, self._last_follow = job, (job.holder, now) if job.follow else None
        self.due = self._next_look()
        shown = Motion(
            start.az_deg if start else commanded[0], start.el_deg if start else commanded[1], *commanded, now, eta,
            power.seconds, power.means, stop_proven=power.proven, to_skew_deg=job.skew_deg, rests_at=power.rests_at,
            eta_known=self._antenna.motion is None or self._antenna.motion.eta_known,
            az_way_deg=self._way(commanded) if job.skew_deg is None else 0.0,
        )  # fmt: skip
        self._store.change(motion=shown)
        if job.skew_deg is not None:
            self._store.change(target_skew_deg=job.skew_deg)
        else:
            self.target = commanded
            self._store.change(
                target_az_deg=commanded[0], target_el_deg=commanded[1], target_miss_deg=job.miss_deg
            )  # fmt: skip
        self.activity(Activity.SLEWING, "")
        self._store.tell(MoveStarted(*self._store.stamp(), shown, job.holder))

    def _way(self, commanded: tuple[float, float]) -> float | None:
        """Return how far the azimuth will turn; None if it may go either way round."""
        way = self._antenna.gate.way_to(self._antenna.alignment.to_dish(*commanded)[0])
        return way.deg if way.other_deg is None else None

    def _update_shown(self, shown: Motion, eta: float, power: StopPower) -> None:
        """Show when it should be there, which way it turns, and what stops it."""
        self._store.change(
            motion=replace(
                shown, eta=eta, stop_power_s=power.seconds, stop_means=power.means, stop_proven=power.proven,
                rests_at=power.rests_at, az_way_deg=self._seen_way(shown),
            )
        )  # fmt: skip

    def _seen_way(self, shown: Motion) -> float | None:
        """Return how far the azimuth turns, by the readings where they tell another way round than was thought."""
        motion = self._antenna.motion
        rate_deg_s = None if motion is None or motion.silent else motion.azimuth.rate_deg_s
        if shown.to_skew_deg is not None or rate_deg_s is None or abs(rate_deg_s) <= AGAINST_DEG_S:
            return shown.az_way_deg
        if shown.az_way_deg is not None and shown.az_way_deg * rate_deg_s >= 0:
            return shown.az_way_deg
        short_deg = shortest_turn(shown.from_az_deg, shown.to_az_deg)
        return short_deg if short_deg * rate_deg_s >= 0 else short_deg - math.copysign(360.0, short_deg)

    def _is_stream(self, job: Job) -> bool:
        """Return whether a target follows another one of its holder's closely."""
        last, now = self._last_follow, self._store.clock.monotonic()
        return job.follow and last is not None and last[0] == job.holder and now - last[1] < STREAM_S

    def _tell_progress(self, job: Job, pointing: Pointing, left_s: float) -> None:
        to_go = separation(pointing.az_deg, pointing.el_deg, job.az_deg, job.el_deg)
        if job.skew_deg is not None and pointing.skew_deg is not None:
            to_go = abs(job.skew_deg - pointing.skew_deg)
        self._store.tell(MoveProgress(*self._store.stamp(), pointing, to_go, max(0.0, left_s)))

    def stuck(self, sentence: str) -> None:
        """The dish does not get to its target: end the motion and raise the fault."""
        axis = self._furthest_axis()
        self.fail(End.FAULT, sentence, Stopped(sentence, reason=Reason.STALL))
        self._antenna.moving.end()  # STOP must not send it to its target once more
        self._signals.stalled(axis, sentence)

    def _furthest_axis(self) -> str:
        """Return the name of the axis that is furthest from its target; empty where that is not known."""
        job, pointing, facts = self._job, self._store.state.position, self._antenna.model
        if job is None or pointing is None:
            return ""
        if job.skew_deg is not None:
            return facts.skew.name if facts.skew is not None else ""
        az_deg, el_deg = self._antenna.alignment.to_dish(job.az_deg, job.el_deg)
        off_az_deg = abs(shortest_turn(az_deg, pointing.dish_az_deg))
        return (facts.azimuth if off_az_deg >= abs(el_deg - pointing.dish_el_deg) else facts.elevation).name

    def _arrive(self, job: Job, pointing: Pointing) -> None:
        self._job, self.due = None, None
        self._antenna.moving.end()
        self._store.change(motion=None)
        self.activity(Activity.IDLE, "")
        try:
            self._store.tell(MoveEnded(*self._store.stamp(), End.ARRIVED, "arrived", pointing, job.miss_deg))
        finally:
            job.future.set_result(pointing)

    def fail(self, end: End, sentence: str, error: BirdcageError) -> None:
        """End the motion under way, if there is one, without arrival."""
        self.due = None
        self.forget_target()
        self._end(end, sentence, error)

    def forget_target(self) -> None:
        """The dish does not go, or no longer stands, where it was sent: the next step is from where it is."""
        self.target = None
        self._store.change(target_az_deg=None, target_el_deg=None, target_miss_deg=0.0, target_skew_deg=None)

    def _end(self, end: End, sentence: str, error: BirdcageError) -> None:
        job, self._job = self._job, None
        if job is None:
            return
        if end is not End.SUPERSEDED:
            # The antenna keeps its model: the dish may still be on its way, and STOP needs it.
            self._store.change(motion=None)
        try:
            self._store.tell(MoveEnded(*self._store.stamp(), end, sentence, self._store.state.position))
        finally:
            if not job.future.done():
                job.future.set_exception(error)

    def activity(self, activity: Activity, text: str, *, raw: bool = False) -> None:
        """Say what the dish is doing; `raw`: a raw line may have set it in motion."""
        state = self._store.state
        if state.activity is activity and state.activity_text == text and state.raw_activity is raw:
            return
        at, utc = self._store.stamp()
        since = state.activity_since if state.activity is activity else at
        self._store.change(activity=activity, activity_text=text, activity_since=since, raw_activity=raw)
        self._store.tell(ActivityChanged(at, utc, activity, text, raw))
