"""What a Trav'ler tells and lets be set besides its position (`docs/reference/travler.md`, *Settings*)."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from birdcage.protocol.generic import end_tv_search
from birdcage.protocol.hal.variant import NVS, VARIANTS, HalVariant
from birdcage.protocol.nvs import row_label
from birdcage.rotator.feature import SETTINGS, Cost, Feature, FeatureKind, FeaturePage, Range, Value
from birdcage.rotator.feature_table import FeatureRow, FeatureTable

if TYPE_CHECKING:
    from birdcage.protocol.hal.protocol import HalProtocol

_WHAT = {"floor": "", "floor.search": " of its TV search"}
_PAGES = 20
"""The most lines that a listing page by page takes."""


def _angle(name: str, index: int) -> Callable[[HalProtocol], dict[str, Value]]:
    def read(dish: HalProtocol) -> dict[str, Value]:
        text = dish.read_nvs(index)
        return {} if text is None else {name: float(text)}

    return read


def _lowest(name: str, index: int) -> FeatureRow:
    label = f"Lowest elevation{_WHAT[name]} ({row_label(index)})"
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
        *(_lowest(name, index) for name, index in variant.lowest.items()),
        end_tv_search(lines=1, menu=variant.search, asked=f"{variant.search.upper()}> {variant.end_search}"),
        FeatureRow(
            Feature(
                SETTINGS, "All settings (NVS)", "", FeatureKind.LINES, cost=Cost(_PAGES if variant.pages else 1, NVS),
                page=FeaturePage.SETTINGS, group="All settings", asked="NVS> d",
            ),
            lambda dish: {SETTINGS: "\n".join(dish.settings_table())},
        ),
    )  # fmt: skip


FEATURES = {variant.firmware: features_of(variant) for variant in VARIANTS}
