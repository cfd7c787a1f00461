"""What a station's program does for attached programs beside requests: named services, which take orders and tell news.

The channel knows neither orders nor news: both are JSON. Of the news the newest counts; what a caller did not read in
time is left out.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol

if TYPE_CHECKING:
    from birdcage.tracking.plan import Plan


@dataclass(frozen=True, slots=True)
class News:
    """What a service tells one caller."""

    told: Mapping[str, object]
    """As JSON."""
    plans: tuple[Plan, ...] = ()
    """Those whose outlines stand in it: the caller is told them whole before."""


class ServiceVisit(Protocol):
    """One caller at a service."""

    def take(self, order: object) -> None:
        """Take an order, which is any JSON; wait for nothing. BadMessage for one that is none."""

    def news(self) -> News | None:
        """Return the newest that was not told yet; None if there is nothing new. Called on one thread."""

    def close(self) -> None:
        """End the visit: the caller is gone."""


class Service(Protocol):
    """Something that attached programs can join."""

    def join(self, wake: Callable[[], None]) -> ServiceVisit:
        """Begin a visit. `wake` is called when there is news, on any thread. It waits for nothing."""


class Services:
    """The services of one program, by name. Any thread."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._offered: dict[str, Service] = {}
        self._listeners: list[Callable[[], None]] = []

    def offer(self, name: str, service: Service) -> Callable[[], None]:
        """Offer a service from now on; those that wait for it join. Returns what ends that."""
        with self._lock:
            self._offered[name] = service
        self._changed()

        def end() -> None:
            with self._lock:
                if self._offered.get(name) is service:
                    del self._offered[name]
            self._changed()

        return end

    def find(self, name: str) -> Service | None:
        """Return a service; None if there is none of that name now."""
        with self._lock:
            return self._offered.get(name)

    def on_change(self, listener: Callable[[], None]) -> Callable[[], None]:
        """Call `listener` when a service comes or goes. Returns what ends that."""
        with self._lock:
            self._listeners.append(listener)

        def end() -> None:
            with self._lock:
                self._listeners.remove(listener)

        return end

    def _changed(self) -> None:
        with self._lock:
            listeners = list(self._listeners)
        for listener in listeners:
            listener()
