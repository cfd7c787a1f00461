"""What a face needs of a station, whether that is in its own program or in another one."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import Future
from typing import Protocol

from birdcage.base.clock import Clock
from birdcage.station.events import Event
from birdcage.station.requests import Request
from birdcage.station.state import StationState


class StationAccess(Protocol):
    """Kept by `Station` itself, and by what is attached to the station of another program. All of it for any thread."""

    @property
    def clock(self) -> Clock:
        """What the times in state and events are counted by."""

    @property
    def state(self) -> StationState:
        """What is known now: immutable."""

    def submit(self, request: Request) -> Future[object]:
        """Ask for something. The future holds its result, or a `BirdcageError` that says why not."""

    def subscribe(self, listener: Callable[[Event], None], *kinds: type[Event]) -> Callable[[], None]:
        """Hear the events of these kinds, all by default: do nothing slow there. Returns what ends it."""

    def stop(self, by: str) -> None:
        """STOP: its first bytes are on their way when this returns, or the station's program was told."""
