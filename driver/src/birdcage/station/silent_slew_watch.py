"""A silent slew: how one knows that it is over without asking, and how it is ended before its time."""

from __future__ import annotations

from birdcage.antenna.antenna import BirdcageAntenna
from birdcage.antenna.motion import DishMotion
from birdcage.antenna.reckoning import FRESH_S
from birdcage.base.errors import NoReply
from birdcage.station.state_store import StateStore

MARGIN_S = 0.5
"""How long after its modelled end it may still run; mechanical seconds."""
TELLING_SHARE = 0.5
"""A prompt that comes before this share of the modelled time does not tell the end: the dish gave it at the start."""
LATE_S = 5.0
"""How long after the longest that it may take the prompt is waited for."""
ANSWER_S = 0.3
MOST_REPEATS = 5


class SilentSlewWatch:
    """Watches one silent slew at a time."""

    def __init__(self, store: StateStore, antenna: BirdcageAntenna) -> None:
        self._store, self._antenna = store, antenna
        self._prompt_at: float | None = None
        self._sent = 0
        """How often its end was asked for."""
        self._over = False

    def begin(self) -> None:
        """A slew begins."""
        self._prompt_at, self._sent, self._over = None, 0, False

    def end(self) -> None:
        """End it where it is, if anything does. Nothing is sent when it is over, or was told to end before."""
        if not self._over and not self._sent and self._antenna.strategy.ends_slew is not None:
            self._ask()

    def _ask(self) -> None:
        self._sent += 1
        order = self._antenna.strategy.ends_slew
        if order is not None:
            self._antenna.rotator.stop_now(order)

    def lasts(self, motion: DishMotion) -> bool:
        """Return whether nothing may be sent yet. A prompt that never came is asked for from then on."""
        if self._over or self._sent:
            return False
        clock = self._store.clock
        now, started, rate = clock.monotonic(), motion.azimuth.started, clock.rate
        if self._prompt_at is None and self._antenna.rotator.slew_is_over():
            self._prompt_at = now
        modelled_s, longest_s = (motion.eta(rate) - started), motion.longest_s / rate
        if self._prompt_at is None:
            if now < started + longest_s + LATE_S:
                return True
            self._ask()
            return False
        reckoning = self._antenna.reckoning
        told = reckoning.told_in(motion)
        if told is not None and (reckoning.is_there(motion) or now < told.at + FRESH_S):
            self._over = reckoning.is_there(motion) and now >= told.at + MARGIN_S / rate
            return not self._over
        tells = self._prompt_at - started >= TELLING_SHARE * modelled_s
        self._over = now >= started + (modelled_s if tells else max(modelled_s, longest_s)) + MARGIN_S / rate
        return not self._over

    def has_prompt(self) -> bool:
        """Wait a moment for the prompt, or ask for it once more. NoReply after five times.

        CommandRefused when the dish has refused the slew, or says that it could not go on.
        """
        if self._over:
            return True
        try:
            self._antenna.rotator.settle(ANSWER_S)
        except NoReply:
            if self._sent >= MOST_REPEATS:
                raise
            self._ask()
            return False
        self._over = True
        self._antenna.rotator.slew_is_over()  # takes note of what it answered
        return True
