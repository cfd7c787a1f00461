"""What a G2 tells of its motors, and lets be set (docs/reference/g2-commands.md, *MOT>* and *STEP>*)."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from birdcage.protocol.g2.feature_rows import Question, by_axis_of, each, text, told
from birdcage.protocol.g2.reading import per_axis
from birdcage.protocol.motors import MOTORS, by_name
from birdcage.rotator.axis import Axis
from birdcage.rotator.feature import Feature, FeaturePage, Range, Value, Writer, speed_of
from birdcage.rotator.feature_table import FeatureRow

if TYPE_CHECKING:
    from birdcage.protocol.g2.protocol import CarryoutG2Protocol


def speeds_of(speeds: Mapping[int, float]) -> dict[str, Value]:
    """Return the greatest speeds as features, from those by motor."""
    return per_axis("speed", by_name(speeds))


def _speeds(dish: CarryoutG2Protocol) -> dict[str, Value]:
    return speeds_of(dish.read_speeds())


def _speed(axis: Axis) -> FeatureRow:
    """Return the row of the greatest speed of an axis."""
    feature = Feature(
        speed_of(axis.name), f"Greatest {axis.name} speed", "deg/s",
        range=Range(axis.step_deg, axis.speed_deg_s), writer=Writer.UNTIL_RESTART,
    )  # fmt: skip
    motor, question = MOTORS[axis.name], Question("step", "mv", 2, 0.0)
    return FeatureRow(
        question.about(feature), _speeds, lambda dish, value: speeds_of(dish.set_speed(motor, float(value)))
    )


def motors(azimuth: Axis, elevation: Axis) -> tuple[FeatureRow, ...]:
    """Return the rows of a dish with these axes."""
    rows = (
        *told(Question("mot", "l"), lambda dish: dish.motors.states(), *each(text("motor", "State of the {} motor"))),
        *told(Question("mot", "v"), lambda dish: dish.motors.velocities(),
              *each(Feature("velocity", "Present {} speed", "deg/s"))),
        _speed(azimuth), _speed(elevation),
        *told(Question("step", "ma"), lambda dish: dish.stepper.max_accelerations(),
              *each(Feature("acceleration", "Greatest {} acceleration", "deg/s²"))),
        *told(Question("mot", "p"), lambda dish: dish.motors.steps(),
              *each(Feature("steps", "Raw {} position", "microsteps"))),
        *told(Question("mot", "pid"), lambda dish: dish.motors.gains(),
              *each(Feature("kp", "Gain Kp, {}")), *each(Feature("kv", "Gain Kv, {}")),
              *each(Feature("ki", "Gain Ki, {}"))),
        *told(Question("step", "pid"), lambda dish: dish.stepper.gains(),
              *each(Feature("step_kp", "Gain Kp of STEP, {}")), *each(Feature("step_kv", "Gain Kv of STEP, {}"))),
    )  # fmt: skip
    return by_axis_of(FeaturePage.MOTORS, rows)
