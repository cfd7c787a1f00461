"""What a G2 tells and lets be set besides its position (docs/reference/g2-commands.md)."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING

from birdcage.base.errors import NoReply
from birdcage.base.reason import Reason
from birdcage.protocol.motors import AZIMUTH, ELEVATION, MOTORS, by_name
from birdcage.protocol.nvs import DISABLE_TRACKER, MAX_ELEVATION, MIN_ELEVATION, NvsRow, row_label
from birdcage.rotator.axis import Axis
from birdcage.rotator.feature import (
    RSSI,
    SETTINGS,
    TV_SEARCH,
    VERSION,
    Cost,
    Feature,
    FeatureKind,
    HealthMark,
    Range,
    Value,
    Writer,
    speed_of,
)
from birdcage.rotator.feature_table import FeatureRow, FeatureTable

if TYPE_CHECKING:
    from birdcage.protocol.g2.protocol import CarryoutG2Protocol

RSSI_READS = 10
FLOOR, CEILING = "floor", "ceiling"
OK, FAULT = "OK", "FAULT"
"""As the dish prints what the fault pins of its motor drivers say."""
_IDENTITY = {VERSION: "Software", "antenna_id": "Antenna ID", "system_id": "System ID"}
_SEARCH_HAZARD = (
    "This saves NVS 20 in the dish's flash memory, after a backup of all its settings, and counts from the next "
    "power-up on. Off: it no longer homes by itself then, so home it at each power-up. On: it homes and searches then: "
    "it moves by itself."
)


def identity_of(fields: Mapping[str, str]) -> dict[str, Value]:
    """Return the features that `id` tells, by its fields."""
    return {name: fields[field] for name, field in _IDENTITY.items() if field in fields}


def _identity(dish: CarryoutG2Protocol) -> dict[str, Value]:
    return identity_of(dish.system.fields())


def angle_of(row: NvsRow) -> float:
    """Return the angle in force that a setting holds, in degrees. NoReply (`garbage`) where it is no number."""
    try:
        value = float(row.current)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise NoReply(
            f"The dish showed {row.current!r} in NVS row {row.index}, which is no angle.", reason=Reason.GARBAGE
        )
    return value


def _angle(name: str, label: str, index: int) -> FeatureRow:
    """Return the row of an elevation that a setting holds."""

    def read(dish: CarryoutG2Protocol) -> dict[str, Value]:
        return {name: angle_of(dish.read_nvs(index))}

    label = f"{label} ({row_label(index)})"
    return FeatureRow(Feature(name, label, "deg", FeatureKind.NUMBER, Range(-90.0, 90.0), cost=Cost(1, "nvs")), read)


def speeds_of(speeds: Mapping[int, float]) -> dict[str, Value]:
    """Return the greatest speeds as features, from those by motor."""
    return {speed_of(axis): speed for axis, speed in by_name(speeds).items()}


def _speed(axis: Axis) -> FeatureRow:
    """Return the row of the greatest speed of an axis."""
    feature = Feature(
        speed_of(axis.name), f"Greatest {axis.name} speed", "deg/s", FeatureKind.NUMBER,
        Range(axis.step_deg, axis.speed_deg_s), Writer.UNTIL_RESTART, cost=Cost(2, "step"),
    )  # fmt: skip
    motor = MOTORS[axis.name]
    return FeatureRow(feature, _speeds, lambda dish, value: speeds_of(dish.set_speed(motor, float(value))))


def _speeds(dish: CarryoutG2Protocol) -> dict[str, Value]:
    return speeds_of(dish.read_speeds())


def _driver(axis: Axis) -> FeatureRow:
    """Return the row of the fault pin of an axis' motor driver (docs/reference/g2-commands.md, *A3981>*)."""
    feature = Feature(
        driver_of(axis.name), f"Driver of the {axis.name} motor ({OK} or {FAULT})", "", FeatureKind.TEXT,
        cost=Cost(1, "a3981", 5.0), health=HealthMark(f"{axis.role.name.lower()} driver", good=(OK,)),
    )  # fmt: skip
    return FeatureRow(feature, _drivers)


def driver_of(axis: str) -> str:
    """Return the id of what the fault pin of an axis' motor driver says."""
    return f"driver.{axis}"


def _drivers(dish: CarryoutG2Protocol) -> dict[str, Value]:
    faults = dish.drivers.faults()
    by_axis = {AZIMUTH: faults.azimuth, ELEVATION: faults.elevation}
    return {driver_of(axis): FAULT if fault else OK for axis, fault in by_axis.items()}


def tv_search_of(row: NvsRow) -> dict[str, Value]:
    """Return whether it searches from the next power-up on, by what is saved in the row."""
    return {TV_SEARCH: row.saved != "TRUE"}


def _tv_search(dish: CarryoutG2Protocol) -> dict[str, Value]:
    return tv_search_of(dish.read_nvs(DISABLE_TRACKER))


def _set_tv_search(dish: CarryoutG2Protocol, on: Value) -> dict[str, Value]:
    return tv_search_of(dish.save_search(disabled=not on))


def features_of(azimuth: Axis, elevation: Axis) -> FeatureTable:
    """Return the table of a G2 with these axes."""
    return FeatureTable(
        FeatureRow(
            Feature(RSSI, "Signal strength", "counts", FeatureKind.NUMBER, Range(0.0, math.inf), cost=Cost(1, "dvb")),
            lambda dish: {RSSI: float(dish.get_rssi(RSSI_READS).average)},
        ),
        FeatureRow(
            Feature("snr", "Signal-to-noise ratio", "dB", cost=Cost(2, "dvb", 5.0)),
            lambda dish: {"snr": dish.tuner.snr_db()},
        ),
        FeatureRow(
            Feature(
                "lnb_supply", "Supply of the LNB", "V", FeatureKind.NUMBER, Range(0.0, 30.0), cost=Cost(2, "dvb", 5.0),
                health=HealthMark("LNB"),
            ),
            lambda dish: {"lnb_supply": dish.tuner.lnb_volts()},
        ),
        _driver(azimuth),
        _driver(elevation),
        _speed(azimuth),
        _speed(elevation),
        FeatureRow(Feature(VERSION, "Firmware version", "", FeatureKind.TEXT, cost=Cost(1, "os")), _identity),
        FeatureRow(Feature("antenna_id", "Antenna ID", "", FeatureKind.TEXT, cost=Cost(1, "os")), _identity),
        FeatureRow(Feature("system_id", "System ID", "", FeatureKind.TEXT, cost=Cost(1, "os")), _identity),
        _angle(FLOOR, "Lowest elevation", MIN_ELEVATION),
        _angle(CEILING, "Highest elevation", MAX_ELEVATION),
        FeatureRow(
            Feature(
                TV_SEARCH, "TV search at power-up", "", FeatureKind.SWITCH, None, Writer.FROM_POWER_UP, _SEARCH_HAZARD,
                Cost(4, "nvs"),
            ),
            _tv_search, _set_tv_search,
        ),
        FeatureRow(
            Feature(SETTINGS, "All settings (NVS)", "", FeatureKind.LINES, cost=Cost(1, "nvs")),
            lambda dish: {SETTINGS: "\n".join(dish.settings_table())},
        ),
    )  # fmt: skip
