"""What the firmwares of one maker have in common."""

from __future__ import annotations

import re

MOTOR_TROUBLES = (
    (re.compile(r"\b(?P<axis>AZ|EL|SK)\w*\s+MOTOR\s+STALLED\b", re.IGNORECASE), False),
    (re.compile(r"\b(?P<axis>AZ|EL|SK)\w*\s+Motor\s+Home\s+Failure\b", re.IGNORECASE), True),
)
"""A motor that does not turn, and one that does not find its reference (`docs/reference/travler.md`, *Faults*)."""
AXIS_NAMES = {"AZ": "azimuth", "EL": "elevation", "SK": "skew"}


def angle_text(degrees: float) -> str:
    """Return an angle as these consoles are sent it."""
    return f"{degrees:.2f}".replace("-0.00", "0.00")
