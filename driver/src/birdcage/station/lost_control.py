"""Who had control when the link was lost, and whether the dish is still as they left it."""

from __future__ import annotations

from birdcage.base.errors import Held
from birdcage.base.held import HeldReason
from birdcage.station.interruption import Interruption
from birdcage.station.parts import Parts


class LostControl:
    """Lets the holder whom a lost link has interrupted go on, where they chose that beforehand.

    What a person has stopped stays stopped: only the latch of the link is let go of.
    """

    def __init__(self, parts: Parts) -> None:
        self._parts, self._store, self._antenna = parts, parts.store, parts.antenna
        self._holder = ""
        self._cut: Interruption | None = None
        parts.signals.interrupted.connect(self._interrupted)

    def _interrupted(self, reason: HeldReason) -> None:
        holder = self._store.state.holder
        if reason is not HeldReason.LINK:
            self._cut = None  # it has restarted, or the clock has stepped: nothing is as before
        elif holder is not None:
            now, stops = self._store.clock.monotonic(), self._parts.stopper.count
            self._holder, self._cut = holder, Interruption.now(reason, now, stops, self._store.state, self._antenna)

    def go_on(self, holder: str, within_s: float) -> None:
        """Let go of HELD if a loss of the link of at most `within_s` has taken control from `holder`, and nothing else.

        Nothing happens unless the dish is seen at rest where it was left.
        """
        held, cut = self._store.state.held, self._cut
        if within_s <= 0.0 or held is None or held.reason is not HeldReason.LINK or cut is None:
            return
        if holder != self._holder or not cut.is_as_before(self._store.state, within_s):
            return
        self._cut = None
        try:
            self._parts.stopper.release(cut.stops)
        except Held:
            return  # STOP was called meanwhile
        if cut.cable_deg is not None:
            self._antenna.gate.remember_cable(cut.cable_deg)
