"""How long the dish took to answer, over the last minutes."""

from __future__ import annotations

from collections import deque

from birdcage.station.state import LinkPhase, LinkState

from birdcage_tui.shown.view import Trip

EVERY_S = 1.0
"""Of all answers in so many seconds the slowest is kept."""
KEPT = 900
"""A quarter of an hour."""


class LinkBook:
    """Kept by the app. A link that came up anew begins anew: what was before is another connection's."""

    def __init__(self) -> None:
        self._trips: deque[Trip] = deque(maxlen=KEPT)
        self._since: float | None = None

    @property
    def trips(self) -> tuple[Trip, ...]:
        """The newest last."""
        return tuple(self._trips)

    def hear(self, link: LinkState) -> None:
        """Take in how long the last answer took, once for each."""
        if link.state is not LinkPhase.UP or link.last_reply is None or link.round_trip_s is None:
            return
        if link.since != self._since:
            self._trips.clear()
            self._since = link.since
        last = self._trips[-1] if self._trips else None
        if last is None or link.last_reply - last.at >= EVERY_S:
            self._trips.append(Trip(link.last_reply, link.round_trip_s))
        elif link.round_trip_s > last.seconds:
            self._trips[-1] = Trip(last.at, link.round_trip_s)
