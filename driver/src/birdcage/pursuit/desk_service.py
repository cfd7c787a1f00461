"""The pursuit desk of a station's program, for the faces that are attached to it."""

from __future__ import annotations

import itertools
import threading
from collections.abc import Callable

from birdcage.pursuit.desk import PursuitDesk
from birdcage.pursuit.now import DeskNow
from birdcage.pursuit.order_form import now_to_json, order_from_json
from birdcage.station.services import News

PURSUIT = "pursuit"
"""How the service is called on the control channel."""


class DeskService:
    """Keeps `Service`: each face searches for itself, all else is one for all of them."""

    def __init__(self, desk: PursuitDesk) -> None:
        self._desk = desk
        self._numbers = itertools.count(1)

    def join(self, wake: Callable[[], None]) -> DeskVisit:
        """Let another face stand at the desk."""
        return DeskVisit(self._desk, f"face {next(self._numbers)}", wake)


class DeskVisit:
    """One face at the desk. Keeps `ServiceVisit`."""

    def __init__(self, desk: PursuitDesk, face: str, wake: Callable[[], None]) -> None:
        self._desk, self._face, self._wake = desk, face, wake
        self._lock = threading.Lock()
        self._now: DeskNow | None = None
        """What was not told yet."""
        self._part = desk.join(face, self._show)

    def take(self, order: object) -> None:
        """Leave an order at the desk. BadMessage for what is none."""
        self._desk.ask_as(self._face, order_from_json(order))

    def news(self) -> News | None:
        """Return what the desk shows, with its plans; None if that was told."""
        with self._lock:
            now, self._now = self._now, None
        if now is None:
            return None
        plans = [now.plan, None if now.resumable is None else now.resumable.plan]
        return News(now_to_json(now), tuple(plan for plan in plans if plan is not None))

    def close(self) -> None:
        """Let the face go. What it has ordered goes on."""
        self._part()

    def _show(self, now: DeskNow) -> None:
        with self._lock:
            self._now = now
        self._wake()
