"""How another program reaches a simulated dish: a pseudo-terminal or TCP. What the server needs of either."""

from __future__ import annotations

from typing import Protocol


class ClientChannel(Protocol):
    """One client at a time. All methods return at once."""

    path: str
    """What a client opens; valid while open."""

    def open(self) -> None:
        """Come into being, perhaps under a new path."""

    def close(self) -> None:
        """Vanish, as an adapter that is pulled out; a second time does nothing."""

    def descriptors(self) -> list[int]:
        """Return what to select for reading."""

    def backlog(self) -> list[int]:
        """Return what to select for writing: not empty while output is left over."""

    def receive(self, descriptor: int) -> bytes:
        """Return what a client sent, after `descriptor` became readable."""

    def baud(self) -> int | None:
        """Return the rate at which the client speaks; None if there is no such thing."""

    def attend(self) -> bool:
        """Free what a client that was killed has left locked; return whether to be asked again soon."""

    def send(self, data: bytes) -> None:
        """Send to the client; without one the bytes are lost, as on a wire."""


LONGEST_BACKLOG = 65536
"""Bytes kept for a client that does not read; older ones are lost."""
