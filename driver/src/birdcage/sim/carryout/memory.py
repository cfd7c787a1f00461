"""The settings memory of a Carryout of 2003: the two rows that its owner speaks of."""

from __future__ import annotations

from dataclasses import dataclass

from birdcage.sim.carryout.knobs import CarryoutSettings

EL_MAX = 102
"""Highest elevation (`docs/reference/carryout-2003.md`, *Limits*)."""


@dataclass(frozen=True, slots=True)
class CarryoutSetting:
    """One setting: what it is called (assumed), and the factory's value."""

    name: str
    default: float


class CarryoutMemory:
    """RAM and flash. `active` is what the firmware goes by (setting `nvs_applies`)."""

    def __init__(self, settings: CarryoutSettings) -> None:
        self._applies = settings.nvs_applies
        self._tracking = settings.tracking_row
        self.rows = {
            self._tracking: CarryoutSetting("Disable Tracking", 0.0),
            EL_MAX: CarryoutSetting("Maximum EL", settings.el_max),
        }
        self.flash = {index: row.default for index, row in self.rows.items()}
        self.power_on()

    @property
    def tracks(self) -> bool:
        """Whether it homes and searches at power-up."""
        return not self.active[self._tracking]

    def power_on(self) -> None:
        """Read flash; what was not saved is gone."""
        self.ram = dict(self.flash)
        self.active = dict(self.flash)

    def write(self, index: int, value: float) -> None:
        """Change a setting in RAM."""
        self.ram[index] = value
        if self._applies == "write":
            self.active[index] = value

    def save(self) -> None:
        """Write RAM to flash."""
        self.flash = dict(self.ram)
        if self._applies == "save":
            self.active = dict(self.flash)
