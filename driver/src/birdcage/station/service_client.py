"""The services of another program's station, for a face that is attached to it; and the plans that it tells."""

from __future__ import annotations

import logging
from collections.abc import Callable, Mapping
from concurrent.futures import Future
from dataclasses import replace
from typing import Any

from birdcage.station.attach_messages import SERVICE_TOLD, AskService, BesideRequest, JoinService, news_from_json
from birdcage.station.json_shapes import AnyJson
from birdcage.station.plan_form import PLAN_TOLD, PlansHeard
from birdcage.station.state import StationState

log = logging.getLogger(__name__)


class ServiceClient:
    """Any thread; listeners are called on that of the station."""

    def __init__(self, ask: Callable[[BesideRequest, Future[object]], Future[object]]) -> None:
        self._ask = ask
        self._listeners: dict[str, Callable[[object], None]] = {}
        self.plans = PlansHeard()
        """The plans that were told last."""

    def join(self, service: str, listener: Callable[[object], None]) -> None:
        """Hear the news of a service, as JSON, of this program and of each one after it.

        None says that there is no such service now: the program has none, or there is no program.
        """
        self._listeners[service] = listener
        self._send(JoinService(service))

    def order(self, service: str, order: object) -> Future[object]:
        """Give a service an order, which is JSON. The future says that it was taken, or why not."""
        return self._send(AskService(service, AnyJson(order)))

    def join_all(self) -> None:
        """Join the services again that were joined: another program has the port."""
        for service in list(self._listeners):
            self._send(JoinService(service))

    def lose(self) -> None:
        """Say that there is none of them now."""
        for service in list(self._listeners):
            self._tell(service, None)

    def take(self, told: Mapping[str, Any]) -> bool:
        """Take in news, or a plan; return whether it was one of these. BadMessage for what does not fit."""
        if told.get("type") == PLAN_TOLD:
            self.plans.take(told)
        elif told.get("type") == SERVICE_TOLD:
            self._tell(*news_from_json(told))
        else:
            return False
        return True

    def with_plan(self, state: StationState) -> StationState:
        """Return a state with the plan of its pursuit whole."""
        pursuit = None if state.pursuit is None else self.plans.in_pursuit(state.pursuit)
        return state if pursuit is state.pursuit else replace(state, pursuit=pursuit)

    def _send(self, request: BesideRequest) -> Future[object]:
        future: Future[object] = Future()
        future.set_running_or_notify_cancel()
        return self._ask(request, future)

    def _tell(self, service: str, news: object) -> None:
        listener = self._listeners.get(service)
        if listener is None:
            return
        try:
            listener(news)
        except Exception:
            log.exception("a listener to the news of a service has failed, and hears no more")
            del self._listeners[service]
