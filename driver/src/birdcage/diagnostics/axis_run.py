"""One axis in a motor test: its way, what was read on it, and what that tells."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from datetime import datetime

from birdcage.base.geometry import shortest_turn
from birdcage.diagnostics.motion_fit import NOTHING, MeasuredWay, MotionFit, fit_motion
from birdcage.diagnostics.motor_test_records import MotorTest
from birdcage.rotator.axis import Axis
from birdcage.rotator.feature import Reading, speed_of
from birdcage.station.task_state import TaskValue

SPEED_UNIT, ACCELERATION_UNIT = "deg/s", "deg/s²"


def acceleration_of(axis: str) -> str:
    """Return the id of the greatest acceleration of an axis, by the axis' name."""
    return f"acceleration.{axis}"


@dataclass
class AxisRun:
    """Angles are the dish's own, on the scale of `Send`."""

    axis: Axis
    turns_az: bool
    start: tuple[float, float]
    """Where the dish stood before: azimuth and elevation."""
    way: tuple[float, float] | None
    """Between which angles it goes to and fro; None if there is no room."""
    refused: str = ""
    """What ends the way before its full length, as the gate puts it."""
    stalled_at_deg: float | None = None
    arrival_deg: float | None = None
    speed_nominal: float | None = None
    acceleration_nominal: float | None = None
    up: MotionFit = NOTHING
    down: MotionFit = NOTHING
    _ups: list[MeasuredWay] = field(default_factory=list)
    _downs: list[MeasuredWay] = field(default_factory=list)

    @property
    def way_deg(self) -> float:
        """How far each way is; 0 if there is no room."""
        return 0.0 if self.way is None else self.way[1] - self.way[0]

    def at(self, deg: float) -> tuple[float, float]:
        """Return azimuth and elevation with this axis at an angle, and the other one where it stood."""
        az_deg, el_deg = self.start
        return (deg, el_deg) if self.turns_az else (az_deg, deg)

    def angle(self, place: tuple[float, float]) -> float:
        """Return where the axis is, on the scale of its way, from azimuth and elevation."""
        az_deg, el_deg = place
        if not self.turns_az:
            return el_deg
        middle_deg = self.start[0] if self.way is None else sum(self.way) / 2.0
        return middle_deg + shortest_turn(middle_deg, az_deg)

    def take_nominal(self, told: Mapping[str, Reading]) -> None:
        """Take what it should do: as the machine has just told, else as its facts say, where they know."""
        known = self.axis.speed_known and self.axis.times is None
        self.speed_nominal = _told(told, speed_of(self.axis.name), SPEED_UNIT) or (
            self.axis.speed_deg_s if known else None
        )
        self.acceleration_nominal = _told(told, acceleration_of(self.axis.name), ACCELERATION_UNIT) or (
            self.axis.acceleration_deg_s2 if known else None
        )

    def add(self, way: MeasuredWay, off_deg: float) -> None:
        """Take a way from rest to rest, and how far from its target it ended."""
        (self._ups if way.end_deg > way.start_deg else self._downs).append(way)
        self.arrival_deg = max(abs(off_deg), self.arrival_deg or 0.0)

    def fit(self) -> None:
        """Fit both directions by all their ways."""
        self.up, self.down = fit_motion(self._ups), fit_motion(self._downs)

    def told(self, utc: datetime) -> MotorTest:
        """Return it as it is kept."""
        up, down = self.up, self.down
        return MotorTest(
            utc, self.axis.name, self.way_deg,
            speed_up=up.speed_deg_s, speed_up_sigma=up.speed_sigma,
            speed_down=down.speed_deg_s, speed_down_sigma=down.speed_sigma,
            speed_nominal=self.speed_nominal,
            acceleration_up=up.acceleration_deg_s2, acceleration_up_sigma=up.acceleration_sigma,
            acceleration_down=down.acceleration_deg_s2,
            acceleration_down_sigma=down.acceleration_sigma,
            acceleration_nominal=self.acceleration_nominal, arrival_deg=self.arrival_deg,
            readings=up.readings + down.readings, stalled_at_deg=self.stalled_at_deg,
        )  # fmt: skip

    def found(self, utc: datetime) -> Mapping[str, TaskValue]:
        """Return the same by name, for faces: `MotorTest` without what is not known, its time and its axis.

        `speed`, `acceleration`, each with `_sigma`: of both directions together. `rms`: of the fits, in degrees.
        """
        test = self.told(utc)
        told: dict[str, TaskValue] = {
            name: value for name in MotorTest.__slots__
            if name not in ("utc", "axis") and (value := getattr(test, name)) is not None
        }  # fmt: skip
        for name, figure in (("speed", test.speed), ("acceleration", test.acceleration)):
            if figure is not None:
                told[name], told[f"{name}_sigma"] = figure
        fits = [fit.rms_deg for fit in (self.up, self.down) if fit.readings]
        return told | ({"rms": max(fits)} if fits else {})


def _told(told: Mapping[str, Reading], name: str, unit: str) -> float | None:
    reading = told.get(name)
    if reading is None or reading.unit != unit or isinstance(reading.value, bool | str) or reading.value <= 0.0:
        return None
    return float(reading.value)
