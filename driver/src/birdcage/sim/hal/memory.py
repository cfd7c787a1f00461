"""The settings memory of a Trav'ler: the rows that a source names (`docs/reference/travler.md`, *Settings*)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

SEARCH_MINIMUM, SAFE_MINIMUM = 125, 127
STOW_AZ, STOW_EL, MAXIMUM = 98, 99, 102


@dataclass(frozen=True, slots=True)
class HalSetting:
    """One setting: what it is called (assumed), and the factory's value in degrees."""

    name: str
    default: float


ROWS = {SEARCH_MINIMUM: HalSetting("Search Minimum EL", 15.0), SAFE_MINIMUM: HalSetting("Safe Minimum EL", 15.0)}
"""Both 15: the firmware's floor (`docs/reference/travler.md`, *Elevation*)."""
PRO_ROWS = {
    STOW_AZ: HalSetting("Stow AZ", 0.0),
    STOW_EL: HalSetting("Stow EL", 0.0),
    MAXIMUM: HalSetting("Maximum EL", 90.0),
    SEARCH_MINIMUM: HalSetting("Minimum EL", 12.0),
}
"""Of a Trav'ler Pro: that it keeps these is written, and 125 as the row of one (`docs/reference/travler-pro.md`)."""


class HalMemory:
    """RAM and flash. `active` is what the firmware goes by: what was in flash when it started."""

    def __init__(self, rows: Mapping[int, HalSetting]) -> None:
        self.rows = rows
        self.flash = {index: row.default for index, row in rows.items()}
        self.power_on()

    def power_on(self) -> None:
        """Read flash; what was not saved is gone."""
        self.ram = dict(self.flash)
        self.active = dict(self.flash)

    def save(self) -> None:
        """Write RAM to flash."""
        self.flash = dict(self.ram)
