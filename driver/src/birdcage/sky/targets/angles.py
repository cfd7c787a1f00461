"""Angles as people type them: `83.63`, `+22d00m52s`, `5h34.5m`, `5:34:32`, `22°`."""

from __future__ import annotations

import re

_NUMBER = r"\d+(?:\.\d*)?|\.\d+"
_SEXAGESIMAL = re.compile(
    rf"""(?P<sign>[+\-−]?)\s*
    (?P<first>{_NUMBER})\s*(?P<unit>[hd°:]?)\s*
    (?:(?P<minutes>{_NUMBER})\s*[m'′:]?\s*)?
    (?:(?P<seconds>{_NUMBER})\s*(?:s|"|″)?\s*)?""",
    re.VERBOSE | re.IGNORECASE,
)


def angle_deg(text: str, *, hours: bool = False) -> float:
    """Return an angle in degrees. ValueError with a sentence for what is none.

    A bare number is degrees. `h` makes it hours, and with `hours` (a right ascension) so do colons; parts after the
    first are minutes and seconds, under 60.
    """
    found = _SEXAGESIMAL.fullmatch(text.strip())
    if found is None:
        raise ValueError(f"{text.strip()!r} is not an angle. Type 83.63, 22d01m or 5h34m32s.")
    unit = found["unit"].lower()
    rest = [float(found[name] or 0.0) for name in ("minutes", "seconds")]
    if not unit and found["minutes"]:
        raise ValueError(f"{text.strip()!r}: type 5h34m or 5d34m.")
    if max(rest) >= 60.0:
        raise ValueError(f"{text.strip()!r} has 60 minutes or seconds, or more.")
    value = float(found["first"]) + rest[0] / 60.0 + rest[1] / 3600.0
    if unit == "h" or (hours and unit == ":"):
        value *= 15.0
    return -value if found["sign"] in {"-", "−"} else value
