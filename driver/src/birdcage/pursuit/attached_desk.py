"""The pursuit desk of another program, as a face has it that is attached to that one's station."""

from __future__ import annotations

import logging
from collections.abc import Callable
from concurrent.futures import Future
from dataclasses import replace
from typing import TYPE_CHECKING

from birdcage.base.errors import BadMessage
from birdcage.pursuit.desk_service import PURSUIT
from birdcage.pursuit.now import DeskNow
from birdcage.pursuit.order_form import now_from_json, now_to_json, order_to_json
from birdcage.pursuit.orders import ApplyOrder, LocateOrder, Order, PursuitOrders, ReadSettingsOrder, SearchOrder
from birdcage.station.plan_outline import PlanOutline

if TYPE_CHECKING:
    from birdcage.station.attached import AttachedStation
    from birdcage.tracking.plan import Plan

NOT_ATTACHED = "No birdcage program drives the dish now. What it followed is offered again when one does."
NO_DESK = "No tracker here: the program that has the port lends none. `birdcage station run` does."

log = logging.getLogger(__name__)


class AttachedDesk(PursuitOrders):
    """Tells `DeskNow` as a desk of one's own does, on the station's thread. It survives the other program's restart.

    What this face searches and locates is its own, and is asked again of the next program.
    """

    def __init__(self, station: AttachedStation, tell: Callable[[DeskNow], object]) -> None:
        self._station, self._tell = station, tell
        self._own: dict[type[Order], Order] = {}
        """What this face types."""
        self._missing = True
        """Whether the service was not there when it was last heard of."""
        self.is_heard = False
        """Whether it was told yet what the desk shows, or that there is none."""
        self._closed = False
        self._refused = ""
        """Why the last order was not taken; empty if it was."""
        self._now = DeskNow(station.clock.utc())

    @property
    def now(self) -> DeskNow:
        """What the desk shows: immutable."""
        return self._now

    def start(self) -> None:
        """Begin to hear the desk. It takes a while to load what its news are made of."""
        now_from_json(now_to_json(self._now))  # here, and not on the thread that STOP's answer comes on
        self._station.services.join(PURSUIT, self._hear)

    @property
    def crash(self) -> BaseException | None:
        """What has ended the desk: a fault over there is told as a problem."""
        return None

    def close(self) -> None:
        """Hear no more. What was ordered goes on."""
        self._closed = True

    def ask(self, order: Order) -> None:
        """Leave an order. Settings are read again by the program that has the desk."""
        if isinstance(order, ApplyOrder):
            order = ReadSettingsOrder()
        if isinstance(order, SearchOrder | LocateOrder):
            self._own[type(order)] = order
            if self._missing:
                return
        self._station.services.order(PURSUIT, order_to_json(order)).add_done_callback(self._answered)

    def _answered(self, done: Future[object]) -> None:
        error = done.exception()
        before, self._refused = self._refused, "" if error is None else str(error)
        if before != self._refused:
            self._show(replace(self._now, problem=self._refused))

    def _hear(self, news: object) -> None:
        if news is None:
            self._missing = True
            problem = NO_DESK if self._station.is_attached else NOT_ATTACHED
            self._show(DeskNow(self._station.clock.utc(), query=self._now.query, problem=problem, is_away=True))
            return
        came, self._missing = self._missing, False
        try:
            now = now_from_json(news)
        except BadMessage as error:
            log.warning("what the pursuit desk tells can't be read: %s", error)
            now = DeskNow(self._station.clock.utc(), problem=f"The other program speaks another form. {error}")
        resumable = now.resumable
        if resumable is not None:
            plan = self._whole(resumable.plan)
            resumable = None if plan is None else replace(resumable, plan=plan)
        plan = self._whole(now.plan)
        self._show(replace(now, plan=plan, resumable=resumable, problem=now.problem or self._refused))
        if came:
            for order in list(self._own.values()):
                self.ask(order)

    def _whole(self, plan: Plan | None) -> Plan | None:
        """Return a plan whole; None where it was not told so, as nothing of it can be drawn."""
        whole = self._station.services.plans.whole(plan)
        return None if isinstance(whole, PlanOutline) else whole

    def _show(self, now: DeskNow) -> None:
        self._now, self.is_heard = now, True
        if not self._closed:
            self._tell(now)
