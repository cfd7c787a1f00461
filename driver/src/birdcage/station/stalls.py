"""What a firmware says of a motor that does not turn (reference section 4)."""

from __future__ import annotations

import re

_STALLED = re.compile(r"\b(AZ|EL|SK)\w*\s+MOTOR\s+STALLED\b|\b(AZ|EL|SK)\w*\s+Motor\s+Home\s+Failure\b", re.IGNORECASE)
_NAMES = {"AZ": "azimuth", "EL": "elevation", "SK": "skew"}


def stalled_axis(text: str) -> str | None:
    """Return the name of the axis that a line says is stalled, or has failed to home; None for any other line."""
    found = _STALLED.search(text)
    return None if found is None else _NAMES[(found[1] or found[2]).upper()]
