"""The control loop of the RP2040 base station: 100 times a second, as its README tells (docs/reference/easycomm.md)."""

from __future__ import annotations

from dataclasses import dataclass

TICK_S = 0.01
KP, KI, KD = 0.15, 0.03, 0.02
DERIVATIVE_FILTER = 0.15
DUTY_SMOOTHING = 0.05
INTEGRAL_MAX_DEG_S = 5.0
DEAD_BAND_DEG = 0.05


@dataclass(slots=True)
class Gains:
    """What both loops share, until it restarts. Duty for a degree, for a degree second, for a degree in a second."""

    kp: float = KP
    ki: float = KI
    kd: float = KD


class PidLoop:
    """The loop of one axis: an error in degrees in, a duty out.

    With the error e of a tick, d <- d + 0.15 ((e - e')/dt - d) and i <- i + e dt within +-5:
    raw = KP e + KI i + KD d within the greatest duty, and 0 within the dead-band; duty <- duty + 0.05 (raw - duty).
    """

    def __init__(self, gains: Gains, duty_max: float) -> None:
        self.gains, self.duty_max = gains, duty_max
        self.duty = 0.0
        self._integral = self._error = self._slope = 0.0

    def clear(self, *, duty: bool = True) -> None:
        """Forget what was: after STOP with the duty, after new gains without it."""
        self._integral = self._error = self._slope = 0.0
        if duty:
            self.duty = 0.0

    def tick(self, error_deg: float) -> float:
        """Return the duty that the motor gets for this tick."""
        self.duty += DUTY_SMOOTHING * (self._raw(error_deg) - self.duty)
        return self.duty

    def _raw(self, error_deg: float) -> float:
        if abs(error_deg) <= DEAD_BAND_DEG:
            self._integral, self._error, self._slope = 0.0, error_deg, 0.0
            return 0.0
        self._slope += DERIVATIVE_FILTER * ((error_deg - self._error) / TICK_S - self._slope)
        self._error = error_deg
        self._integral = _within(self._integral + error_deg * TICK_S, INTEGRAL_MAX_DEG_S)
        gains = self.gains
        return _within(gains.kp * error_deg + gains.ki * self._integral + gains.kd * self._slope, self.duty_max)


def _within(value: float, limit: float) -> float:
    return min(max(value, -limit), limit)
