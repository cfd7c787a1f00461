"""Reads the dish's own tuner within a pursuit, while the dish stands still on its target."""

from __future__ import annotations

import math

from birdcage.antenna.antenna import BirdcageAntenna
from birdcage.base.errors import CommandRefused, NoReply
from birdcage.rotator.feature import RSSI, SNR
from birdcage.station.dish_reader import DishReader
from birdcage.station.state_store import StateStore
from birdcage.station.watches import NONSENSE, RSSI_PERIOD_S, RSSI_READS, Watches
from birdcage.tracking.steps import Hear

TAKES_S = RSSI_READS * RSSI_PERIOD_S + 2.0
"""An excursion with its changes of menu, on a slow wire; so long at least the dish must have nothing to do."""


SNR_EVERY = 3
"""In so many excursions the SNR is read once."""


class SignalExcursion:
    """One excursion at a time: `carry_out` until it is over."""

    def __init__(self, store: StateStore, antenna: BirdcageAntenna, reader: DishReader, watches: Watches) -> None:
        self._store, self._antenna, self._reader, self._watches = store, antenna, reader, watches
        self._refused = False
        """Whether the tuner has refused to be read since the pursuit began."""
        self._tells_no_snr = False
        """Whether it has refused the SNR alone, or told nonsense of it."""
        self._begun_at = -math.inf
        self._visits = 0
        self.under_way = False

    def forget(self) -> None:
        """A pursuit begins, or goes on."""
        self._refused = self.under_way = self._tells_no_snr = False

    def due(self, now: float) -> float:
        """Return when to read next, `now` for at once; monotonic seconds."""
        excursion = self._watches.excursion
        return now if excursion is None or not self.under_way else excursion.next_at

    def _begin(self, step: Hear, now_s: float) -> bool:
        """Return whether the tuner is to be read now: the dish is seen at rest, and stays so for long enough."""
        store, clock, now = self._store, self._store.clock, self._store.clock.monotonic()
        dish, motion = store.state.dish, self._antenna.motion
        if dish is None or not dish.has_rssi or self._refused or not self._reader.may_leave:
            return False
        if self._reader.rules.feed.signal != "tuner":
            return False  # it is not the tuner that hears this feed
        if (step.until_s - now_s) / clock.rate < TAKES_S or now < self._begun_at + step.every_s:
            return False
        here = store.state.position
        moves = motion is not None and (here is None or here.told_at < motion.eta(clock.rate))
        if moves or not self._antenna.rest.rests or not self._watches.may_begin(now):
            return False
        self._begun_at, self.under_way = now, True
        # In the place of a reading, as a longer visit would leave the position older than two seconds.
        self._visits += 1
        tells_snr = SNR in dish.features and not self._tells_no_snr and self._visits % SNR_EVERY == 0
        todo = [RSSI] * (RSSI_READS - 1) + [SNR if tells_snr else RSSI]
        self._watches.begin(todo, now)
        self._reader.elsewhere = True  # STOP has to come back to the motor menu first, and look
        return True

    def carry_out(self, step: Hear, now_s: float, *, at_once: bool) -> bool:
        """Begin an excursion if it is time for one, read once, and return whether it is over, if there was one.

        `at_once`: read no more, and come back. NoReply if the dish does not answer.
        """
        if not self.under_way and not self._begin(step, now_s):
            return True
        if at_once:
            self.end()
        else:
            self._read()
        return not self.under_way

    def _read(self) -> None:
        """Read once; the last time, come back to the motor menu. NoReply where the dish does not answer."""
        excursion = self._watches.excursion
        assert excursion is not None, "it is under way"
        name = excursion.todo.popleft()
        try:
            self._reader.features([name])
        except CommandRefused as refused:
            if refused.trouble is not None:
                raise
            if name == RSSI:
                self._refused = True
                self.end()
                return
            self._tells_no_snr = True
        except NoReply as damaged:
            if name == RSSI or damaged.reason not in NONSENSE or not self._reader.may_leave:
                self.under_way = False
                self._watches.end_excursion()
                raise
            self._tells_no_snr = True
        self._watches.was_asked(name, self._store.clock.monotonic(), not_before=self._reader.not_before(name))
        if self._watches.excursion is None:
            self.end()

    def end(self) -> None:
        """Come back to the motor menu, if it was left."""
        self._watches.end_excursion()
        if self.under_way:
            self.under_way = False
            self._antenna.rotator.make_ready()
            self._reader.elsewhere = self._watches.is_away = False
