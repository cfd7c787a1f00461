"""The Winegard Carryout G2+, and a Carryout of 115200 baud that answers like it (`docs/reference/g2-kin.md`)."""

from __future__ import annotations

from birdcage.protocol.g2plus.protocol import CarryoutG2PlusProtocol

__all__ = ["CarryoutG2PlusProtocol"]
