"""Refines plans beside the desk: rehearsing a pass takes seconds, in which a person types on."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import TYPE_CHECKING

from birdcage.base.errors import BirdcageError
from birdcage.pursuit.follower import Post
from birdcage.station.pursuit_state import PursuitOptions

if TYPE_CHECKING:
    from birdcage.tracking.mount import Mount
    from birdcage.tracking.plan import Plan

Done = Callable[["Plan", "Plan"], object]
"""Takes the plan that was to be refined, and the one that came of it."""


class Refiner:
    """One plan at a time; `ask` and the calls of `done` belong to the desk's thread."""

    def __init__(self, post: Post, done: Done, *, threads: bool) -> None:
        self._post, self._done, self._threads = post, done, threads
        self._asked: Plan | None = None
        """The plan that was asked for last."""
        self._busy = False

    def ask(self, plan: Plan, mount: Mount, options: PursuitOptions, preposition_s: float) -> None:
        """Refine a plan if nothing else is being refined, and it was not asked for before."""
        if self._busy or plan is self._asked or plan.refined:
            return
        self._asked, self._busy = plan, True

        def work() -> None:
            better = plan
            try:
                better = refined(plan, mount, options, preposition_s)
            finally:
                self._post(lambda: self._end(plan, better))

        if self._threads:
            threading.Thread(target=work, name="refine", daemon=True).start()
        else:
            work()

    def _end(self, plan: Plan, better: Plan) -> None:
        self._busy = False
        if better is not plan:
            self._done(plan, better)


def refined(plan: Plan, mount: Mount, options: PursuitOptions, preposition_s: float) -> Plan:
    """Return the plan with the share that suits the controller best; the same one where no controller may steer it."""
    from birdcage.tracking.planning.refining import refine
    from birdcage.tracking.steering.choice import controller_for

    try:
        _name, controller = controller_for(mount.model, options.controller, velocity_allowed=options.velocity_allowed)
    except BirdcageError:
        return plan  # whoever wants to follow it is told why not
    return refine(plan, mount, controller, preposition_s=preposition_s)
