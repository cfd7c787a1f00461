"""Moves a dish whose moves queue: one command at a time, the next one when the dish rests (decision 0011)."""

from __future__ import annotations

from collections import deque

from birdcage.antenna.antenna import BirdcageAntenna
from birdcage.antenna.leg_sender import LegSender
from birdcage.antenna.legs import Leg
from birdcage.antenna.motion import DishMotion
from birdcage.base.errors import CommandRefused, MotionRefused, PositionUnknown, Stopped, Superseded
from birdcage.base.geometry import shortest_turn
from birdcage.base.reason import Reason
from birdcage.rotator.ladder import StopMeans
from birdcage.station.dish_reader import DishReader
from birdcage.station.events import End
from birdcage.station.mover import ARRIVED_DEG, POLL_S, Job, Mover
from birdcage.station.signals import Signals
from birdcage.station.silent_slew_watch import MARGIN_S, SilentSlewWatch
from birdcage.station.state import Activity, Pointing
from birdcage.station.state_store import StateStore

STILL_S = 0.3
"""How long the readings must agree where it is not known beforehand where the dish comes to rest."""
ASTRAY_S = 20.0
"""How much longer than a leg may take at the longest a dish may move, before it is not our motion any more."""


class QueuedMover(Mover):
    """Follows a motion leg by leg. A newer target waits until the leg under way has ended, or was aborted."""

    def __init__(self, store: StateStore, antenna: BirdcageAntenna, reader: DishReader, signals: Signals) -> None:
        super().__init__(store, antenna, reader, signals)
        self._sender = LegSender(antenna)
        self._slew_watch = SilentSlewWatch(store, antenna)
        self._legs: deque[Leg] | None = None
        """What is left of the present motion after the leg under way; None while it waits to be planned."""
        self._plans = 0
        """How often the present motion was planned."""
        self._asked = False, False
        """Whether the present target was asked for with `clamp`, and with `leapfrog`."""

    def go(self, job: Job, *, clamp: bool = False, leapfrog: bool = False) -> None:
        """Begin a motion, or note it while a leg is under way: nothing is sent that would queue behind it."""
        asked = clamp, leapfrog and self._is_stream(job)
        antenna, under_way = self._antenna, self._antenna.motion
        if under_way is not None:
            dish = antenna.to_dish(job.az_deg, job.el_deg, clamp=clamp)
            antenna.gate.check_target(*dish)
            job.az_deg, job.el_deg = antenna.alignment.to_true(*dish)
            # Where one that does not tell would end is not known: its motion runs out.
            if under_way.silent and antenna.strategy.reads_position and not self._ends_near(under_way, *dish):
                self._slew_watch.end()
        self._begin_job(job, asked)

    def check_skew(self, deg: float) -> None:
        """Refuse it while the dish goes somewhere too: that would end it half-way."""
        super().check_skew(deg)
        under_way = self._antenna.motion
        if (self._job is not None and self._job.skew_deg is None) or (under_way is not None and under_way.skew is None):
            raise MotionRefused(
                "The skew is not turned while the dish moves. Wait until it rests, or stop it. Nothing was sent.",
                reason=Reason.MOVING,
            )

    def turn_skew(self, job: Job) -> None:
        """Turn the skew."""
        assert job.skew_deg is not None, "this is a motion of the skew"
        self.check_skew(job.skew_deg)
        self._begin_job(job, (False, False))

    def _begin_job(self, job: Job, asked: tuple[bool, bool]) -> None:
        """Send the first leg, at rest; else note what comes next. The motion before is superseded by either."""
        now, start, before = self._store.clock.monotonic(), self._store.state.position, self._job
        rests = self._antenna.motion is None
        legs = self._plan(job, asked) if rests else None
        if legs:
            self._send(job, legs.popleft())
        if self._job is before:  # else STOP has ended it meanwhile
            self._end(End.SUPERSEDED, "a newer target replaced it", Superseded("A newer target replaced this one."))
        permit = self._antenna.permit
        if permit is not None:
            permit()  # STOP may have come with the last answer: it has ended this motion
        self._legs, self._plans, self._asked = legs, int(rests), asked
        power = self._antenna.strategy.power(self._antenna.motion, self._store.clock.rate)
        start = start or self._store.state.position
        self._begin(job, (job.az_deg, job.el_deg), start, now, self._eta(job), power)  # fmt: skip

    def _plan(self, job: Job, asked: tuple[bool, bool]) -> deque[Leg]:
        """Read where the dish is, and plan from there. Raises what the gate refuses."""
        clamp, leapfrog = asked
        try:
            if job.skew_deg is not None:
                way = self._sender.plan_skew(job.skew_deg)
            else:
                way = self._sender.plan(job.az_deg, job.el_deg, clamp=clamp, leapfrog=leapfrog)
        except PositionUnknown as unknown:
            self._reader.unknown(unknown)
            raise
        job.az_deg, job.el_deg = way.az_deg, way.el_deg
        return deque(way.legs)

    def _send(self, job: Job, leg: Leg) -> None:
        job.last = job.still_since = None
        self._slew_watch.begin()
        self._sender.send(leg)
        job.answered = self._store.clock.monotonic()

    def _follow(self, job: Job) -> None:
        self.due = self._store.clock.monotonic() + POLL_S
        motion = self._antenna.motion
        if motion is None:
            self._go_on(job)
        elif not motion.silent:
            self._follow_leg(job, motion)
        elif self._slew_is_over(job, motion):
            self._follow_to_its_rest(job, motion)

    def _slew_is_over(self, job: Job, motion: DishMotion) -> bool:
        """Return whether a silent slew has given its prompt; show where the model has the dish until then."""
        try:
            if not self._slew_watch.lasts(motion):
                return self._slew_watch.has_prompt()
            if self._antenna.reckoning.told_in(motion) and self._is_astray(motion, self._store.clock.monotonic()):
                self._astray()
                return False
        except CommandRefused as refused:
            self._refused(job, refused)
            return False
        pointing = self._reader.modelled()
        if pointing is not None:
            if not pointing.modelled:
                self._show(job)
            self._tell_progress(job, pointing, self._eta(job) - pointing.at)
        return False

    def _refused(self, job: Job, refused: CommandRefused | MotionRefused) -> None:
        """The dish, or the gate, does not let the present leg begin: the motion ends, at rest."""
        if isinstance(refused, CommandRefused) and refused.trouble is not None:
            raise refused  # whoever hears of stalls takes it from here
        if self._job is not job:
            return
        self.fail(End.REFUSED, str(refused), refused)
        self._antenna.moving.end()
        self.activity(Activity.IDLE, "")
        self._reader.position()  # what was shown of a slew that never began is where it should have been

    def _follow_leg(self, job: Job, motion: DishMotion) -> None:
        """Watch one axis, which rests at its target or is stuck."""
        # One reading says nothing about motion: what a pursuit has sent may be over long before anybody looks.
        seen_before = job.last is not None
        pointing, clock = self._read(job), self._store.clock
        if pointing is None:
            return
        now, eta = clock.monotonic(), motion.eta(clock.rate)
        off_deg = _off_deg(pointing, *motion.rest)
        if motion.skew is not None:
            # One that is not printed is known by its time alone.
            here = motion.skew.slew.end_deg if pointing.skew_deg is None else pointing.skew_deg
            off_deg = max(off_deg, abs(here - motion.skew.slew.end_deg))
        unseen_s = MARGIN_S / clock.rate if motion.skew is not None and pointing.skew_deg is None else 0.0
        if job.still_since is not None and off_deg <= ARRIVED_DEG and now >= eta + unseen_s:
            self._leg_over(job)
        elif seen_before and job.still_since is None and self._is_astray(motion, now):
            self._astray()
        elif self._ends_untaken(job, pointing):
            return
        elif self._is_stuck(job, eta):
            self.stuck(_stuck_sentence(pointing, off_deg))
        else:
            self._show(job)
            self._tell_progress(job, pointing, self._eta(job) - now)

    def _follow_to_its_rest(self, job: Job, motion: DishMotion) -> None:
        """After a silent slew: wherever it ends."""
        pointing, clock = self._read(job), self._store.clock
        if pointing is None:
            return
        now = clock.monotonic()
        if job.still_since is not None and now - job.still_since >= max(STILL_S / clock.rate, 2 * POLL_S):
            self._end_silent_leg(job)
        elif self._is_astray(motion, now):
            self._astray()
        else:
            self._tell_progress(job, pointing, self._eta(job) - now)

    def _end_silent_leg(self, job: Job) -> None:
        """Take a silent slew for over; of a dish that does not tell, only while it answers and shows no restart."""
        if not self._antenna.strategy.reads_position:
            self._antenna.rotator.meet()
        if self._job is job:
            self._leg_over(job)

    def _is_astray(self, motion: DishMotion, now: float) -> bool:
        began = max(axis.started for axis in (motion.azimuth, motion.elevation, motion.skew) if axis is not None)
        return now > began + ASTRAY_S + motion.longest_s / self._store.clock.rate

    def _astray(self) -> None:
        sentence = "The dish still moves after the end of its motion."
        self.fail(End.FAULT, sentence, Stopped(sentence, reason=Reason.MOVED))
        self._antenna.moving.end()
        self._signals.astray()

    def _leg_over(self, job: Job) -> None:
        self._antenna.moving.end()
        self._antenna.reckoning.end(self._store.clock.monotonic())
        self._go_on(job)

    def _go_on(self, job: Job) -> None:
        """The dish rests: send what comes next, or see whether it has arrived."""
        try:
            if self._legs is None:
                self._replan(job)
                if self._job is not job:
                    return  # STOP came in the middle of the exchange
            if self._legs:
                self._send(job, self._legs.popleft())
                self._show(job)
                return
        except (CommandRefused, MotionRefused) as refused:
            self._refused(job, refused)
            return
        pointing = self._store.state.position
        if pointing is None or self._job is not job:
            return
        off_deg = self._away_deg(job, pointing)
        slew = self._antenna.model.slew
        if off_deg <= ARRIVED_DEG:
            self._arrive(job, pointing)
        elif self._plans < 2 and slew is not None and off_deg <= slew.least_deg:
            self._legs = None  # short of it: the rest is gone axis by axis
        elif self._antenna.strategy.reads_position:
            self.stuck(_stuck_sentence(pointing, off_deg))
        else:
            self.stuck(
                f"The dish last told that it was at {pointing.az_text}/{pointing.el_deg:.2f}°, {off_deg:.2f}° from its "
                "target, and tells no more."
            )
            self._reader.position()  # where it stands is not known

    def _replan(self, job: Job) -> None:
        legs = self._plan(job, self._asked)
        if self._job is job:
            self._legs, self._plans = legs, self._plans + 1

    def _away_deg(self, job: Job, pointing: Pointing) -> float:
        if job.skew_deg is not None:
            return 0.0 if pointing.skew_deg is None else abs(pointing.skew_deg - job.skew_deg)
        return _off_deg(pointing, *self._antenna.alignment.to_dish(job.az_deg, job.el_deg))

    def _ends_near(self, motion: DishMotion, az_deg: float, el_deg: float) -> bool:
        """Return whether a silent slew leads so near to a newer target that it is best left alone."""
        slew, rest = self._antenna.model.slew, motion.rest
        least_deg = slew.least_deg if slew is not None else 0.0
        return max(abs(shortest_turn(rest[0], az_deg)), abs(rest[1] - el_deg)) <= least_deg

    def _eta(self, job: Job) -> float:
        """Return when the dish should be there: the leg under way and all that are to come."""
        clock, motion = self._store.clock, self._antenna.motion
        now = clock.monotonic()
        reckoning = self._antenna.reckoning
        told = None if motion is None else reckoning.told_in(motion)
        if motion is not None and told is None and not motion.start_known:
            return max(now, motion.over_by(clock.rate))
        rests_at = now
        if motion is not None:
            rests_at = max(now, motion.eta(clock.rate) if told is None else reckoning.over_by(motion, clock.rate))
        if self._legs is not None:
            return rests_at + sum(leg.seconds for leg in self._legs) / clock.rate
        if motion is None or job.skew_deg is not None:
            return rests_at
        start = motion.at(rests_at, clock.rate)
        return rests_at + self._sender.seconds(start, job.az_deg, job.el_deg) / clock.rate

    def _show(self, job: Job) -> None:
        shown, clock = self._store.state.motion, self._store.clock
        if shown is None:
            return
        power, eta = self._antenna.strategy.power(self._antenna.motion, clock.rate), self._eta(job)
        same = power.means == shown.stop_means is StopMeans.ABORT and self._seen_way(shown) == shown.az_way_deg
        if abs(eta - shown.eta) > POLL_S or not same:
            self._update_shown(shown, eta, power)


def _off_deg(pointing: Pointing, az_deg: float, el_deg: float) -> float:
    return max(abs(shortest_turn(az_deg, pointing.dish_az_deg)), abs(pointing.dish_el_deg - el_deg))


def _stuck_sentence(pointing: Pointing, off_deg: float) -> str:
    return f"The dish stands still at {pointing.az_text}/{pointing.el_deg:.2f}°, {off_deg:.2f}° from its target."
