"""Moves a dish as its strategy says: whole, and the latest target wins at once; or leg by leg."""

from __future__ import annotations

from collections.abc import Callable

from birdcage.base.errors import CommandRefused, PositionUnknown, Superseded
from birdcage.base.geometry import shortest_turn
from birdcage.station.events import End
from birdcage.station.mover import POLL_S, Job
from birdcage.station.queued_mover import QueuedMover
from birdcage.station.state import Activity

SHORT_S = 0.5
"""A motion that is over so soon is not looked at before."""
LATE_S, LATER_S, SOONER_S, LATEST_S = 0.04, 0.02, 0.001, 0.3
"""So long after a short motion should be over the dish is looked at: at first; how much longer after a look that came
too soon; how much sooner after one that did not; at the most. So about one look in twenty comes too soon."""


class DishMover(QueuedMover):
    """Sends each motion whole where a new target is taken in mid-motion, and polls the position while it lasts.

    A dish that was seen to take no command while a motor runs is moved in legs from then on.
    """

    _late_s = LATE_S
    """How long after a short motion should be over a look finds the dish at rest, by the looks so far."""

    def go(self, job: Job, *, clamp: bool = False, leapfrog: bool = False) -> None:
        """Send a motion. What the gate refuses is raised, and the motion under way goes on."""
        if self._antenna.strategy.one_at_a_time:
            super().go(job, clamp=clamp, leapfrog=leapfrog)
            return
        job.whole, clock, permit = True, self._store.clock, self._antenna.permit
        now, start = clock.monotonic(), self._store.state.position

        def begin(commanded: tuple[float, float]) -> None:
            if permit is not None:
                permit()  # STOP may have come with the answer: then nothing of this motion follows
            self._end(End.SUPERSEDED, "a newer target replaced it", Superseded("A newer target replaced this one."))
            motion = self._antenna.motion
            assert motion is not None, "the antenna has just begun it"
            power = self._antenna.strategy.power(motion, clock.rate)
            self._begin(
                job, commanded, start or self._store.state.position, now, motion.eta(clock.rate), power,
            )  # fmt: skip

        self._point(job, begin, clamp=clamp, leapfrog=leapfrog and self._is_stream(job))
        if permit is not None:
            permit()  # STOP may have come with the last answer: it has ended this motion
        job.answered = clock.monotonic()
        self.activity(Activity.SLEWING, "")
        eta = self._update()
        if job.brisk and eta - clock.monotonic() < SHORT_S:
            self.due = (self.rests_by(job) if job.heard_first else None) or eta + self._late_s

    def _point(self, job: Job, begin: Callable[[tuple[float, float]], None], *, clamp: bool, leapfrog: bool) -> None:
        try:
            self._antenna.point(job.az_deg, job.el_deg, clamp=clamp, leapfrog=leapfrog, on_begun=begin)
        except PositionUnknown as unknown:
            self._reader.unknown(unknown)
            raise
        except CommandRefused as refused:
            if self._job is job:
                # One axis goes to its target and the other does not: that is not what anybody asked for.
                self.fail(End.REFUSED, str(refused), refused)
                self.activity(Activity.UNKNOWN, "")
            raise

    def _follow(self, job: Job) -> None:
        if not job.whole:
            super()._follow(job)
            return
        must_rest = job.brisk and self._must_rest()
        job.looks += 1
        pointing = self._read(job)
        if pointing is None:
            return
        dish_az, dish_el = self._antenna.alignment.to_dish(job.az_deg, job.el_deg)
        off_az = abs(shortest_turn(dish_az, pointing.dish_az_deg))
        off_el = abs(pointing.dish_el_deg - dish_el)
        is_there = max(off_az, off_el) <= self._arrived_deg
        if must_rest and job.looks == 1 and not job.heard_first:
            self._late_s = self._late_s - SOONER_S if is_there else self._late_s + LATER_S
            self._late_s = min(max(self._late_s, 0.0), LATEST_S)
        if is_there and (must_rest or self._is_seen_still(job)):
            self._arrive(job, pointing)
            if job.brisk and self._job is None:
                self._antenna.moving.see_at_rest(pointing.at)
            return
        if self._ends_untaken(job, pointing):
            return
        eta = self._update()
        if not is_there and self._is_stuck(job, eta):
            self.stuck(
                f"The dish stands still at {pointing.az_text}/{pointing.el_deg:.2f}°, "
                f"{max(off_az, off_el):.2f}° from its target."
            )
            return
        self._tell_progress(job, pointing, eta - self._store.clock.monotonic())

    def rests_by(self, job: Job) -> float | None:
        """Return when a short motion under way must be over, though it began only with its answer; None if unknown.

        Monotonic seconds.
        """
        motion, rate = self._antenna.motion, self._store.clock.rate
        if self._job is not job or not job.whole or motion is None or not motion.eta_known:
            return None
        lasts_s = max(axis.slew.duration_s for axis in (motion.azimuth, motion.elevation)) / rate
        return job.answered + lasts_s if lasts_s < SHORT_S else None

    def _must_rest(self) -> bool:
        """Return whether it must be there, by speeds that are known."""
        motion, clock = self._antenna.motion, self._store.clock
        return motion is not None and motion.eta_known and clock.monotonic() >= motion.eta(clock.rate)

    def _update(self) -> float:
        """Show when it should be there, and what stops it; return the former."""
        shown, motion, clock = self._store.state.motion, self._antenna.motion, self._store.clock
        if shown is None or motion is None:
            return clock.monotonic() if shown is None else shown.eta
        eta, power = motion.eta(clock.rate), self._antenna.strategy.power(motion, clock.rate)
        same = power.means == shown.stop_means and self._seen_way(shown) == shown.az_way_deg
        if abs(eta - shown.eta) > POLL_S or not same:
            self._update_shown(shown, eta, power)
        return eta
