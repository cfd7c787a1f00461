"""The Winegard Trav'ler family, which calls its firmware HAL (reference sections 3 and 4)."""

from __future__ import annotations

from birdcage.protocol.hal.protocol import HAL205Protocol

__all__ = ["HAL205Protocol"]
