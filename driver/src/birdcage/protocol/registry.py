"""Which firmware is spoken by which dialect."""

from __future__ import annotations

from birdcage.protocol.g2 import CarryoutG2Protocol
from birdcage.protocol.hal import HAL205Protocol
from birdcage.protocol.protocol import FirmwareProtocol

FIRMWARE_REGISTRY: dict[str, type[FirmwareProtocol]] = {"hal205": HAL205Protocol, "g2": CarryoutG2Protocol}


def get_protocol(name: str) -> FirmwareProtocol:
    """Return a new dialect by its short name. Raises KeyError, naming those that exist, for any other."""
    if name not in FIRMWARE_REGISTRY:
        raise KeyError(f"no firmware {name!r} here; known: {', '.join(sorted(FIRMWARE_REGISTRY))}")
    return FIRMWARE_REGISTRY[name]()
