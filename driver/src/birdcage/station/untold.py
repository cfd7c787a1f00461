"""What is lost of a machine that does not tell its position, when something comes between it and its target."""

from __future__ import annotations

from birdcage.antenna.antenna import BirdcageAntenna
from birdcage.antenna.gate import UNTOLD
from birdcage.base.clock import Clock


def lose_track(antenna: BirdcageAntenna, clock: Clock) -> None:
    """Whether its motion goes on, and where it ends, nothing will tell: only until when it may last is known."""
    if antenna.motion is not None:
        antenna.reckoning.abandon(antenna.motion, clock.monotonic(), clock.rate)
        antenna.motion = None
        antenna.gate.forget(UNTOLD)
