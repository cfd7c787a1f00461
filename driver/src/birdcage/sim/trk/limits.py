"""Where the motor menu lets an axis go: the wrap manager of the cable, and the elevation limits of the NVS."""

from __future__ import annotations

import math
from typing import Protocol

from birdcage.base.geometry import shortest_turn
from birdcage.sim.axis import AxisMechanics
from birdcage.sim.dish import DishMechanics
from birdcage.sim.shell import Die, Script
from birdcage.sim.trk.knobs import TrkSettings

INT_MAX = 2147483647
"""What an axis reports, and a sweep aims at, until it is homed (noted: docs/reference/g2-motors.md, *Position*)."""


class MotorBoard(Protocol):
    """What the motor menu needs of the board."""

    @property
    def settings(self) -> TrkSettings:
        """The knobs."""

    @property
    def dish(self) -> DishMechanics:
        """The motors."""

    @property
    def now_s(self) -> float:
        """Dish time."""

    def bounds(self, index: int) -> tuple[float, float]:
        """Return the lowest and highest count that the firmware allows, in degrees."""


def number(text: str) -> float | None:
    """Read a finite number as the firmware would; None when it is none."""
    try:
        value = float(text)
    except ValueError:
        return None
    return value if math.isfinite(value) else None


def motor(text: str) -> int | None:
    """Read a motor's number; None when there is no such motor."""
    return int(text) if text in ("0", "1") else None


def target(board: MotorBoard, index: int, wanted: float) -> float | None:
    """Return the count that an angle means; None when it is out of range (setting `out_of_range`)."""
    settings = board.settings
    low, high = board.bounds(index)
    if index == 0:
        if not settings.az_outside and not 0.0 <= wanted <= 360.0:
            return None
        return _cable_target(board, wanted, low, high)
    if low <= wanted <= high:
        return wanted
    return min(max(wanted, low), high) if settings.out_of_range == "clamp" else None


def _cable_target(board: MotorBoard, az_deg: float, low: float, high: float) -> float | None:
    """Choose the turn of the cable (setting `az_map`); without the wrap manager the shortest way, wherever it leads."""
    here = board.dish.axes[0].count(board.now_s)[0]
    if board.settings.az_map == "literal":
        turns = [az_deg]
    elif low == -math.inf:
        turns = [here + shortest_turn(here, az_deg)]
    elif board.settings.az_map == "home":
        turns = [-((-az_deg) % 360.0)]
    else:
        first = math.floor((low - az_deg) / 360.0)
        turns = [az_deg + 360.0 * turn for turn in range(first, first + 4)]
    fitting = [turn for turn in turns if low <= turn <= high]
    return min(fitting, key=lambda turn: abs(turn - here), default=None)


def angle_error(axis: AxisMechanics) -> str:
    """What it says of an axis that does not know where it is (noted, for the elevation)."""
    return f"Step to Position {axis.data.name} angle error: {INT_MAX}\n"


def unhomed(board: MotorBoard, axis: AxisMechanics) -> Script:
    """Refuse a move of an unhomed axis, or hang (setting `unhomed_move`)."""
    if board.settings.unhomed_move == "deadlock":
        yield Die()
    yield angle_error(axis)
