"""Parks the dish once the client that moved it has left, and none wishes anything any more."""

from __future__ import annotations

import logging
from collections.abc import Callable

from birdcage.base.geometry import separation
from birdcage.rotctld.client_view import WishedDirection
from birdcage.rotctld.options import RotctldOptions
from birdcage.rotctld.rprt import RotctldError
from birdcage.rotctld.seen_dish import known_position
from birdcage.station.access import StationAccess
from birdcage.station.requests import EndMotion, Park
from birdcage.station.state import Activity

log = logging.getLogger("birdcage.rotctld")

PARKED_DEG = 0.5
"""So near to it the dish is parked."""


class IdlePark:
    """Asks the station, which counts down. Whatever happens to the dish meanwhile calls it off."""

    def __init__(self, station: StationAccess, options: RotctldOptions, holder: str) -> None:
        """`holder` has control while it parks."""
        self._station, self._options, self.holder = station, options, holder
        self.due: float | None = None
        """When the dish is to be parked, in monotonic seconds; None while that is not to be."""
        self._left = ""
        """Who has left; their control may be on its way back."""

    def left(self, name: str, now: float) -> None:
        """A client that had control of the dish, by this name, has left."""
        if self._options.idle_s > 0.0 and self._options.park is not None:
            self._left, self.due = name, now + self._options.idle_s

    def wished(self) -> None:
        """A client wishes something: park no more, and let it have the dish if it is on its way."""
        self.due = None
        state = self._station.state
        if state.holder == self.holder or any(task.holder == self.holder for task in state.tasks):
            self._station.submit(EndMotion(self.holder))

    def tick(self, now: float, park: Callable[[], WishedDirection]) -> None:
        """Park if it is time; `park` returns the park position, or raises RotctldError."""
        state = self._station.state
        if self.due is None or state.holder == self._left:
            return
        here = known_position(state)
        free = state.holder is None and state.held is None and state.fault is None and not state.tasks
        if not free or here is None or state.motion_refused_because is not None:
            self.due = None  # it is in other hands now, or something is wrong: a person sees to it
            return
        if now < self.due or state.activity is not Activity.IDLE:
            return
        self.due = None
        try:
            place = park()
        except RotctldError as refused:
            log.warning("not parked: %s", refused)
            return
        if separation(here.az_deg, here.el_deg, place.az_deg, place.el_deg) > PARKED_DEG:
            log.info("no client has wished anything for %.0f s: parking", self._options.idle_s)
            self._station.submit(Park(place.az_deg, place.el_deg, self.holder, asked=False))
