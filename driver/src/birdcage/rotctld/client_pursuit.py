"""Of one client: whether its wishes follow a satellite, and the pursuit that takes their place then."""

from __future__ import annotations

import logging
from collections import deque
from concurrent.futures import Future
from datetime import datetime

from birdcage.base.errors import BirdcageError, MotionRefused
from birdcage.base.geometry import separation
from birdcage.rotctld.client_view import Following, WishedDirection
from birdcage.rotctld.followed_satellite import FollowedSatellite
from birdcage.rotctld.recogniser import Recogniser
from birdcage.station.access import StationAccess
from birdcage.station.pursuit_state import Phase, Pursuit
from birdcage.station.requests import EndMotion, Pursue

KEPT, KEPT_S = 300, 240.0
"""How many wishes are looked at, and for how long."""
FEWEST, LEAST_DEG = 3, 1.0
"""Fewer wishes than this, or such that lie closer together, are not looked at."""
ASK_S = 3.0
"""How often the sky is searched for one client, at most."""
SILENT_S = 30.0
"""A client that says nothing for so long is gone, whatever its connection says."""
NEVER = float("-inf")
AT_REST = (Phase.WAITING, Phase.YIELDED, Phase.INTERRUPTED)
"""Where another motion of the same client does not end a pursuit by itself."""

log = logging.getLogger("birdcage.rotctld")


class ClientPursuit:
    """For the server's thread. `covers` has to be asked of each wish that could be carried out, `take_up` after it."""

    def __init__(self, station: StationAccess, holder: str, recogniser: Recogniser | None) -> None:
        """`recogniser`: None where this server can't follow by itself."""
        self._station, self._holder, self._recogniser = station, holder, recogniser
        self._wishes: deque[tuple[float, WishedDirection]] = deque(maxlen=KEPT)
        self._asked_at, self._heard_at = NEVER, 0.0
        self._stream = 0
        """Counts the streams of wishes: an answer for one that has ended comes too late."""
        self._answers: deque[tuple[int, FollowedSatellite | None]] = deque()
        self._asks = False
        self._satellite: FollowedSatellite | None = None
        self._begun: Future[object] | None = None
        """The pursuit's number, once the station has taken it on."""
        self._refused: tuple[int, datetime] | None = None
        """The satellite and the AOS of a pass that the dish has refused to follow."""

    # Of each wish

    def covers(self, wish: WishedDirection, now: float) -> bool:
        """Take in a wish; return whether the dish follows its satellite, so that nothing is to be sent."""
        t_s = self._station.clock.utc().timestamp()
        if self._satellite is not None:
            if self._is_live and self._satellite.agrees(wish, t_s):
                return True
            self.end()
        if self._recogniser is None or not self._recogniser.on:
            return False
        while self._wishes and t_s - self._wishes[0][0] > KEPT_S:
            self._wishes.popleft()
        self._wishes.append((t_s, wish))
        self._ask(now)
        return False

    def heard(self, now: float) -> None:
        """It has said something."""
        self._heard_at = now

    def tick(self, now: float) -> bool:
        """See to the pursuit; return whether the last wish is to be sent after all: it was switched off."""
        if self._satellite is None:
            return False
        live = self._live
        if not self._is_live:
            begun = self._begun
            if begun is not None and not begun.cancelled() and isinstance(begun.exception(), MotionRefused):
                self._refused = self._pass_of(self._satellite)
            self._forget()
            return False
        if self._recogniser is None or not self._recogniser.on:
            self.end()
            return True
        if now - self._heard_at > SILENT_S or (live is not None and live.phase in (Phase.YIELDED, Phase.INTERRUPTED)):
            self.stop()
        return False

    def end(self) -> None:
        """Another motion of this client follows at once: one that the dish is in goes over into it."""
        live = self._live
        if self._satellite is not None and (live is None or live.phase in AT_REST):
            self._station.submit(EndMotion(self._holder))
        self._forget()

    def stop(self) -> None:
        """No motion of this client follows: end it, and let the dish come to rest."""
        if self._satellite is not None:
            self._station.submit(EndMotion(self._holder))
        self._forget()

    def forget(self) -> None:
        """Forget what is known of the client: it has ended what it was at. Nothing is sent."""
        self._forget()
        self._refused = None

    @property
    def follows(self) -> bool:
        """Whether the dish follows its satellite, or is about to."""
        return self._satellite is not None and self._is_live

    @property
    def following(self) -> Following | None:
        """What is to be shown; None while its own wishes are carried out."""
        satellite, live = self._satellite, self._live
        if satellite is None or not self._is_live:
            return None
        return Following(satellite.name, None if live is None else live.rms_error_deg, satellite.steps_deg)

    # The search

    def _ask(self, now: float) -> None:
        assert self._recogniser is not None, "somebody recognises"
        first, last = self._wishes[0][1], self._wishes[-1][1]
        spread_deg = separation(first.az_deg, first.el_deg, last.az_deg, last.el_deg)
        if self._asks or now < self._asked_at + ASK_S or len(self._wishes) < FEWEST or spread_deg < LEAST_DEG:
            return
        self._asks, self._asked_at = True, now
        stream, answers = self._stream, self._answers
        self._recogniser.ask(tuple(self._wishes), self._station.state, lambda found: answers.append((stream, found)))

    def take_up(self) -> bool:
        """Begin to follow what was recognised meanwhile, if anything was; return whether it was asked for.

        Only while the dish is this client's to move.
        """
        found: FollowedSatellite | None = None
        while self._answers:
            stream, answer = self._answers.popleft()
            self._asks = False
            found = answer if stream == self._stream else None
        if found is None or self._satellite is not None or self._pass_of(found) == self._refused:
            return False
        t_s, wish = self._wishes[-1]
        if not found.agrees(wish, t_s):
            return False  # it has gone over to something else meanwhile
        other = self._station.state.pursuit
        if other is not None and other.phase is not Phase.OVER and other.holder != self._holder:
            return False  # it waits for its own pass, and goes on when this client is done
        log.info("%s follows %s", self._holder, found.name)
        self._satellite = found
        self._begun = self._station.submit(Pursue(found.plan, self._holder, found.options, asked=not found.is_far))
        return True

    # The pursuit

    @property
    def _live(self) -> Pursuit | None:
        """The pursuit of this client, over or not; None before there is one."""
        begun, pursuit = self._begun, self._station.state.pursuit
        if begun is None or not begun.done() or begun.cancelled() or begun.exception() is not None:
            return None
        return pursuit if pursuit is not None and pursuit.number == begun.result() else None

    @property
    def _is_live(self) -> bool:
        begun = self._begun
        if begun is not None and not begun.done():
            return True
        live = self._live
        return live is not None and live.phase is not Phase.OVER

    @staticmethod
    def _pass_of(satellite: FollowedSatellite) -> tuple[int, datetime] | None:
        passing = satellite.plan.passing
        return None if passing is None else (satellite.norad_id, passing.aos)

    def _forget(self) -> None:
        if self._begun is not None and self._begun.done() and not self._begun.cancelled():
            error = self._begun.exception()
            if isinstance(error, BirdcageError):
                log.info("%s is not followed: %s", self._holder, error)
        self._satellite = self._begun = None
        self._wishes.clear()
        self._stream += 1
