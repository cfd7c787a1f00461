"""What clients are told of where the dish is: read or modelled, over a short loss of the link the last of it."""

from __future__ import annotations

import logging

from birdcage.rotctld.options import RotctldOptions
from birdcage.rotctld.rprt import RotctldError, Rprt
from birdcage.station.state import LinkPhase, Pointing, StationState

log = logging.getLogger("birdcage.rotctld")


class SeenDish:
    """Looks at states of the station, one after the other; asks the dish for nothing. For one thread."""

    def __init__(self, options: RotctldOptions) -> None:
        self._options = options
        self._last: Pointing | None = None
        """Where it was when it was last seen."""
        self._lost_at: float | None = None
        """Since when it is out of sight; None while it is seen, or never was."""

    @property
    def is_out_of_sight(self) -> bool:
        """Whether the link to a dish that was seen before is lost."""
        return self._lost_at is not None

    def look(self, state: StationState, now: float) -> Pointing | None:
        """Take in what is known at a monotonic time; return where the dish is, as `known_position` does."""
        here = known_position(state)
        if here is not None:
            if self._lost_at is not None:
                log.info("the dish is back in sight after %.1f s", now - self._lost_at)
            self._last, self._lost_at = here, None
        elif state.link.state is LinkPhase.UP:
            self._last = self._lost_at = None  # it answers, and does not know where it points
        elif self._last is not None and self._lost_at is None:
            self._lost_at = min(state.link.since, now)
            log.warning("the link is lost: clients get the last position for %.0f s", self._held_s)
        return here

    @property
    def _held_s(self) -> float:
        return self._options.gap_s if self._options.gap == "hold" else 0.0

    def is_held_over(self, now: float) -> bool:
        """Return whether the link is lost, and clients go on as if it were not."""
        return self._lost_at is not None and now - self._lost_at < self._held_s

    def position(self, state: StationState, now: float) -> Pointing:
        """Return where the dish is. EIO where that is not known, ETIMEOUT while it does not answer."""
        here = self.look(state, now)
        if here is not None:
            return here
        if self._last is not None and self.is_held_over(now):
            return self._last
        raise self.error(state)

    @staticmethod
    def error(state: StationState) -> RotctldError:
        """Return why nothing is known of the dish."""
        if state.link.state is LinkPhase.SILENT:
            return RotctldError(Rprt.ETIMEOUT, f"The dish does not answer: {state.link.detail}")
        if state.link.state is not LinkPhase.UP:
            return RotctldError(Rprt.EIO, f"No link to the dish: {state.link.detail}")
        return RotctldError(Rprt.EIO, f"The dish's position is not known ({state.position_lost or 'not read yet'}).")


def known_position(state: StationState) -> Pointing | None:
    """Return where the dish is, as it was read or is modelled; None where that is not known, or holds no more."""
    if state.link.state is not LinkPhase.UP or state.position_lost is not None:
        return None
    return state.position
