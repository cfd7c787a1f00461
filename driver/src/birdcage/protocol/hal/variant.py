"""In what the Trav'lers differ, as a table of each (`docs/reference/travler.md`, *Its relatives*)."""

from __future__ import annotations

from dataclasses import dataclass

NVS = "nvs"
"""The menu of the settings, on all of them."""


@dataclass(frozen=True, slots=True)
class HalVariant:
    """One of the firmwares that call themselves HAL: its menus, its words, and how its TV search is ended."""

    firmware: str
    label: str
    """How a sentence calls it: `HAL 2.05`."""
    motor: str
    """The menu of moves and positions."""
    search: str
    """The menu in which its TV search is ended."""
    end_search: str
    """The line that ends it there, until the next power-up."""
    boot_marks: tuple[str, ...]
    """Words of the line that ends its homing at power-up."""
    root_marks: frozenset[str]
    """Commands that its root's help lists, and no submenu's."""
    root_is_own: bool
    """Whether no other console is known to list all of these."""
    foreign: frozenset[str]
    """Commands that show another firmware, whatever stands beside them."""
    unlike: frozenset[str] = frozenset()
    """Commands that show another firmware where no root mark stands beside them."""

    @property
    def submenus(self) -> tuple[str, str, str]:
        """Its menus below the root, as far as they are spoken."""
        return self.motor, self.search, NVS


HAL205 = HalVariant(
    firmware="hal205",
    label="HAL 2.05",
    motor="motor",
    search="ngsearch",
    end_search="s",
    boot_marks=("NoGPS", "No LNB Voltage"),
    root_marks=frozenset({"motor", "ngsearch"}),
    root_is_own=True,
    foreign=frozenset(),
    unlike=frozenset({"mot", "odu"}),
)
HAL000 = HalVariant(
    firmware="hal000",
    label="HAL 0.0.00",
    motor="mot",
    search="os",
    end_search="kill Search",
    boot_marks=("NoGPS",),
    root_marks=frozenset({"mot", NVS}),
    root_is_own=False,
    foreign=frozenset({"ngsearch", "odu", "a3981"}),
)
