"""The Winegard Carryout of 2003, firmware HandEra HAL 1.00.065 (`docs/reference/carryout-2003.md`)."""

from birdcage.protocol.carryout.protocol import CarryoutProtocol

__all__ = ["CarryoutProtocol"]
