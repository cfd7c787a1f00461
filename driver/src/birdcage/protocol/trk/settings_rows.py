"""What such a dish tells of its settings, and lets be set, as features (docs/reference/g2-settings.md)."""

from __future__ import annotations

from birdcage.protocol.nvs import DISABLE_TRACKER, NvsRow
from birdcage.rotator.feature import (
    SETTINGS,
    TV_SEARCH,
    Cost,
    Feature,
    FeatureKind,
    FeaturePage,
    Value,
    Writer,
)
from birdcage.rotator.feature_table import FeatureRow

_SEARCH_HAZARD = (
    "This saves NVS 20 in the dish's flash memory, after a backup of all its settings, and counts from the next "
    "power-up on. Off: it no longer homes by itself then, so home it at each power-up. On: it homes and searches then: "
    "it moves by itself."
)


def tv_search_of(row: NvsRow) -> dict[str, Value]:
    """Return whether it searches from the next power-up on, by what is saved in the row."""
    return {TV_SEARCH: row.saved != "TRUE"}


TV_SEARCH_ROW = FeatureRow(
    Feature(
        TV_SEARCH, "TV search at power-up", kind=FeatureKind.SWITCH, writer=Writer.FROM_POWER_UP,
        hazard=_SEARCH_HAZARD, cost=Cost(4, "nvs"), page=FeaturePage.SETTINGS, group="TV search",
        asked=f"NVS> d {DISABLE_TRACKER}",
    ),
    lambda dish: tv_search_of(dish.read_nvs(DISABLE_TRACKER)),
    lambda dish, on: tv_search_of(dish.save_search(disabled=not on)),
)  # fmt: skip
ALL_ROW = FeatureRow(
    Feature(
        SETTINGS, "All settings (NVS)", kind=FeatureKind.LINES, cost=Cost(1, "nvs"),
        page=FeaturePage.SETTINGS, group="All settings", asked="NVS> d",
    ),
    lambda dish: {SETTINGS: "\n".join(dish.settings_table())},
)  # fmt: skip
