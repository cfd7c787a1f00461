"""The lines of EasyComm: what is asked, and how the answers look (`docs/reference/easycomm.md`, *Answers*)."""

from __future__ import annotations

import re
from collections.abc import Mapping

from birdcage.console.line_session import LineDialect
from birdcage.rotator.line_probe import LineProbe

AZIMUTH, ELEVATION = "azimuth", "elevation"
AXIS_WORDS = {AZIMUTH: "AZ", ELEVATION: "EL"}
WIRE = LineDialect(b"\n")
SAFE_QUERY = "AZ EL"
"""The only question for the position that no known firmware takes for a move."""
SAFE_STOP = "SA SE"
"""Stops both axes on every known firmware."""

_NUMBER = r"(-?\d+(?:\.\d+)?)"
POSITION = re.compile(rf"AZ ?{_NUMBER}(?: +EL ?{_NUMBER})?(?: .*)?")
"""Both angles on a line, or the azimuth alone with the elevation on the next."""
ELEVATION_ALONE = re.compile(rf"EL ?{_NUMBER}")
TOLD = re.compile(f"{POSITION.pattern}|{ELEVATION_ALONE.pattern}")
"""Whatever may answer a question for the position."""
PIECE = re.compile(r"AZ|EL|\d\.\d")
"""What is left of an angle in a damaged line."""
VERSION = re.compile("VE(.+)")
RECALIBRATED = re.compile(r"EL recalibrated from IMU: (.*)|IMU not found.*")
MONITORED = re.compile(r"AZ_T=(-?\d+) EL_T=(-?\d+) .*")
"""A line of the live stream, which comes between answers."""
PROBE = LineProbe(b"\nVE\n", re.compile(r"VESatNOGS-\S+"), "VE", ("SatNOGS-RP2040", "EL homing: IMU", "AZ_T="))
"""`VE` moves nothing on either firmware; a console of another machine does not know it."""
ZEROED = "Encoders zeroed"
BOOT_MARKS = ("== SatNOGS", "EL homing: IMU", "AZ zeroed (")
"""What the RP2040 prints only when it starts."""


def set_line(to: Mapping[str, float], decimals: int) -> str:
    """Return the line that sends axes to angles in the rotator's own degrees; azimuth first, as the stock one wants."""
    return " ".join(f"{word}{to[axis] + 0.0:.{decimals}f}" for axis, word in AXIS_WORDS.items() if axis in to)
