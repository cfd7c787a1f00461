"""Where STOP aims: just ahead of a machine, by its modelled motion or by two readings (decision 0004)."""

from __future__ import annotations

from typing import TYPE_CHECKING

from birdcage.antenna.motion import rest_seen
from birdcage.rotator.ladder import StopBy, StopOrder
from birdcage.rotator.values import Position

if TYPE_CHECKING:
    from birdcage.antenna.antenna import BirdcageAntenna


class StopAim:
    """Of one antenna."""

    def __init__(self, antenna: BirdcageAntenna) -> None:
        self._antenna = antenna

    def order(self) -> StopOrder | None:
        """Return what stops the motion under way, computed for this moment; None at rest. Any thread.

        Where moves queue, that of one axis can't be called back: None too. What ends a silent slew leaves its model
        alone; any other motion is modelled as stopped from then on, so that a second STOP aims where the first did.
        """
        antenna = self._antenna
        with antenna.moving.lock:
            if antenna.motion is None:
                return None
            if antenna.strategy.commands:
                self.model_stopped()
                return StopOrder(StopBy.COMMAND)
            if antenna.motion.silent:
                return antenna.strategy.ends_slew
            if antenna.strategy.one_at_a_time:
                return None
            self.model_stopped()
            return self._retarget(*antenna.motion.rest)

    def model_stopped(self) -> None:
        """Model the motion under way as braking from now on, unless it is silent. Any thread."""
        antenna, clock = self._antenna, self._antenna.rotator.clock
        antenna.moving.correct(
            lambda motion: motion if motion.silent else motion.stopped(clock.monotonic(), clock.rate)
        )

    def order_seen(self, earlier: Position, earlier_at: float, later: Position, later_at: float) -> StopOrder:
        """Return what stops an unasked motion, from two readings of the dish's own angles."""
        rotator = self._antenna.rotator
        now, rate = rotator.clock.monotonic(), rotator.clock.rate
        return self._retarget(*rest_seen(rotator.facts, earlier, earlier_at, later, later_at, now, rate))

    def _retarget(self, az_deg: float, el_deg: float) -> StopOrder:
        self._antenna.commands.forget_aims()
        gate = self._antenna.gate  # an axis may rest a little beyond its limit, where it cannot be sent
        low, high = gate.el_limits_deg
        el_deg = min(max(el_deg, low), high)
        return StopOrder(StopBy.RETARGET, self._antenna.rotator.retarget(az_deg, el_deg))
