"""One motion at a time: sends it, follows it to its arrival, notices when it does not get there."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import Future
from dataclasses import dataclass, replace

from birdcage.antenna.antenna import BirdcageAntenna
from birdcage.antenna.motion import stop_power_s
from birdcage.base.errors import BirdcageError, CommandRefused, PositionUnknown, Stopped, Superseded
from birdcage.base.geometry import separation, shortest_turn
from birdcage.station.board import Board
from birdcage.station.events import ActivityChanged, End, MoveEnded, MoveProgress, MoveStarted
from birdcage.station.look import Look
from birdcage.station.state import Activity, Motion, Pointing

POLL_S = 0.1
ARRIVED_DEG = 0.08
"""The rest position lies up to 0.06 deg from the command (reference section 7.4), and a step on top."""
STREAM_S = 3.0
"""Targets of one holder closer together than this are a stream, which may be leap-frogged (DESIGN section 4)."""
REST_S = 1.0
"""How long a dish that goes where it likes must stand still to have arrived."""
STALL_S = 1.0
"""How long a dish may stand still away from its target, after the time at which it should have moved."""


@dataclass(slots=True)
class Job:
    """A motion that somebody waits for."""

    az_deg: float
    el_deg: float
    holder: str
    future: Future[object]
    follow: bool = False
    to_rest: bool = False
    """Where it goes is the firmware's own business: it has arrived when it rests."""
    still_since: float | None = None
    last: Pointing | None = None


class Mover:
    """Latest wins: a new target supersedes the motion under way."""

    def __init__(self, board: Board, antenna: BirdcageAntenna, look: Look) -> None:
        self._board, self._antenna, self._look = board, antenna, look
        self._job: Job | None = None
        self.due: float | None = None
        """When to look at the motion next; None while nothing moves."""
        self.target: tuple[float, float] | None = None
        """The last direction that was commanded (true), from which a jog steps."""
        self._last_follow: tuple[str, float] | None = None
        self.on_stall: Callable[[str], None] = lambda _sentence: None
        """Told when the dish stands still away from its target."""

    @property
    def is_moving(self) -> bool:
        """Whether a motion is under way that this program sent."""
        return self._job is not None

    def go(self, job: Job, *, clamp: bool = False, leapfrog: bool = False) -> None:
        """Send a motion. What the gate refuses is raised, and the motion under way goes on."""
        now, last = self._board.clock.monotonic(), self._last_follow
        stream = job.follow and last is not None and last[0] == job.holder and now - last[1] < STREAM_S
        start = self._board.state.position
        commanded = self._point(job, clamp=clamp, leapfrog=leapfrog and stream)
        self._end(End.SUPERSEDED, "a newer target replaced it", Superseded("A newer target replaced this one."))
        start = self._board.state.position if start is None else start
        self._last_follow = (job.holder, now) if job.follow else None
        job.az_deg, job.el_deg = commanded
        self._job, self.target = job, commanded
        self.due = self._board.clock.monotonic() + POLL_S
        motion, model = self._antenna.motion, self._antenna.model
        assert motion is not None, "the antenna has just begun it"
        shown = Motion(
            start.az_deg if start else commanded[0], start.el_deg if start else commanded[1], *commanded, now,
            motion.eta(self._board.clock.rate), stop_power_s(model), model.stop_ladder[0].name,
        )  # fmt: skip
        at, utc = self._board.stamp()
        self._board.change(motion=shown, target_az_deg=commanded[0], target_el_deg=commanded[1])
        self.activity(Activity.SLEWING, "")
        self._board.tell(MoveStarted(at, utc, shown, job.holder))

    def await_rest(self, job: Job) -> None:
        """Follow a motion of the firmware's own until the dish rests."""
        job.to_rest = True
        self.forget_target()
        self._job, self.due = job, self._board.clock.monotonic() + POLL_S

    def _point(self, job: Job, *, clamp: bool, leapfrog: bool) -> tuple[float, float]:
        antenna = self._antenna
        taken, permit = antenna.taken, antenna.protocol.permit
        try:
            commanded = antenna.point(job.az_deg, job.el_deg, clamp=clamp, leapfrog=leapfrog)
        except PositionUnknown as unknown:
            self._look.unknown(unknown)
            raise
        except CommandRefused:
            if antenna.taken != taken:
                # One axis goes to the new target and the other does not: neither motion is what anybody asked for.
                self.fail(End.STOPPED, "a newer target was taken in part", Stopped("Half of a newer target was taken."))
                self.activity(Activity.UNKNOWN, "")
            raise
        if permit is not None:
            permit()  # STOP may have come with the last answer: it has ended this motion
        return commanded

    def tick(self) -> None:
        """Read where the dish is, and judge whether it has arrived, is under way, or is stuck."""
        job, clock = self._job, self._board.clock
        if job is None:
            self.due = None
            return
        pointing = self._look.position()
        if self._job is not job:
            return  # STOP was taken in the middle of the exchange: this motion has ended
        now = clock.monotonic()
        self.due = now + POLL_S
        if pointing is None:
            self.fail(End.FAULT, "the dish no longer knows where it is", Stopped("The dish lost its position."))
            return
        still = job.last is not None and self._look.is_still(pointing, job.last)
        job.last = pointing
        job.still_since = (job.still_since or now) if still else None
        if job.to_rest:
            if job.still_since is not None and now - job.still_since >= max(REST_S / clock.rate, 3 * POLL_S):
                self._arrive(job, pointing)
            return
        dish_az, dish_el = self._antenna.alignment.to_dish(job.az_deg, job.el_deg)
        off_az = abs(shortest_turn(dish_az, pointing.dish_az_deg))
        off_el = abs(pointing.dish_el_deg - dish_el)
        if still and max(off_az, off_el) <= ARRIVED_DEG:
            self._arrive(job, pointing)
            return
        eta = self._update_eta(now)
        if job.still_since is not None and now > max(eta, job.still_since) + max(STALL_S / clock.rate, 3 * POLL_S):
            sentence = (
                f"The dish stands still at {pointing.az_deg:.2f}°/{pointing.el_deg:.2f}°, "
                f"{max(off_az, off_el):.2f}° from its target."
            )
            self.fail(End.FAULT, sentence, Stopped(sentence, reason="stall"))
            self._antenna.motion = None  # STOP must not send it to its target once more
            self.on_stall(sentence)
            return
        to_go = separation(pointing.az_deg, pointing.el_deg, job.az_deg, job.el_deg)
        at, utc = self._board.stamp()
        self._board.tell(MoveProgress(at, utc, pointing, to_go, max(0.0, eta - now)))

    def _update_eta(self, now: float) -> float:
        shown, model = self._board.state.motion, self._antenna.motion
        if shown is None or model is None:
            return now if shown is None else shown.eta
        eta = model.eta(self._board.clock.rate)
        if abs(eta - shown.eta) > POLL_S:
            self._board.change(motion=replace(shown, eta=eta))
        return eta

    def _arrive(self, job: Job, pointing: Pointing) -> None:
        self._job, self.due, self._antenna.motion = None, None, None
        self._board.change(motion=None)
        self.activity(Activity.IDLE, "")
        try:
            self._board.tell(MoveEnded(*self._board.stamp(), End.ARRIVED, "arrived", pointing))
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
        self._board.change(target_az_deg=None, target_el_deg=None)

    def _end(self, end: End, sentence: str, error: BirdcageError) -> None:
        job, self._job = self._job, None
        if job is None:
            return
        if end is not End.SUPERSEDED:
            # The antenna keeps its model: the dish may still be on its way, and STOP needs it.
            self._board.change(motion=None)
        try:
            self._board.tell(MoveEnded(*self._board.stamp(), end, sentence, self._board.state.position))
        finally:
            if not job.future.done():
                job.future.set_exception(error)

    def activity(self, activity: Activity, text: str) -> None:
        """Say what the dish is doing."""
        state = self._board.state
        if state.activity is activity and state.activity_text == text:
            return
        at, utc = self._board.stamp()
        since = state.activity_since if state.activity is activity else at
        self._board.change(activity=activity, activity_text=text, activity_since=since)
        self._board.tell(ActivityChanged(at, utc, activity, text))
