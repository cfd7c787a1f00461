"""What a motor test found, as a table for people and as values."""

from __future__ import annotations

from collections.abc import Mapping

from birdcage.cli.table import tell_table
from birdcage.station.task_state import TaskValue

NOTHING = "-"
HEAD = ("AXIS", "WAY", "SPEED °/s", "NOMINAL", "ACCEL. °/s²", "NOMINAL", "OFF TARGET")
HEALTH = "health"


def values_of_motors(found: Mapping[str, TaskValue]) -> dict[str, dict[str, TaskValue]]:
    """Return what was found by axis, and below `health` what the motor drivers said, by the ids of features."""
    values: dict[str, dict[str, TaskValue]] = {}
    for name, value in found.items():
        of, _, what = name.partition(".")
        values.setdefault(of, {})[what] = round(value, 4) if isinstance(value, float) else value
    return values


def tell_motors(found: Mapping[str, TaskValue]) -> None:
    """Print measured against nominal, a line each axis and direction; a dash for what the readings do not tell."""
    rows = [
        (
            f"{axis} {way}", _number(told, "way_deg", "{:.1f}°"), _measured(told, f"speed_{way}", 1),
            _number(told, "speed_nominal", "{:.1f}"), _measured(told, f"acceleration_{way}", 0),
            _number(told, "acceleration_nominal", "{:.0f}"), _number(told, "arrival_deg", "{:.2f}°"),
        )
        for axis, told in values_of_motors(found).items() if axis != HEALTH for way in ("up", "down")
    ]  # fmt: skip
    tell_table(HEAD, rows, "lrrrrrr")


def _number(told: Mapping[str, TaskValue], name: str, form: str) -> str:
    value = told.get(name)
    return form.format(value) if isinstance(value, int | float) else NOTHING


def _measured(told: Mapping[str, TaskValue], name: str, digits: int) -> str:
    """Return a figure and its sigma, which is never shown smaller than the last digit."""
    value, sigma = told.get(name), told.get(f"{name}_sigma")
    if not isinstance(value, int | float) or not isinstance(sigma, int | float):
        return NOTHING
    return f"{value:.{digits}f} ±{max(sigma, 10.0**-digits):.{digits}f}"
