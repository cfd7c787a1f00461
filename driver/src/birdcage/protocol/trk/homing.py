"""What such a dish prints when it homes (docs/reference/g2-motors.md, *Homing*)."""

from __future__ import annotations

import re
from collections.abc import Iterable

from birdcage.protocol.trk.reading import END, Fields, fields_of
from birdcage.rotator.feature import Value

_WRAP = r"wrap_min:\s*(?P<low>[-+]?\d+)\s+wrap_max:\s*(?P<high>[-+]?\d+)"
_LAST = r"\bAZ\s*-\s*Angle:\s*(?P<angle>[-+]?\d+)\s+Wrap:\s*(?P<turn>[-+]?\d+)"
_FIELDS: Fields = {
    "wrap_min_deg": (re.compile(_WRAP + END), lambda match: int(match["low"]) / 100.0),
    "wrap_max_deg": (re.compile(_WRAP + END), lambda match: int(match["high"]) / 100.0),
    "az_printed": (re.compile(_LAST + END), lambda match: int(match["angle"])),
    "turn": (re.compile(_LAST + END), lambda match: int(match["turn"])),
}


def parse_homing(lines: Iterable[str]) -> dict[str, Value]:
    """Read `wrap_min:-42333 wrap_max:2333` (centidegrees) and `AZ - Angle: 1 Wrap: 0`, wherever they stand.

    `wrap_min_deg` and `wrap_max_deg`: how far the cable lets the azimuth turn from its reference. `az_printed`: where
    it stands at the end, as a G2+ prints it; the unit is not documented. `turn`: on which turn of the cable. What was
    not printed is left out.
    """
    return fields_of("\n".join(lines), _FIELDS)
