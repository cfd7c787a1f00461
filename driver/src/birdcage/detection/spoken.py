"""The dialects that are spoken here, with what their classes tell of the consoles."""

from __future__ import annotations

from collections.abc import Mapping

from birdcage.protocol.protocol import FirmwareProtocol
from birdcage.protocol.registry import FIRMWARE_REGISTRY


def marked() -> Mapping[str, type[FirmwareProtocol]]:
    """Return the dialects whose class tells how their console looks, by firmware."""
    told = ("model", "dialect", "motor_menu")
    return {name: each for name, each in FIRMWARE_REGISTRY.items() if all(hasattr(each, mark) for mark in told)}


def longest_gap_s() -> float:
    """Return how long a console may have to be left alone after a line before it hears another one."""
    return max(protocol.dialect.gap_s for protocol in marked().values())
