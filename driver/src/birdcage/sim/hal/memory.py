"""The Trav'ler's settings memory: the two rows that a source names (`docs/reference/travler.md`, *Settings*)."""

from __future__ import annotations

from dataclasses import dataclass

SEARCH_MINIMUM, SAFE_MINIMUM = 125, 127


@dataclass(frozen=True, slots=True)
class HalSetting:
    """One setting: what it is called (assumed), and the factory's value in degrees."""

    name: str
    default: float


ROWS = {SEARCH_MINIMUM: HalSetting("Search Minimum EL", 15.0), SAFE_MINIMUM: HalSetting("Safe Minimum EL", 15.0)}
"""Both 15: the firmware's floor (`docs/reference/travler.md`, *Elevation*)."""


class HalMemory:
    """RAM and flash. `active` is what the firmware goes by: what was in flash when it started."""

    def __init__(self) -> None:
        self.flash = {index: row.default for index, row in ROWS.items()}
        self.power_on()

    def power_on(self) -> None:
        """Read flash; what was not saved is gone."""
        self.ram = dict(self.flash)
        self.active = dict(self.flash)

    def save(self) -> None:
        """Write RAM to flash."""
        self.flash = dict(self.ram)
