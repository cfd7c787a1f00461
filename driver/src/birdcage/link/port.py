"""What a thing must offer to be a port: the seam at which the driver and the simulator meet."""

from __future__ import annotations

from typing import Protocol

from birdcage.base.clock import Endpoint


class Port(Endpoint, Protocol):
    """Bytes in, bytes out. Every method returns at once; waiting is `Clock.wait`'s work.

    All methods raise `birdcage.base.errors.LinkError` (reason ``lost``) once the other end is gone.
    `write` and `read` may be called from different threads at the same time.
    """

    name: str
    """What to call it in a sentence: `/dev/ttyUSB0`, `sim:g2`."""

    demo: bool
    """Whether a simulator stands at the other end (as far as this program knows)."""

    def read(self) -> bytes:
        """Return all bytes that have arrived; empty when there are none."""

    def write(self, data: bytes) -> None:
        """Send `data`; it does not wait for the wire."""

    def discard(self) -> None:
        """Throw away output that has not left and input that was not read."""

    def close(self) -> None:
        """Give the port back; a second time does nothing."""
