"""One dialect a file: what to send, what to match, what the dish can do.

The names of the published interface (`docs/reference/published-interface.md`) are found here, loaded when asked for.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from birdcage.protocol.g2 import CarryoutG2Protocol
    from birdcage.protocol.hal import HAL000Protocol, HAL205Protocol
    from birdcage.protocol.protocol import FirmwareProtocol
    from birdcage.protocol.registry import FIRMWARE_REGISTRY, get_protocol
    from birdcage.rotator.values import MOTOR_AZIMUTH, MOTOR_ELEVATION, Position, RssiReading

_HOMES = {
    "CarryoutG2Protocol": "birdcage.protocol.g2",
    "FIRMWARE_REGISTRY": "birdcage.protocol.registry",
    "FirmwareProtocol": "birdcage.protocol.protocol",
    "HAL000Protocol": "birdcage.protocol.hal",
    "HAL205Protocol": "birdcage.protocol.hal",
    "MOTOR_AZIMUTH": "birdcage.rotator.values",
    "MOTOR_ELEVATION": "birdcage.rotator.values",
    "Position": "birdcage.rotator.values",
    "RssiReading": "birdcage.rotator.values",
    "get_protocol": "birdcage.protocol.registry",
}

__all__ = [
    "FIRMWARE_REGISTRY",
    "MOTOR_AZIMUTH",
    "MOTOR_ELEVATION",
    "CarryoutG2Protocol",
    "FirmwareProtocol",
    "HAL000Protocol",
    "HAL205Protocol",
    "Position",
    "RssiReading",
    "get_protocol",
]


def __getattr__(name: str) -> Any:  # noqa: ANN401 - PEP 562
    if name not in _HOMES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(_HOMES[name]), name)
