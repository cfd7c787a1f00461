"""What one client may ask of the dish: the joint between the protocol and the station."""

from __future__ import annotations

from collections.abc import Sequence
from concurrent.futures import Future
from dataclasses import dataclass
from enum import IntFlag
from typing import Protocol


class MoveDirection(IntFlag):
    """The directions of `M`, with the numbers of Hamlib; its diagonals (32 to 256) are two of them at once."""

    UP = 2
    DOWN = 4
    LEFT = 8
    RIGHT = 16


@dataclass(frozen=True, slots=True)
class Advertised:
    r"""The range that `\dump_state` names: as wide as is sensible, since Hamlib's clients drop what lies outside."""

    min_az_deg: float = -180.0
    max_az_deg: float = 450.0
    min_el_deg: float = 0.0
    max_el_deg: float = 90.0


@dataclass(frozen=True, slots=True)
class SignalCounts:
    """The answer to `R n`, in counts of the dish's receiver."""

    reads: int
    average: int
    current: int


class Rotor(Protocol):
    """The dish as one client has it. Nothing here waits; what takes an exchange gives a future.

    Angles are true degrees. Each call, and each future, may raise `RotctldError`.
    """

    def position(self) -> tuple[float, float]:
        """Return azimuth (0 to 360) and elevation: read or modelled, never invented. EIO where neither is known."""

    def set_position(self, az_deg: float, el_deg: float) -> None:
        """Take a wish; elevations beyond 90 are a flip. ERJCTED only where the server is strict."""

    def stop(self) -> None:
        """End the motion of this client, and its control. Another's goes on."""

    def park(self) -> None:
        """Go to the named park position. ENAVAIL where none is set, or it lies in a no-go sector."""

    def move(self, direction: MoveDirection, speed: int) -> None:
        """Go on in a direction for a moment, while this is asked for again. `speed` is 1 to 100, or -1: unchanged."""

    def status(self) -> Sequence[str]:
        """Return the words of Hamlib's `get_status` that are true now: BUSY, MOVING, MOVING_AZ and so on."""

    def name(self) -> str:
        """Return what this dish answers to `_`."""

    def advertised(self) -> Advertised:
        """Return the range that is told to clients."""

    def abilities(self) -> Sequence[str]:
        """Return what `D` lists after `CAPS:`: `rssi`, `lna`, or nothing."""

    def read_signal(self, reads: int) -> Future[SignalCounts]:
        """Have the signal read so often. EIO on a dish without a tuner, ERJCTED while somebody else uses it."""

    def enable_lna(self) -> Future[None]:
        """Switch the supply of the LNB on. EIO on a dish without one, ERJCTED while somebody else uses the tuner."""

    def send(self, line: str) -> Future[Sequence[str]]:
        """Send a harmless line to the dish's own console, and return its lines. ERJCTED for any that is not."""
