"""What this version knows of firmwares and ports: for the faces, which do not look below the station."""

from __future__ import annotations

from birdcage.link.opening import has_speed
from birdcage.link.ports import PortInfo, list_ports
from birdcage.link.system import Hindrance, SystemFacts, look_at_system
from birdcage.protocol.model import DishModel, SearchSwitch, Turn
from birdcage.protocol.registry import FIRMWARE_REGISTRY

__all__ = [
    "DishModel", "Hindrance", "PortInfo", "SearchSwitch", "SystemFacts", "Turn", "has_speed", "list_firmwares",
    "list_models", "list_ports", "look_at_system", "model_of",
]  # fmt: skip


def list_firmwares() -> tuple[str, ...]:
    """Return the short names of the firmwares that this version speaks."""
    return tuple(sorted(FIRMWARE_REGISTRY))


def list_models() -> tuple[DishModel, ...]:
    """Return what each of those firmwares drives, in the same order."""
    return tuple(FIRMWARE_REGISTRY[name].model for name in list_firmwares())


def model_of(firmware: str | None) -> DishModel | None:
    """Return what a firmware drives; None for none, and for one that this version does not speak."""
    return next((model for model in list_models() if model.firmware == firmware), None)
