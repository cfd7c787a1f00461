"""What a receiver is to be tuned to, and when."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Tuning:
    """One pass, as a receiver sees it. Times are POSIX seconds of UTC."""

    name: str
    """Of the satellite."""
    downlink_hz: float
    """As sent."""
    shift_hz: Callable[[float], float | None]
    """The Doppler of it at a time, positive while it comes near; None if unknown. Called on the receiver's
    thread, ten times a second."""
    start_s: float
    """When it comes into reach: AOS is told then."""
    end_s: float
    """When it is out of reach for good: LOS is told then, and the receiver let go."""
    lo_hz: float = 0.0
    """Of the converter before the receiver; 0: there is none."""

    def wanted_hz(self, at_s: float) -> tuple[float, float | None]:
        """Return where the receiver belongs, and the Doppler in it.

        With an oscillator above the downlink (C band) what comes out is oscillator less downlink, and a satellite
        that comes near goes down in frequency.
        """
        shift_hz = self.shift_hz(at_s)
        return abs(self.downlink_hz + (shift_hz or 0.0) - self.lo_hz), shift_hz

    def is_same_pass(self, other: Tuning) -> bool:
        """Whether `other` is the same pass, planned anew: then a recording goes on."""
        return self.name == other.name and self.start_s < other.end_s and other.start_s < self.end_s
