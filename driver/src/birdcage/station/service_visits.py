"""The services that one attached program has joined."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from birdcage.base.errors import CommandRefused
from birdcage.base.reason import Reason
from birdcage.station.attach_messages import JoinService, told_by_service
from birdcage.station.control_messages import as_line
from birdcage.station.plan_form import PlanLines, PlansTold
from birdcage.station.services import News, Service, Services, ServiceVisit

MOST_JOINED = 20
"""Services that one caller may ask for: none has so many."""


class ServiceVisits:
    """For the thread of one caller; `wake` is called on any."""

    def __init__(self, services: Services, plan_lines: PlanLines, wake: Callable[[], None]) -> None:
        self._services, self._wake = services, wake
        self.plans = PlansTold(plan_lines)
        self._joined: dict[str, tuple[Service, ServiceVisit] | None] = {}
        """By name; None for one that is not offered now."""
        self._unsure: set[str] = set()
        """Names of which the caller does not know whether they are offered."""
        self._unsubscribe = services.on_change(wake)

    def join(self, request: JoinService) -> None:
        """Join a service, now or as soon as it is offered. CommandRefused for too many."""
        if len(self._joined) >= MOST_JOINED:
            words = f"A program can join {MOST_JOINED} services at most. Nothing was done."
            raise CommandRefused(words, reason=Reason.BUSY)
        if request.service not in self._joined:
            self._joined[request.service] = None
            self._unsure.add(request.service)

    def take(self, name: str, order: object) -> None:
        """Hand an order on. CommandRefused where the service is not offered, or was not joined; BadMessage by it."""
        self._look()
        joined = self._joined.get(name)
        if joined is None:
            raise CommandRefused(f"No {name} is joined here. Nothing was done.", reason=Reason.UNSUPPORTED)
        joined[1].take(order)

    def next_lines(self) -> bytes:
        """Return the next news, and the plans that belong to them, as lines; empty if there are none."""
        return next(self._lines(), b"")

    def close(self) -> None:
        """End all visits."""
        self._unsubscribe()
        for joined in self._joined.values():
            if joined is not None:
                joined[1].close()
        self._joined.clear()

    def _lines(self) -> Iterator[bytes]:
        self._look()
        for name, joined in self._joined.items():
            news = None if joined is None else joined[1].news()
            if news is not None:
                self._unsure.discard(name)
                yield self.plans.lines(news.plans) + _line(name, news)
            elif joined is None and name in self._unsure:
                self._unsure.discard(name)
                yield _line(name, None)

    def _look(self) -> None:
        """Join what is offered now, and leave what is gone."""
        for name, joined in self._joined.items():
            offered = self._services.find(name)
            if joined is not None and joined[0] is not offered:
                joined[1].close()
                self._joined[name] = None
                self._unsure.add(name)
            if offered is not None and self._joined[name] is None:
                self._joined[name] = offered, offered.join(self._wake)


def _line(name: str, news: News | None) -> bytes:
    return as_line(told_by_service(name, None if news is None else news.told))
