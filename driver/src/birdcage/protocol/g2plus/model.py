"""The Carryout G2+ as data (`docs/reference/g2-kin.md`)."""

from __future__ import annotations

from birdcage.protocol.nvs import DISABLE_TRACKER, row_label
from birdcage.protocol.trk.dialect import kin_dialect
from birdcage.protocol.trk.kin_facts import kin_facts
from birdcage.protocol.trk.settings_rows import ALL_ROW, TV_SEARCH_ROW
from birdcage.rotator.facts import SearchSetting, SearchSwitch
from birdcage.rotator.feature import FeatureKind
from birdcage.rotator.feature_table import FeatureTable
from birdcage.rotator.own_settings import SettingKnown, row_id

KNOWN = {
    DISABLE_TRACKER: SettingKnown(
        DISABLE_TRACKER, kind=FeatureKind.SWITCH,
        danger="TRUE switches the TV search off, and homing at power-up with it: home the dish by command then. FALSE "
        "lets it home and search by itself at every power-up.",
    )
}  # fmt: skip
"""The one row that a source tells of."""
FEATURES = FeatureTable(TV_SEARCH_ROW, ALL_ROW)
CARRYOUT_G2_PLUS = kin_facts(
    "Carryout G2+",
    "g2plus",
    search_switch=SearchSwitch.FOR_GOOD,
    search_setting=SearchSetting(
        row_id(DISABLE_TRACKER), row_label(DISABLE_TRACKER), "Disable Tracker Proc", off="TRUE", on="FALSE"
    ),
    features=FEATURES.features,
    has_own_settings=True,
    settings_known=KNOWN,
    settings_name="nvs",
    documented="elevation.min_deg elevation.max_deg search_switch has_own_settings settings_name",
)
DIALECT = kin_dialect(CARRYOUT_G2_PLUS.name, "mot", "nvs")
