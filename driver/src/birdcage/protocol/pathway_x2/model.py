"""The Pathway X2 as data (`docs/reference/g2-kin.md`)."""

from __future__ import annotations

import re
from dataclasses import replace

from birdcage.protocol.trk.answers import MoveAnswer
from birdcage.protocol.trk.dialect import kin_dialect
from birdcage.protocol.trk.kin_facts import AZIMUTH, ELEVATION, HOMING_S, kin_facts
from birdcage.rotator.axis import Axis, MeasuredTimes
from birdcage.rotator.feature_table import FeatureTable
from birdcage.rotator.ladder import POWER_SWITCH

LAG_S = 15.0
"""The longest that it was seen to wait before it executes a command: 10 to 15 s at times, and none at others."""
_WAYS_DEG = 1.0, 3.0, 10.0, 30.0, 60.0, 90.0, 180.0, 360.0


def way_s(axis: Axis, way_deg: float) -> float:
    """Return how long a way takes at the slowest that is taken of such dishes, without the lag."""
    return way_deg / axis.speed_deg_s + axis.speed_deg_s / axis.acceleration_deg_s2


def _lagging(axis: Axis) -> Axis:
    """Return an axis whose moves take the longest lag, and the time of the way."""
    steps = tuple((way_deg, LAG_S + way_s(axis, way_deg)) for way_deg in _WAYS_DEG)
    longest_deg, longest_s = steps[-1]
    return replace(
        axis, times=MeasuredTimes(steps, from_deg=2 * longest_deg, scale_s=0.0, per_deg=1.0, less_s=-longest_s)
    )


ANSWER = MoveAnswer(re.compile(r"\bm\s+(?P<motor>[01])\s+a\s+(?P<angle>[-+]?\d+)\s+np\b"), per_deg=100)
"""`m 0  a 17000  np 111714`: motor, angle in hundredths, and probably steps."""
FEATURES = FeatureTable()
"""No source tells of anything that it tells or lets be set."""
PATHWAY_X2 = kin_facts(
    "Pathway X2",
    "pathway-x2",
    axes=(_lagging(AZIMUTH), _lagging(ELEVATION)),
    homing_s=LAG_S + HOMING_S,
    stop_ladder=(POWER_SWITCH,),
)
DIALECT = kin_dialect(PATHWAY_X2.name, "mot", line_end=b"\r\n")
