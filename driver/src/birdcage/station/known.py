"""What this version knows of firmwares and ports: for the faces, which do not look below the station."""

from __future__ import annotations

from typing import TYPE_CHECKING

from birdcage.link.opening import has_speed
from birdcage.link.ports import PortInfo, list_ports
from birdcage.link.system import Hindrance, SystemFacts, look_at_system
from birdcage.rotator import machines
from birdcage.rotator.facts import CableTurn, Facts, SearchSetting, SearchSwitch
from birdcage.rotator.feature import speed_of
from birdcage.rotator.own import laid_by_owner

if TYPE_CHECKING:
    from birdcage.base.config import Settings

__all__ = [
    "CableTurn",
    "Facts",
    "Hindrance",
    "PortInfo",
    "SearchSetting",
    "SearchSwitch",
    "SystemFacts",
    "has_speed",
    "list_firmwares",
    "list_models",
    "list_ports",
    "look_at_system",
    "model_of",
    "speed_of",
    "wrong_facts",
]  # fmt: skip


def list_firmwares() -> tuple[str, ...]:
    """Return the short names of the firmwares that this version speaks."""
    return machines.names()


def list_models() -> tuple[Facts, ...]:
    """Return what each of those firmwares drives, in the same order."""
    return tuple(map(machines.facts_of, machines.names()))


def model_of(firmware: str | None, settings: Settings | None = None) -> Facts | None:
    """Return what a firmware drives; None for none, and for one that this version does not speak.

    With settings: as its owner says that it is, in `[dish.facts]`.
    """
    model = next((model for model in list_models() if model.firmware == firmware), None)
    return model if model is None or settings is None else laid_by_owner(model, settings.own_facts)[0]


def wrong_facts(firmware: str | None, settings: Settings) -> tuple[str, ...]:
    """Return a sentence for each fact of the owner's that can't count for such a dish."""
    model = model_of(firmware)
    return () if model is None else laid_by_owner(model, settings.own_facts)[1]
