"""What the G2 prints when it homes (docs/reference/g2-motors.md, *Homing*)."""

from __future__ import annotations

import re
from collections.abc import Iterable

from birdcage.protocol.g2.motor_values import HomingReport
from birdcage.protocol.g2.reading import END

_WRAP = re.compile(rf"wrap_min:\s*([-+]?\d+)\s+wrap_max:\s*([-+]?\d+){END}")
_END = re.compile(rf"\bAZ\s*-\s*Angle:\s*([-+]?\d+)\s+Wrap:\s*([-+]?\d+){END}")


def parse_homing(lines: Iterable[str]) -> HomingReport:
    """Read `wrap_min:-42333 wrap_max:2333` (centidegrees) and `AZ - Angle: 1 Wrap: 0`, wherever they stand."""
    text = "\n".join(lines)
    wrap, end = _WRAP.search(text), _END.search(text)
    return HomingReport(
        wrap_min_deg=int(wrap[1]) / 100.0 if wrap else None,
        wrap_max_deg=int(wrap[2]) / 100.0 if wrap else None,
        az_printed=int(end[1]) if end else None,
        turn=int(end[2]) if end else None,
    )
