"""The questions about the horizon: a point that is typed, and whether to clear it."""

from __future__ import annotations

import math
import re

from birdcage.sky.horizon import HorizonMask

from birdcage_tui.shown.horizon_state import count_text
from birdcage_tui.widgets.fields_screen import FieldRow, FieldsScreen, Values

EXAMPLE = "azimuth and elevation: 231 12.3"
_TIGHT_COMMA = re.compile(r"(?<=\d),(?=\d)")


def point_of(text: str) -> tuple[float, float]:
    """Return the azimuth and elevation that were typed. ValueError says what to type instead."""
    plain = text.replace("°", " ").replace("−", "-")
    words = re.split(r"[\s/;]+|,\s+", plain.strip())
    if len(words) == 1 and len(_TIGHT_COMMA.findall(words[0])) == 1:
        words = _TIGHT_COMMA.split(words[0])
    try:
        az_deg, el_deg = (float(_TIGHT_COMMA.sub(".", word)) for word in words if word)
    except ValueError:
        raise ValueError(f"Type two numbers in degrees, {EXAMPLE}.") from None
    if not (math.isfinite(az_deg) and math.isfinite(el_deg)):
        raise ValueError(f"Type two numbers in degrees, {EXAMPLE}.")
    if abs(az_deg) > 360.0:
        raise ValueError(f"Azimuth {az_deg:g}° is beyond a full turn. Type 0 to 360.")
    if abs(el_deg) > 90.0:
        raise ValueError(f"Elevation {el_deg:g}° is out of range. Type 0 (horizon) to 90 (zenith).")
    return az_deg % 360.0, el_deg


def point() -> FieldsScreen:
    """Return the form for a point."""

    def check(values: Values) -> str:
        try:
            point_of(values[0])
        except ValueError as wrong:
            return str(wrong)
        return ""

    words = (
        "The top of a tree or a roof, in true degrees. Straight lines join the points. The horizon limits passes, not "
        "motion."
    )
    return FieldsScreen("Horizon point", words, (FieldRow("az el", "", EXAMPLE),), check)


def clear(mask: HorizonMask) -> tuple[str, str, str]:
    """Return title, words and consent of clearing the horizon."""
    words = (
        f"This deletes {count_text(mask)} and makes the horizon flat. Passes then count as in reach behind trees. "
        "z restores the points while the app runs. Nothing moves."
    )
    return "Clear the horizon", words, "make it flat"
