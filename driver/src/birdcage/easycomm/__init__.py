"""EasyComm over USB: the RP2040 base station and the stock SatNOGS controller (`docs/reference/easycomm.md`)."""

from __future__ import annotations

from birdcage.easycomm.rotator import EasycommRotator

__all__ = ["EasycommRotator"]
