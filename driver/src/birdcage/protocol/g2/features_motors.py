"""What a G2 tells of its motors, and lets be set (docs/reference/g2-commands.md, *MOT>* and *STEP>*)."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING

from birdcage.protocol.g2.feature_rows import Question, each, text, told, under
from birdcage.protocol.g2.motors import GAINS
from birdcage.protocol.motors import MOTORS, by_name
from birdcage.protocol.trk.reading import per_axis
from birdcage.rotator.axis import Axis
from birdcage.rotator.feature import Feature, FeaturePage, Range, Value, Writer, speed_of
from birdcage.rotator.feature_table import FeatureRow

if TYPE_CHECKING:
    from birdcage.protocol.g2.protocol import CarryoutG2Protocol

_GAINS = Range(0.0, 1000.0)
_OWN_LIMIT = "No source gives limits of the gains: 0 to 1000 is birdcage's own. STEP has shown Kp 250 and Kv 50."
_UNSTABLE = (
    "This changes the control loop of the motor until the dish restarts. Wrong gains can make a motor oscillate, run "
    "hot or lose steps. After lost steps every angle is wrong until it is homed."
)
_SLOWER = (
    "birdcage reckons with the nominal acceleration. With a lower one moves take longer than it says, and STOP runs "
    "past its point before it comes back. The dish forgets it when it restarts."
)


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


def _acceleration(axis: Axis) -> FeatureRow:
    """Return the row of the greatest acceleration of an axis: whole microsteps/s/ms, up to the nominal one."""
    motor, unit_deg_s2 = MOTORS[axis.name], 1000.0 * axis.step_deg
    feature = Feature(
        f"acceleration.{axis.name}", f"Greatest {axis.name} acceleration", "deg/s²",
        range=Range(unit_deg_s2, math.ceil(axis.acceleration_deg_s2 / unit_deg_s2) * unit_deg_s2),
        writer=Writer.UNTIL_RESTART, hazard=_SLOWER, note=f"The dish takes it in steps of {unit_deg_s2:.3g} deg/s².",
    )  # fmt: skip
    return FeatureRow(
        Question("step", "ma", 2).about(feature), _accelerations,
        lambda dish, value: dish.stepper.set_max_acceleration(motor, float(value)),
    )  # fmt: skip


def _gain(axis: Axis, name: str) -> FeatureRow:
    feature = Feature(
        f"{name}.{axis.name}", f"Gain {name.capitalize()}, {axis.name}", range=_GAINS, writer=Writer.UNTIL_RESTART,
        hazard=_UNSTABLE, note=_OWN_LIMIT,
    )  # fmt: skip
    return FeatureRow(
        Question("mot", "pid", 3).about(feature), _motor_gains,
        lambda dish, value: dish.motors.set_gain(axis.name, name, float(value)),
    )  # fmt: skip


def _accelerations(dish: CarryoutG2Protocol) -> dict[str, Value]:
    return dish.stepper.max_accelerations()


def _motor_gains(dish: CarryoutG2Protocol) -> dict[str, Value]:
    return dish.motors.gains()


def motors(azimuth: Axis, elevation: Axis) -> tuple[FeatureRow, ...]:
    """Return the rows of a dish with these axes."""
    axes, page = (azimuth, elevation), FeaturePage.MOTORS
    return (
        *under(
            page, "State",
            *told(Question("mot", "l"), lambda dish: dish.motors.states(),
                  *each(text("motor", "State of the {} motor"))),
            *told(Question("mot", "v"), lambda dish: dish.motors.velocities(),
                  *each(Feature("velocity", "Present {} speed", "deg/s"))),
            *told(Question("mot", "p"), lambda dish: dish.motors.steps(),
                  *each(Feature("steps", "Raw {} position", "microsteps"))),
        ),
        *under(page, "Limits", *map(_speed, axes), *map(_acceleration, axes)),
        *under(
            page, "Gains",
            *(_gain(axis, name) for name in GAINS for axis in axes),
            *told(Question("step", "pid"), lambda dish: dish.stepper.gains(),
                  *each(Feature("step_kp", "Gain Kp of STEP, {}")), *each(Feature("step_kv", "Gain Kv of STEP, {}"))),
        ),
    )  # fmt: skip
