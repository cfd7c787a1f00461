"""What the desk has asked the station to follow, and what became of it."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import Future
from dataclasses import replace
from datetime import UTC, datetime
from typing import TYPE_CHECKING

from birdcage.base.errors import BirdcageError
from birdcage.station.pursuit_state import Phase, Pursuit, PursuitOptions
from birdcage.station.requests import EndPursuit, Pursue

if TYPE_CHECKING:
    from birdcage.base.config import Settings
    from birdcage.pursuit.desk_setup import ControllerName
    from birdcage.station.station import Station
    from birdcage.tracking.plan import Plan

BEFORE_LEAVING = frozenset({Phase.WAITING, Phase.YIELDED, Phase.INTERRUPTED})
"""Phases in which the dish may be anywhere: where it stands decides what the plan should be."""
IN_MID_PASS = frozenset({Phase.FOLLOWING, Phase.REWINDING})

Post = Callable[[Callable[[], object]], None]


def options_of(settings: Settings, controller: ControllerName | None = None) -> PursuitOptions:
    """Return how a plan is to be carried out by `[tracking]`; `controller` counts instead of the one there."""
    own = settings.tracking
    return PursuitOptions(
        controller=controller or own.controller, velocity_allowed=own.velocity_allowed,
        dead_band_steps=own.dead_band_steps, dead_band_db=own.dead_band_db, at_end=own.at_end,
        park_az_deg=own.park_az_deg, park_el_deg=own.park_el_deg, resume=own.resume,
        resume_within_s=own.resume_within_s,
    )  # fmt: skip


class Follower:
    """For the desk's thread alone; `post` brings a call to it from any other."""

    def __init__(self, station: Station, holder: str, post: Post) -> None:
        self._station, self.holder, self._post = station, holder, post
        self._number: int | None = None
        self._asked = False
        """Whether a request is under way whose answer is still to come."""
        self._sent: Plan | None = None
        """The plan that the station was given last."""
        self.problem = ""
        """Why the last one was not taken on."""

    @property
    def pursuit(self) -> Pursuit | None:
        """The pursuit of this desk, over or not; None if there is none, or it is another one's."""
        pursuit = self._station.state.pursuit
        return pursuit if pursuit is not None and pursuit.number == self._number else None

    @property
    def live(self) -> Pursuit | None:
        """The same while it is not over."""
        pursuit = self.pursuit
        return pursuit if pursuit is not None and pursuit.phase is not Phase.OVER else None

    @property
    def is_busy(self) -> bool:
        """Whether something is followed, or will be as soon as the station has answered."""
        return self._asked or self.live is not None

    def follow(self, plan: Plan, options: PursuitOptions, *, asked: bool) -> None:
        """Ask the station to carry out a plan."""
        self.problem, self._asked = "", True
        self._send(Pursue(plan, self.holder, options, asked))

    def renew(self, plan: Plan) -> None:
        """Bring a better plan in, if it is one for what is being followed."""
        live = self.live
        if live is not None and plan is not self._sent and plan.is_same_pass(live.plan):
            self._send(Pursue(plan, self.holder, replace(live.options), asked=False, renews=live.number))

    def leave(self, by: str) -> None:
        """End it."""
        if self.is_busy:
            self._station.submit(EndPursuit(by))

    def _send(self, request: Pursue) -> None:
        self._sent = request.plan
        future = self._station.submit(request)
        future.add_done_callback(lambda done: self._post(lambda: self._answered(done)))

    def _answered(self, future: Future[object]) -> None:
        self._asked = False
        if future.cancelled():
            return
        error = future.exception()
        if error is None:
            number = future.result()
            assert isinstance(number, int), "a pursuit that is taken on has a number"
            self._number = number
        elif isinstance(error, BirdcageError):
            self.problem = str(error)
        else:
            raise error


def reach_start(plan: Plan) -> datetime | None:
    """Return when the first leg begins; None if nothing can be reached."""
    return datetime.fromtimestamp(plan.legs[0].start_s, UTC) if plan.legs else None


def reach_end(plan: Plan) -> datetime | None:
    """Return when the last leg of this plan ends; None if nothing can be reached."""
    return datetime.fromtimestamp(plan.legs[-1].end_s, UTC) if plan.legs else None


def told_reach_end(plan: Plan) -> datetime | None:
    """Return when the target goes out of reach; None if it does not: always up, or never in reach."""
    return None if plan.reach_end_s is None else datetime.fromtimestamp(plan.reach_end_s, UTC)
