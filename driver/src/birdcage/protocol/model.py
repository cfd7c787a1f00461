"""What a dish is and can do, as data: every dialect declares one `DishModel`, and every face reads it."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum


class Turn(Enum):
    """How well the turn of the cable is known (SEAMS *Frames*)."""

    REPORTED = "reported"
    COUNTED = "counted"
    UNKNOWN = "unknown"


class SecondMove(Enum):
    """What a move command does while the axis still moves."""

    RETARGET = "retarget"
    QUEUE = "queue"
    UNKNOWN = "unknown"


@dataclass(frozen=True, slots=True)
class Axis:
    """One axis in the dish's own frame."""

    index: int
    name: str
    min_deg: float
    max_deg: float
    speed_deg_s: float
    acceleration_deg_s2: float
    step_deg: float
    overshoot_deg: float = 0.0
    """How far the rest position may lie from the command."""


@dataclass(frozen=True, slots=True)
class CableRange:
    """How far the cable lets the azimuth turn, counted from the homing reference; negative is counterclockwise."""

    min_deg: float
    max_deg: float


@dataclass(frozen=True, slots=True)
class StopMeans:
    """One rung of the ladder that STOP climbs, known before each move."""

    name: str
    """`retarget` or `release`."""
    proven: bool
    """Whether a source documents that it works on this firmware."""
    sentence: str
    loses_position: bool = False
    needs_consent: bool = False
    """Used only if the user enabled it in `birdcage.toml`."""


@dataclass(frozen=True, slots=True)
class DishModel:
    """A dish. What it lacks is None or False here, and every face greys it out and says why."""

    name: str
    firmware: str
    baud: int
    azimuth: Axis
    elevation: Axis
    cable: CableRange | None
    turn: Turn
    axes_together: bool
    """Whether both axes move at once."""
    second_move: SecondMove
    stop_ladder: tuple[StopMeans, ...]
    homing_s: float | None
    """The longest that homing one axis takes; None when it homes only by itself."""
    homing_stoppable: bool
    boot_s: float
    """The longest that a boot takes; waiting for it never lasts longer unless asked."""
    has_motor_power: bool
    """Whether its motors can be released and engaged by command."""
    has_speeds: bool
    """Whether the greatest speed of an axis can be read and lowered; `Axis.speed_deg_s` is the most it is known to do.
    """
    has_rssi: bool
    has_nvs: bool
    has_skew: bool
    has_stow: bool
    position_reported: bool

    def axis(self, index: int) -> Axis:
        """Return the axis that the firmware counts as `index`; KeyError for any other."""
        return {self.azimuth.index: self.azimuth, self.elevation.index: self.elevation}[index]
