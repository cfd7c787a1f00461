"""What a G2 tells of its settings memory, and lets be set (docs/reference/g2-settings.md)."""

from __future__ import annotations

import math

from birdcage.base.errors import NoReply
from birdcage.base.reason import Reason
from birdcage.protocol.g2.feature_rows import Question, in_lines, one, told, under
from birdcage.protocol.g2.motors import CEILING, FLOOR, HOME
from birdcage.protocol.nvs import DISABLE_TRACKER, MAX_ELEVATION, MIN_ELEVATION, SLEEP, NvsRow, row_label
from birdcage.rotator.feature import (
    SETTINGS,
    SLEEP_TIMER,
    TV_SEARCH,
    Feature,
    FeatureKind,
    FeaturePage,
    Range,
    Value,
    Writer,
)
from birdcage.rotator.feature_table import FeatureRow

_PAGE = FeaturePage.SETTINGS
_SEARCH_HAZARD = (
    "This saves NVS 20 in the dish's flash memory, after a backup of all its settings, and counts from the next "
    "power-up on. Off: it no longer homes by itself then, so home it at each power-up. On: it homes and searches then: "
    "it moves by itself."
)


def angle_of(row: NvsRow) -> float:
    """Return the angle in force that a setting holds, in degrees. NoReply (`garbage`) where it is no number."""
    return _number_of(row, "angle")


def _number_of(row: NvsRow, what: str) -> float:
    try:
        value = float(row.current)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise NoReply(
            f"The dish showed {row.current!r} in NVS row {row.index}, which is no {what}.", reason=Reason.GARBAGE
        )
    return value


def tv_search_of(row: NvsRow) -> dict[str, Value]:
    """Return whether it searches from the next power-up on, by what is saved in the row."""
    return {TV_SEARCH: row.saved != "TRUE"}


def _row(line: str, lines: int = 1) -> Question:
    return Question("nvs", line, lines, 0.0)


def _angle(name: str, label: str) -> Feature:
    return Feature(name, label, "deg", range=Range(-90.0, 90.0))


_TV_SEARCH = FeatureRow(
    _row(f"d {DISABLE_TRACKER}", 4).about(
        Feature(
            TV_SEARCH, "TV search at power-up", kind=FeatureKind.SWITCH, writer=Writer.FROM_POWER_UP,
            hazard=_SEARCH_HAZARD,
        )
    ),
    lambda dish: tv_search_of(dish.read_nvs(DISABLE_TRACKER)),
    lambda dish, on: tv_search_of(dish.save_search(disabled=not on)),
)  # fmt: skip
_ELEVATIONS = (
    one(_row(f"d {MIN_ELEVATION}"), lambda dish: angle_of(dish.read_nvs(MIN_ELEVATION)),
        _angle(FLOOR, f"Lowest elevation ({row_label(MIN_ELEVATION)})")),
    one(_row(f"d {MAX_ELEVATION}"), lambda dish: angle_of(dish.read_nvs(MAX_ELEVATION)),
        _angle(CEILING, f"Highest elevation ({row_label(MAX_ELEVATION)})")),
    *told(Question("mot", "elminmaxhome"), lambda dish: dish.motors.elevation_limits(),
          _angle(HOME, "Elevation after homing")),
)  # fmt: skip
_SLEEP = one(
    _row(f"d {SLEEP}"), lambda dish: _number_of(dish.read_nvs(SLEEP), "time"),
    Feature(SLEEP_TIMER, f"Sleep timer ({row_label(SLEEP)})", "s", note="What sleep does to the console is unknown."),
)  # fmt: skip
_ALL = in_lines(_row("d"), lambda dish: dish.settings_table(), SETTINGS, "All settings (NVS)")

SETTINGS_ROWS = (
    *under(_PAGE, "Elevation", *_ELEVATIONS),
    *under(_PAGE, "TV search", _TV_SEARCH),
    *under(_PAGE, "Sleep", _SLEEP),
    *under(_PAGE, "All settings", _ALL),
)
