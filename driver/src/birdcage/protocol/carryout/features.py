"""What a Carryout of 2003 tells besides its moves (`docs/reference/carryout-2003.md`): its ceiling."""

from __future__ import annotations

from typing import TYPE_CHECKING

from birdcage.protocol.carryout.dialect import NVS
from birdcage.protocol.carryout.going import EL_MAX_ROW, EL_SPAN_DEG, HIGHEST_EL_DEG
from birdcage.protocol.nvs import row_label
from birdcage.rotator.feature import Cost, Feature, FeatureKind, FeaturePage, Range, Value
from birdcage.rotator.feature_table import FeatureRow, FeatureTable

if TYPE_CHECKING:
    from birdcage.protocol.carryout.protocol import CarryoutProtocol


CEILING = "ceiling"


def _ceiling(dish: CarryoutProtocol) -> dict[str, Value]:
    ceiling_deg = dish.read_ceiling()
    return {} if ceiling_deg is None else {CEILING: ceiling_deg}


FEATURES = FeatureTable(
    FeatureRow(
        Feature(
            CEILING, f"Highest elevation ({row_label(EL_MAX_ROW)})", "deg", FeatureKind.NUMBER,
            Range(EL_SPAN_DEG[0], HIGHEST_EL_DEG), cost=Cost(1, NVS),
            page=FeaturePage.SETTINGS, group="Elevation", asked=f"NVS> e {EL_MAX_ROW}",
        ),
        _ceiling,
    ),
)  # fmt: skip
