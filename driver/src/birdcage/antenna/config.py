"""How a caller reaches its dish, and the limits of its own (`docs/reference/published-interface.md`)."""

from __future__ import annotations

from dataclasses import dataclass


class DialectBaud(int):
    """57600, and the mark of not having been given: then the dialect's own baud is used."""


DIALECT_BAUD = DialectBaud(57600)


@dataclass
class AntennaConfig:
    """How to reach the dish, and the caller's own limits."""

    port: str = "/dev/ttyUSB0"
    baudrate: int = DIALECT_BAUD
    min_elevation: float = 15.0
    """Degrees, true; the higher of this and the dish's own limit counts."""
    leapfrog_enabled: bool = True
