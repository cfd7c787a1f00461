"""Moves a dish that takes a new target in mid-motion, or may: both axes at once, and the latest target wins."""

from __future__ import annotations

from dataclasses import replace

from birdcage.antenna.motion import stop_power_s
from birdcage.base.errors import CommandRefused, PositionUnknown, Stopped, Superseded
from birdcage.base.geometry import shortest_turn
from birdcage.station.events import End
from birdcage.station.mover import ARRIVED_DEG, POLL_S, Job, Mover
from birdcage.station.state import Activity


class RetargetMover(Mover):
    """Sends each motion whole, and polls the position while it lasts."""

    def go(self, job: Job, *, clamp: bool = False, leapfrog: bool = False) -> None:
        """Send a motion. What the gate refuses is raised, and the motion under way goes on."""
        now, start = self._board.clock.monotonic(), self._board.state.position
        commanded = self._point(job, clamp=clamp, leapfrog=leapfrog and self._is_stream(job))
        self._end(End.SUPERSEDED, "a newer target replaced it", Superseded("A newer target replaced this one."))
        start = self._board.state.position if start is None else start
        motion, model = self._antenna.motion, self._antenna.model
        assert motion is not None, "the antenna has just begun it"
        eta = motion.eta(self._board.clock.rate)
        self._begin(job, commanded, start, now, eta, stop_power_s(model), model.stop_ladder[0].name)

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

    def _follow(self, job: Job) -> None:
        pointing = self._read(job)
        if pointing is None:
            return
        now = self._board.clock.monotonic()
        dish_az, dish_el = self._antenna.alignment.to_dish(job.az_deg, job.el_deg)
        off_az = abs(shortest_turn(dish_az, pointing.dish_az_deg))
        off_el = abs(pointing.dish_el_deg - dish_el)
        if job.still_since is not None and max(off_az, off_el) <= ARRIVED_DEG:
            self._arrive(job, pointing)
            return
        eta = self._update_eta(now)
        if self._is_stuck(job, eta):
            self.stuck(
                f"The dish stands still at {pointing.az_text}/{pointing.el_deg:.2f}°, "
                f"{max(off_az, off_el):.2f}° from its target."
            )
            return
        self._tell_progress(job, pointing, eta - now)

    def _update_eta(self, now: float) -> float:
        shown, model = self._board.state.motion, self._antenna.motion
        if shown is None or model is None:
            return now if shown is None else shown.eta
        eta = model.eta(self._board.clock.rate)
        if abs(eta - shown.eta) > POLL_S:
            self._board.change(motion=replace(shown, eta=eta))
        return eta
