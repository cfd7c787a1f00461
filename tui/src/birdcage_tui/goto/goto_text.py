"""What a person may type into the go-to line, and what it means. Pure: text in, a wish or a sentence out."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

from birdcage.base.geometry import wrap_360
from birdcage.base.presets import Preset
from birdcage.sky.targets.direction import WINDS, AxisWish, Wish, read_direction
from birdcage.station.state import StationState

EXAMPLES = "180 45, az=180, S 40, +5 -2, moon, 28.2E, a preset"

_SKEW = re.compile(r"\s*(?:skew|sk)\b", re.IGNORECASE)
_NUMBERS = re.compile(
    r"""[-+−]?[\d.,]*°?                               # one number
    | [-+−]?[\d.,]+°?[\s,;/][-+−\d.,;/\s°º]*         # several
    | (?:azimuth|elevation|az|el|a|e)\s*[=:].*       # with the axis before it""",
    re.IGNORECASE | re.VERBOSE,
)
_LARGEST_ANGLE = 360


@dataclass(frozen=True, slots=True)
class GotoAim:
    """A wish made whole: true degrees."""

    az_deg: float
    el_deg: float
    name: str = ""
    """Of the preset or the target that was named, if one was."""
    skew: str = ""
    """How far to turn a feed for a slot that was named."""


def wind_of(az_deg: float) -> str:
    """Return the nearest of the sixteen winds."""
    return WINDS[round(az_deg / 22.5) % 16]


def is_numbers(text: str) -> bool:
    """Return whether `text` can only be meant for a direction, right or wrong: no target is looked for then."""
    plain = text.strip()
    if plain.isdecimal() and int(plain) > _LARGEST_ANGLE:
        return False  # a satellite's number
    return _NUMBERS.fullmatch(plain) is not None


def is_direction(text: str) -> bool:
    """Return whether `text` reads as a direction, and so cannot be the name of one."""
    if _SKEW.match(text):
        return True  # the go-to line takes it for an angle of the third axis
    try:
        read_direction(text)
    except ValueError:
        return False
    return True


def preset_of(text: str, presets: Sequence[Preset]) -> tuple[Preset, bool] | None:
    """Return the preset of that name, or the only one whose name begins so, and whether it is its whole name."""
    wanted = " ".join(text.split()).casefold()
    if not wanted:
        return None
    exact = [preset for preset in presets if preset.name.casefold() == wanted]
    found = exact or [preset for preset in presets if preset.name.casefold().startswith(wanted)]
    return (found[0], bool(exact)) if len(found) == 1 else None


def resolve(wish: Wish, state: StationState) -> GotoAim:
    """Return where a wish leads: relative parts count from the last commanded target, else from the position.

    ValueError while neither is known, or where the azimuth would go more than half a turn.
    """
    position = state.position
    az_from = state.target_az_deg if state.target_az_deg is not None else position.az_deg if position else None
    el_from = state.target_el_deg if state.target_el_deg is not None else position.el_deg if position else None
    az_deg, el_deg = _whole(wish.az, az_from), _whole(wish.el, el_from)
    if az_deg is None or el_deg is None:
        raise ValueError("The dish position is unknown. Type both angles: 180 45.")
    return GotoAim(wrap_360(az_deg), el_deg)


def _whole(part: AxisWish | None, start_deg: float | None) -> float | None:
    if part is not None and not part.relative:
        return part.deg
    return None if start_deg is None else start_deg + (part.deg if part is not None else 0.0)
