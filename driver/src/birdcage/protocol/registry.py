"""Which firmware is spoken by which dialect, by entry point (`docs/reference/published-interface.md`)."""

from __future__ import annotations

from birdcage.protocol.protocol import FirmwareProtocol
from birdcage.rotator.machines import DIALECTS, class_of, names_in

FIRMWARE_REGISTRY: dict[str, type[FirmwareProtocol]] = {name: class_of(name) for name in names_in(DIALECTS)}


def get_protocol(name: str) -> FirmwareProtocol:
    """Return a new dialect by its short name. Raises KeyError, naming those that exist, for any other."""
    if name not in FIRMWARE_REGISTRY:
        raise KeyError(f"no firmware {name!r} here; known: {', '.join(sorted(FIRMWARE_REGISTRY))}")
    return FIRMWARE_REGISTRY[name]()
