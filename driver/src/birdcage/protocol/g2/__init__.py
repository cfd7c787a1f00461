"""Winegard Carryout G2, firmware 02.02.48 (docs/reference/g2.md): a room for each menu, and the dialect over them."""

from __future__ import annotations

from birdcage.protocol.g2.protocol import CarryoutG2Protocol

__all__ = ["CarryoutG2Protocol"]
