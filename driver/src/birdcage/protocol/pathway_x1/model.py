"""The Pathway X1 as data (`docs/reference/g2-kin.md`)."""

from __future__ import annotations

from birdcage.protocol.trk.dialect import kin_dialect
from birdcage.protocol.trk.kin_facts import kin_facts
from birdcage.rotator.feature_table import FeatureTable

FEATURES = FeatureTable()
"""No source tells of anything that it tells or lets be set."""
PATHWAY_X1 = kin_facts("Pathway X1", "pathway-x1")
DIALECT = kin_dialect(PATHWAY_X1.name, "mot")
