"""A receiver over rigctl that is only listened to: gqrx, SDR++, rigctld. It stays tuned as its owner has it."""

from __future__ import annotations

import math

from birdcage.base.clock import Clock
from birdcage.base.errors import ConfigError
from birdcage.radio.errors import RadioLost, RadioRefused
from birdcage.radio.opening import caller
from birdcage.radio.peer import no_level
from birdcage.radio.rigctl import RigctlClient
from birdcage.signal.meter import MeterError, MeterReading

REPLY_S = 1.0


class RigctlMeter:
    """Asks `l STRENGTH`."""

    def __init__(self, address: str, clock: Clock, *, every_s: float, dwell_s: float = 0.0) -> None:
        self._address, self._clock, self._every_s, self._dwell_s = address, clock, every_s, dwell_s
        self._rig: RigctlClient | None = None
        self._next_at = -math.inf

    def open(self) -> None:
        """Connect."""
        self._next_at = -math.inf
        try:
            _where, call = caller(self._address, self._clock)
            self._rig = RigctlClient(call(REPLY_S), self._clock.monotonic, reply_s=REPLY_S)
        except (ConfigError, RadioLost) as error:
            raise MeterError(str(error)) from error

    def read(self, within_s: float) -> MeterReading | None:
        """Ask when it is time."""
        assert self._rig is not None, "it was opened"
        now = self._clock.monotonic()
        if now < self._next_at:
            self._clock.wait(None, min(now + within_s, self._next_at))
            if self._clock.monotonic() < self._next_at:
                return None
        asked_at = self._clock.monotonic()
        self._next_at = asked_at + self._every_s
        try:
            value = self._rig.strength_db()
        except RadioRefused as refused:
            raise MeterError(no_level(refused.code)) from refused
        except RadioLost as error:
            raise MeterError(str(error)) from error
        return MeterReading(value, (asked_at + self._clock.monotonic() - self._dwell_s) / 2.0, self._dwell_s)

    def close(self) -> None:
        """Hang up."""
        rig, self._rig = self._rig, None
        if rig is not None:
            rig.close()
