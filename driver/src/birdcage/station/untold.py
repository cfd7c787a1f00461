"""What is lost of a machine that does not tell its position, when something comes between it and its target."""

from __future__ import annotations

from contextlib import suppress

from birdcage.antenna.antenna import BirdcageAntenna
from birdcage.antenna.gate import UNTOLD
from birdcage.base.clock import Clock
from birdcage.base.errors import CommandRefused, NoReply

SOON_S = 5.0


def lose_track(antenna: BirdcageAntenna, clock: Clock) -> None:
    """Whether its motion goes on, and where it ends, nothing will tell: only until when it may last is known."""
    if antenna.motion is not None:
        antenna.reckoning.abandon(antenna.motion, clock.monotonic(), clock.rate)
        antenna.motion = None
        antenna.gate.forget(UNTOLD)


def is_soon_over(antenna: BirdcageAntenna, clock: Clock) -> bool:
    """Return whether a move is best left alone: it ends within seconds, and where is known only then."""
    if antenna.kind.tells_at_rest:
        return False
    motion = antenna.motion
    return motion is None or (motion.start_known and motion.eta(clock.rate) - clock.monotonic() <= SOON_S)


def end_motion(antenna: BirdcageAntenna, clock: Clock) -> None:
    """Stop what moves as far as that can be done, and hold nothing."""
    unheard = () if antenna.kind.tells_at_rest else (NoReply,)
    # Refused, it ends its move, or takes no new target: then it rests where it was sent.
    with suppress(CommandRefused, *unheard):
        antenna.stop()
    if not antenna.kind.tells_at_rest:
        lose_track(antenna, clock)
