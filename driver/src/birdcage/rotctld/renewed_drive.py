"""`M`: a drive that goes on for a moment after each time it was asked for, and no longer."""

from __future__ import annotations

from concurrent.futures import Future

from birdcage.base.errors import BirdcageError
from birdcage.rotctld.rotor import MoveDirection
from birdcage.station.access import StationAccess
from birdcage.station.requests import Drive

RENEW_S = 0.2
"""How often the station is asked to go on: it does for 0.6 s each time."""


class RenewedDrive:
    """Of one client. While it lasts, `tick` has to be called when `due` says so."""

    def __init__(self, station: StationAccess, holder: str, lasts_s: float) -> None:
        """`lasts_s`: how long the dish goes on after each `hold`."""
        self._station, self._holder, self._lasts_s = station, holder, lasts_s
        self._way = (0, 0)
        self._until: float | None = None
        self._renewed = 0.0
        self._asked: Future[object] | None = None

    @property
    def due(self) -> float | None:
        """When to go on, in monotonic seconds; None while nothing is driven."""
        return None if self._until is None else min(self._until, self._renewed + RENEW_S)

    def hold(self, direction: MoveDirection, now: float) -> None:
        """Go on in this direction from now on."""
        self._way, self._until = (
            (
                bool(direction & MoveDirection.RIGHT) - bool(direction & MoveDirection.LEFT),
                bool(direction & MoveDirection.UP) - bool(direction & MoveDirection.DOWN),
            ),
            now + self._lasts_s,
        )
        self._renew(now)

    def end(self) -> None:
        """Ask for it no more: the dish comes to rest by itself."""
        self._until = None
        if self._asked is not None:
            self._asked.cancel()
            self._asked = None

    def tick(self, now: float) -> str:
        """Go on if that is due; return why the station does not, as a sentence, and end it then."""
        asked = self._asked
        if asked is not None and asked.done() and not asked.cancelled():
            error = asked.exception()
            if isinstance(error, BirdcageError):
                self.end()
                return str(error)
        if self._until is not None and now >= self._until:
            self.end()
        elif (due := self.due) is not None and now >= due:
            self._renew(now)
        return ""

    def _renew(self, now: float) -> None:
        self._renewed = now
        self._asked = self._station.submit(Drive(*self._way, self._holder))
