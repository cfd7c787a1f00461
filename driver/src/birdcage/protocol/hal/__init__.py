"""The Winegard Trav'ler family, which calls its firmware HAL (`docs/reference/travler.md`)."""

from __future__ import annotations

from birdcage.protocol.hal.protocol import HAL000Protocol, HAL205Protocol, TravlerProProtocol

__all__ = ["HAL000Protocol", "HAL205Protocol", "TravlerProProtocol"]
