"""What a G2 tells of its settings memory, and lets be set (docs/reference/g2-settings.md)."""

from __future__ import annotations

import math

from birdcage.base.errors import NoReply
from birdcage.base.reason import Reason
from birdcage.protocol.g2.feature_rows import Question, one, told, under
from birdcage.protocol.g2.motors import CEILING, FLOOR, HOME
from birdcage.protocol.nvs import MAX_ELEVATION, MIN_ELEVATION, SLEEP, NvsRow, row_label
from birdcage.protocol.trk.settings_rows import ALL_ROW, TV_SEARCH_ROW
from birdcage.rotator.feature import (
    SLEEP_TIMER,
    Feature,
    FeaturePage,
    Range,
)

_PAGE = FeaturePage.SETTINGS


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


def _row(line: str, lines: int = 1) -> Question:
    return Question("nvs", line, lines, 0.0)


def _angle(name: str, label: str) -> Feature:
    return Feature(name, label, "deg", range=Range(-90.0, 90.0))


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

SETTINGS_ROWS = (
    *under(_PAGE, "Elevation", *_ELEVATIONS),
    TV_SEARCH_ROW,
    *under(_PAGE, "Sleep", _SLEEP),
    ALL_ROW,
)
