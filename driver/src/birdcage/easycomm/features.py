"""What the rotators tell besides where they point, and let be set (`docs/reference/easycomm.md`, *Features*)."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING

from birdcage.easycomm.wire import AZIMUTH, ELEVATION
from birdcage.rotator.feature import (
    VERSION,
    Cost,
    Feature,
    FeatureKind,
    FeaturePage,
    HealthMark,
    HeldMotor,
    Range,
    Value,
    Writer,
)
from birdcage.rotator.feature_table import FeatureRow, FeatureTable

if TYPE_CHECKING:
    from birdcage.easycomm.rotator import EasycommRotator

STATUS, ERROR = "status", "error"
TICKS = re.compile(r"AZ_TICKS=(-?\d+) EL_TICKS=(-?\d+)")
GAINS = re.compile(r"KP=(-?[\d.]+) KI=(-?[\d.]+) KD=(-?[\d.]+)")
TILT = re.compile(r"X=(-?[\d.]+) Y=(-?[\d.]+) Z=(-?[\d.]+) g +EL=(-?[\d.]+) deg")
NO_IMU = re.compile("IMU not found.*")
STATES = {1: "idle", 2: "moving", 4: "pointing", 8: "error"}
ERRORS = {1: "none", 2: "sensor", 4: "homing", 5: "not homed", 8: "motor", 9: "driver fault", 12: "over-temperature",
          13: "not homed, driver fault", 16: "watchdog"}  # fmt: skip
QUICK = Cost(while_moving=True, min_interval_s=0.5)
GAIN_RANGE = Range(0.0, 2.0)
RECAL_HAZARD = (
    "The elevation will be counted from the accelerometer. If that is loose or mounted askew, the dish points wrong."
)
ZERO_HAZARD = (
    "Both axes will be counted from where they stand now, and the loop lets go of them. The direction is lost by that: "
    "sync it again with `birdcage sync AZ EL`."
)
DUTY_RANGE = Range(-0.35, 0.35)
"""Of the supply. The firmware takes -1 to 1; its own loop never gives more than this, at which an axis is fastest."""
DUTY = 0.1
DUTY_HAZARD = (
    "The motor turns while you hold the key, or for the seconds of `birdcage motors run`. Then STOP is sent. The "
    "firmware has no limit here, and does not end this by itself. If this computer, its cable or this program fails "
    "while it turns, only the switch of the motor supply ends it. Keep the swing clear, and a hand at that switch."
)
Ask = Callable[["EasycommRotator"], Mapping[str, Value]]


def _number(text: str) -> str:
    """Return a code that no table has as it came."""
    return f"code {text}"


def _status(rotator: EasycommRotator) -> Mapping[str, Value]:
    code = rotator.ask("GS", r"GS(\d+)")[1]
    return {STATUS: STATES.get(int(code), _number(code))}


def _error(rotator: EasycommRotator) -> Mapping[str, Value]:
    code = rotator.ask("GE", r"GE(\d+)")[1]
    return {ERROR: ERRORS.get(int(code), _number(code))}


def _version(rotator: EasycommRotator) -> Mapping[str, Value]:
    return {VERSION: rotator.ask("VE", r"VE(.+)")[1]}


def _ticks(rotator: EasycommRotator) -> Mapping[str, Value]:
    told = rotator.ask("TICKS", TICKS)
    return {"ticks.azimuth": float(told[1]), "ticks.elevation": float(told[2])}


def _gains(rotator: EasycommRotator) -> Mapping[str, Value]:
    return _gains_of(rotator.ask("GAINS", GAINS))


def _gains_of(told: re.Match[str]) -> Mapping[str, Value]:
    return {"kp": float(told[1]), "ki": float(told[2]), "kd": float(told[3])}


def _set_gain(name: str) -> Callable[[EasycommRotator, Value], Mapping[str, Value]]:
    def write(rotator: EasycommRotator, value: Value) -> Mapping[str, Value]:
        return _gains_of(rotator.ask(f"{name.upper()}{value:.3f}", GAINS))

    return write


def _imu(rotator: EasycommRotator) -> Mapping[str, Value]:
    told = rotator.ask("IMU", re.compile(f"{TILT.pattern}|{NO_IMU.pattern}"))
    if told[1] is None:
        return {}
    return {"imu.x": float(told[1]), "imu.y": float(told[2]), "imu.z": float(told[3]), "imu.elevation": float(told[4])}


def _recal(rotator: EasycommRotator, _value: Value) -> Mapping[str, Value]:
    rotator.recalibrate()
    return {"recal": True}


def _zero(rotator: EasycommRotator, _value: Value) -> Mapping[str, Value]:
    rotator.zero()
    return {"zero": True}


def _run(axis: str) -> Callable[[EasycommRotator, Value], Mapping[str, Value]]:
    def write(rotator: EasycommRotator, value: Value) -> Mapping[str, Value]:
        return {f"duty.{axis}": rotator.run(axis, float(value))}

    return write


def _indexed(index: int, name: str) -> Ask:
    """Return what reads one of the stock firmware's inputs (`IP0` to `IP8`)."""

    def read(rotator: EasycommRotator) -> Mapping[str, Value]:
        value = float(rotator.ask(f"IP{index}", rf"IP{index},(-?[\d.]+)")[1])
        return {name: value != 0.0 if name.startswith("end") else value}

    return read


def _motor(feature: str, label: str, group: str, asked: str, read: Ask, unit: str = "") -> FeatureRow:
    return FeatureRow(
        Feature(feature, label, unit, cost=QUICK, page=FeaturePage.MOTORS, group=group, asked=asked), read
    )


def _gain(name: str, label: str) -> FeatureRow:
    return FeatureRow(
        Feature(
            name, label, "", FeatureKind.NUMBER, GAIN_RANGE, Writer.UNTIL_RESTART, cost=QUICK, page=FeaturePage.MOTORS,
            group="Gains", asked="GAINS",
            hazard="The loop may swing, or no longer reach its targets. Both axes share the gain.",
        ),
        _gains,
        _set_gain(name),
    )  # fmt: skip


def _duty(axis: str, word: str) -> FeatureRow:
    return FeatureRow(
        Feature(
            f"duty.{axis}", f"Run the motor, {axis}", "", FeatureKind.HELD, DUTY_RANGE, Writer.WHILE_HELD, DUTY_HAZARD,
            cost=Cost(while_moving=True), told=False, page=FeaturePage.MOTORS, group="Run while held",
            asked=f"DUTY_{word}", held=HeldMotor(axis, DUTY),
            note="A share of the motor supply. Below about 0.05 a motor may not turn at all.",
        ),
        write=_run(axis),
    )  # fmt: skip


def _input(index: int, name: str, label: str, unit: str = "", kind: FeatureKind = FeatureKind.NUMBER) -> FeatureRow:
    page = FeaturePage.HARDWARE if index == 0 else FeaturePage.MOTORS
    return FeatureRow(
        Feature(name, label, unit, kind, cost=QUICK, page=page, group="Inputs", asked=f"IP{index}"),
        _indexed(index, name),
    )


_SHARED = (
    FeatureRow(
        Feature(VERSION, "Firmware version", kind=FeatureKind.TEXT, cost=Cost(while_moving=True), asked="VE",
                page=FeaturePage.HARDWARE, group="State"),
        _version,
    ),
    FeatureRow(
        Feature(STATUS, "Status", kind=FeatureKind.TEXT, cost=QUICK, asked="GS", page=FeaturePage.MOTORS,
                group="State"),
        _status,
    ),
    FeatureRow(
        Feature(ERROR, "Error", kind=FeatureKind.TEXT, cost=QUICK, asked="GE", page=FeaturePage.MOTORS,
                group="State", health=HealthMark("error", good=("none",))),
        _error,
    ),
)  # fmt: skip
_RP2040 = (
    _motor("ticks.azimuth", "Encoder, azimuth", "Encoders", "TICKS", _ticks, "ticks"),
    _motor("ticks.elevation", "Encoder, elevation", "Encoders", "TICKS", _ticks, "ticks"),
    FeatureRow(
        Feature("zero", "Zero both encoders", kind=FeatureKind.MOMENTARY, writer=Writer.AT_ONCE, told=False,
                hazard=ZERO_HAZARD, page=FeaturePage.MOTORS, group="Encoders", asked="ZERO", cost=Cost(5)),
        write=_zero,
    ),
    _duty(AZIMUTH, "AZ"),
    _duty(ELEVATION, "EL"),
    _gain("kp", "Proportional gain"),
    _gain("ki", "Integral gain"),
    _gain("kd", "Derivative gain"),
    _motor("imu.elevation", "Elevation as measured", "Accelerometer", "IMU", _imu, "deg"),
    _motor("imu.x", "Along the boom", "Accelerometer", "IMU", _imu, "g"),
    _motor("imu.y", "Across the boom", "Accelerometer", "IMU", _imu, "g"),
    _motor("imu.z", "Vertical", "Accelerometer", "IMU", _imu, "g"),
    FeatureRow(
        Feature("recal", "Recalibrate the elevation", kind=FeatureKind.MOMENTARY,
                writer=Writer.AT_ONCE, told=False, hazard=RECAL_HAZARD, page=FeaturePage.MOTORS,
                group="Accelerometer", asked="RECAL"),
        write=_recal,
    ),
)  # fmt: skip
_STOCK = (
    _input(0, "temperature", "Temperature inside", "°C"),
    _input(1, "end.azimuth", "Switch of the azimuth", kind=FeatureKind.SWITCH),
    _input(2, "end.elevation", "Switch of the elevation", kind=FeatureKind.SWITCH),
    _input(5, "load.azimuth", "Load of the azimuth (0 to 1023)"),
    _input(6, "load.elevation", "Load of the elevation (0 to 1023)"),
    _input(7, "rate.azimuth", "Speed of the azimuth", "deg/s"),
    _input(8, "rate.elevation", "Speed of the elevation", "deg/s"),
)
FEATURES = FeatureTable(*_SHARED, *_RP2040, *_STOCK)
RP2040_IDS = frozenset(row.feature.id for row in (*_SHARED, *_RP2040))
STOCK_IDS = frozenset(row.feature.id for row in (*_SHARED, *_STOCK))
