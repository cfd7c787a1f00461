"""Lines of a sweep by the firmware itself: `adc scan`, `mot azscan`, `mot azscanwxp`.

Source: docs/reference/g2-motors.md, *Sweeps*.

The form is quoted for `adc scan`; no source has seen the other two print.
"""

from __future__ import annotations

import re
from dataclasses import dataclass

from birdcage.protocol.trk.reading import NUMBER
from birdcage.protocol.unhomed import is_unhomed

_POINT = re.compile(
    rf"Motor:\s*(?P<motor>\d)\s+Angle:\s*(?P<angle>[-+]?\d+)\s+RSSI:\s*(?P<rssi>\d+)\s+Lock:\s*(?P<lock>[01])\s+"
    rf"SNR:\s*(?P<snr>{NUMBER})\s+Scan Delta:\s*(?P<delta>[-+]?\d+)(?!\S)"
)


@dataclass(frozen=True, slots=True)
class ScanPoint:
    """One point of a sweep, in the dish's own frame."""

    motor: int
    angle_deg: float | None
    """None when the axis is not homed."""
    rssi_counts: int
    locked: bool
    snr_db: float
    step_deg: float


def parse_scan_point(line: str) -> ScanPoint | None:
    """Read `Motor:0 Angle:18000 RSSI:523 Lock:0 SNR:0 Scan Delta:100`; None for a line of any other form."""
    match = _POINT.search(line)
    if match is None:
        return None
    angle = int(match["angle"])
    return ScanPoint(
        motor=int(match["motor"]),
        angle_deg=None if is_unhomed(angle) else angle / 100.0,
        rssi_counts=int(match["rssi"]),
        locked=match["lock"] == "1",
        snr_db=float(match["snr"]),
        step_deg=int(match["delta"]) / 100.0,
    )
