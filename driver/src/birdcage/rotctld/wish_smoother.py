"""Where the dish is sent while one client wishes in a stream: after the target, not from wish to wish."""

from __future__ import annotations

from collections.abc import Callable
from typing import Literal

from birdcage.rotctld.client_view import WishedDirection
from birdcage.rotctld.wish_stream import WishStream
from birdcage.station.access import StationAccess
from birdcage.station.events import Event, MoveStarted
from birdcage.tracking.steering.latency import Smoothed

EACH_S = 0.4
"""How often the dish gets a target: both axes of one take 0.12 s on a wire with 60 ms a command, and a look follows."""
FIRST_LATENCY_S = 0.1
"""What is taken until a motion was sent."""
TRIAL = 3
"""So many wishes have to come while the dish follows on trial."""


class WishSmoother:
    """For the server's thread. Between `take` of a wish and `end`, `tick` has to be called when `due` says so.

    Each target leads by the measured latency, from the request until the dish has taken its first command, and by half
    of the time until the next target. So what is left is the saw-tooth between them, and no lag.

    **On trial.** Gpredict wishes only where the dish is off by a threshold, for the place where its target will be half
    of an interval later. Whoever takes such wishes for the place where it is leads by the threshold. The wishes do not
    tell, but the client does. At first the dish follows half of an interval behind, as far as it lags on the mean when
    it goes from wish to wish. There it is on Gpredict's target, and Gpredict falls silent. A client that goes on all
    the same wishes for where its target is.
    """

    def __init__(self, station: StationAccess, holder: str, mode: Literal["off", "on", "auto"]) -> None:
        """`mode`: `auto` takes even streams only, and each on trial; `on` takes all, without one."""
        self._station, self._holder, self._mode = station, holder, mode
        self._stream = WishStream(even=mode == "auto")
        self._wish: WishedDirection | None = None
        self._latency = Smoothed(FIRST_LATENCY_S)
        self._sent_at: float | None = None
        """When the last target was asked for, until its motion has begun."""
        self._unsubscribe: Callable[[], None] | None = None
        self._tried = 0
        """How many wishes have come while the dish followed them."""
        self._has_threshold = False
        """Whether the client fell silent on trial: it wishes by a threshold, and is left alone."""
        self.due: float | None = None
        """When the next target is due, in monotonic seconds; None while nothing is smoothed."""

    @property
    def lead_s(self) -> float | None:
        """By how much targets lead, in seconds; None while wishes go to the dish as they are."""
        return None if self.due is None else self._lead_s

    @property
    def _lead_s(self) -> float:
        lag_s = (self._stream.interval_s or 0.0) / 2.0 if self._mode == "auto" and self._tried < TRIAL else 0.0
        return self._latency.seconds + EACH_S / 2.0 - lag_s

    @property
    def _suits(self) -> bool:
        """Whether the dish takes a target in mid-motion, and tells where it is."""
        dish = self._station.state.dish
        return dish is not None and not dish.moves_in_turn and dish.tells_at_rest

    def take(self, wish: WishedDirection, now: float) -> WishedDirection:
        """Take in a wish; return where the dish is to go for it: there, or where its target will be."""
        if self._mode == "off" or not self._suits or self._has_threshold:
            self._rest()
            return wish
        self._wish = wish
        self._stream.take(now, wish.az_deg, wish.el_deg)
        self._tried += self.due is not None
        aim = self._aim(now)
        if aim is None:
            self._rest()
        return aim or wish

    def _aim(self, now: float) -> WishedDirection | None:
        foreseen = self._stream.foreseen(now + self._lead_s)
        if foreseen is None:
            return None
        if self._unsubscribe is None:
            self._unsubscribe = self._station.subscribe(self._on_started, MoveStarted)
        self._sent_at, self.due = now, now + EACH_S
        return WishedDirection(*foreseen)

    def tick(self, now: float) -> WishedDirection | None:
        """Return the target that is due; the last wish itself once the stream has broken off; None for neither."""
        if self.due is None or now < self.due or self._wish is None:
            return None
        until = self._stream.until
        if until is None or now >= until:
            self._has_threshold = self._mode == "auto" and self._tried < TRIAL
            wish = self._wish
            self.end()
            return wish
        return self._aim(now)

    def _on_started(self, event: Event) -> None:
        # On the station's thread: attributes are set whole, and nothing else happens.
        sent_at, self._sent_at = self._sent_at, None
        if isinstance(event, MoveStarted) and event.holder == self._holder and sent_at is not None:
            self._latency.take(self._station.clock.monotonic() - sent_at)

    def _rest(self) -> None:
        self.due = self._sent_at = None
        if self._unsubscribe is not None:
            self._unsubscribe()
            self._unsubscribe = None

    def end(self) -> None:
        """Forget the stream: the next wish begins another."""
        self._stream.end()
        self._wish, self._tried = None, 0
        self._rest()

    def forget(self) -> None:
        """Forget what is known of the client, too: it has ended what it was at."""
        self.end()
        self._has_threshold = False
