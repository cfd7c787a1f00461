"""Requests that wait for the station's thread."""

from __future__ import annotations

from collections import deque
from concurrent.futures import Future
from typing import NamedTuple

from birdcage.base.errors import Stopped
from birdcage.base.reason import Reason
from birdcage.station.requests import Request


class WaitingRequest(NamedTuple):
    """One of them."""

    request: Request
    future: Future[object]
    stops_seen: int
    """How often STOP had been called when it was asked for."""


class Inbox(deque[WaitingRequest]):
    """Any thread puts in at the end, the station's takes from the front."""

    def drop(self) -> None:
        """Answer all that the station has ended. Any thread."""
        while True:
            try:
                future = self.popleft().future
            except IndexError:  # empty, perhaps by another thread that drops it too
                return
            if future.set_running_or_notify_cancel():
                future.set_exception(Stopped("The station has ended.", reason=Reason.CLOSING))
