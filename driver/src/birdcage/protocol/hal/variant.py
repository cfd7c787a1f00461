"""In what the Trav'lers differ, as a table of each (`docs/reference/travler.md`, *Its relatives*)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

NVS = "nvs"
"""The menu of the settings, on all of them."""
SEARCH_MINIMUM, SAFE_MINIMUM = 125, 127
"""The rows of a Trav'ler's settings that hold its lowest elevations: of the search, and the safe one
(`docs/reference/travler.md`, *Elevation*)."""
LOWEST: Mapping[str, int] = {"floor": SAFE_MINIMUM, "floor.search": SEARCH_MINIMUM}
"""The features that those rows hold."""


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
    """The line that ends it there, until the next power-up: see `search_told`."""
    lowest: Mapping[str, int]
    """The rows of its settings that hold its lowest elevations, by the feature that tells them."""
    boot_marks: tuple[str, ...]
    """Words of the line that ends its homing at power-up."""
    root_marks: frozenset[str]
    """Commands that its root's help lists, and no submenu's."""
    root_is_own: bool
    """Whether no other console is known to list all of these."""
    foreign: frozenset[str]
    """Commands that show another firmware, whatever stands beside them."""
    home: str = "root"
    """The menu that its menus lie in, `stow` and `reboot` with them. Not the root: a tunnel that nothing leaves."""
    el_deg: tuple[float, float] = (15.0, 90.0)
    """The lowest elevation that its own moves reach reliably, and the highest."""
    lower_down: str = "Below 15° its own moves are unreliable."
    """What is said of elevations below that, in a sentence."""
    stalls_above: bool = False
    """Whether it stalls higher up, and may lock up."""
    row_may_lower: bool = True
    """Whether a source names the row of its floor: only then does it count where it is lower than `el_deg`."""
    search_told: bool = True
    """Whether a source says that it searches from each power-up on, and that `end_search` ends that."""
    home_told: bool = True
    """Whether each of them homes at power-up."""
    pages: bool = False
    """Whether `d` shows its settings page by page."""
    unlike: frozenset[str] = frozenset()
    """Commands that show another firmware where no root mark stands beside them."""

    @property
    def submenus(self) -> tuple[str, str, str]:
        """Its menus, as far as they are spoken, without the root and the tunnel."""
        return self.motor, self.search, NVS


HAL205 = HalVariant(
    firmware="hal205",
    label="HAL 2.05",
    motor="motor",
    search="ngsearch",
    end_search="s",
    lowest=LOWEST,
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
    lowest=LOWEST,
    boot_marks=("NoGPS",),
    root_marks=frozenset({"mot", NVS}),
    root_is_own=False,
    foreign=frozenset({"ngsearch", "odu", "a3981"}),
)
PRO = HalVariant(
    firmware="pro",
    label="a Trav'ler Pro",
    motor="mot",
    search="os",
    end_search="kill Search",
    boot_marks=(),
    root_marks=frozenset({"odu"}),
    root_is_own=True,
    foreign=frozenset({"ngsearch", "a3981"}),
    home="odu",
    lowest={"floor": 125},
    el_deg=(12.0, 75.0),
    lower_down="The floor of its firmware is 12°; what its moves do below is not known.",
    stalls_above=True,
    row_may_lower=False,  # one example in one README; the same row of a Trav'ler is that of its search
    search_told=False,
    home_told=False,
    pages=True,
)
"""The outdoor unit behind its tunnel; the indoor unit, which answers first, knows none of this."""

VARIANTS = (HAL205, HAL000, PRO)
