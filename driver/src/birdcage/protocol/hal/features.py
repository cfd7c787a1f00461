"""What a Trav'ler tells and lets be set besides its position (`docs/reference/travler.md`, *Settings*)."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from birdcage.protocol.generic import end_tv_search
from birdcage.protocol.hal.variant import HAL000, HAL205, NVS, HalVariant
from birdcage.protocol.nvs import row_label
from birdcage.rotator.feature import SETTINGS, Cost, Feature, FeatureKind, FeaturePage, Range, Value
from birdcage.rotator.feature_table import FeatureRow, FeatureTable

if TYPE_CHECKING:
    from birdcage.protocol.hal.protocol import HalProtocol

SEARCH_MINIMUM, SAFE_MINIMUM = 125, 127
"""The rows of its settings that hold its lowest elevations: of the search, and the safe one
(`docs/reference/travler.md`, *Elevation*)."""


LOWEST = {"floor": SAFE_MINIMUM, "floor.search": SEARCH_MINIMUM}
"""The features that those rows hold."""


def _angle(name: str, index: int) -> Callable[[HalProtocol], dict[str, Value]]:
    def read(dish: HalProtocol) -> dict[str, Value]:
        text = dish.read_nvs(index)
        return {} if text is None else {name: float(text)}

    return read


def _lowest(name: str, what: str) -> FeatureRow:
    index = LOWEST[name]
    label = f"Lowest elevation{what} ({row_label(index)})"
    return FeatureRow(
        Feature(
            name, label, "deg", FeatureKind.NUMBER, Range(-90.0, 90.0), cost=Cost(1, NVS),
            page=FeaturePage.SETTINGS, group="Elevation", asked=f"NVS> e {index}",
        ),
        _angle(name, index),
    )  # fmt: skip


def features_of(variant: HalVariant) -> FeatureTable:
    """Return the table of one of the Trav'lers."""
    return FeatureTable(
        _lowest("floor", ""),
        _lowest("floor.search", " of its TV search"),
        end_tv_search(lines=1, menu=variant.search, asked=f"{variant.search.upper()}> {variant.end_search}"),
        FeatureRow(
            Feature(
                SETTINGS, "All settings (NVS)", "", FeatureKind.LINES, cost=Cost(1, NVS),
                page=FeaturePage.SETTINGS, group="All settings", asked="NVS> d",
            ),
            lambda dish: {SETTINGS: "\n".join(dish.settings_table())},
        ),
    )  # fmt: skip


FEATURES_205, FEATURES_000 = features_of(HAL205), features_of(HAL000)
