"""One axis of a machine: its range, how it moves, how long that takes, and how far its cable lets it turn."""

from __future__ import annotations

import math
from dataclasses import dataclass
from enum import Enum
from functools import cached_property

from birdcage.rotator.values import MOTOR_AZIMUTH, MOTOR_ELEVATION, MOTOR_SKEW


@dataclass(frozen=True, slots=True)
class MeasuredTimes:
    """How long a move takes by its length, where times were measured and not speeds.

    `steps` are (longest way in degrees, seconds); beyond the last one t = `scale_s` ln(`per_deg` way) - `less_s`, and
    between the last step and `from_deg` on a straight line.
    """

    steps: tuple[tuple[float, float], ...]
    from_deg: float
    scale_s: float
    per_deg: float
    less_s: float

    def seconds(self, way_deg: float) -> float:
        """Return the time of a move over `way_deg`, from rest to rest; 0 for none at all."""
        way = abs(way_deg)
        if way == 0.0:
            return 0.0
        for longest, seconds in self.steps:
            if way <= longest:
                return seconds
        law = self.scale_s * math.log(self.per_deg * max(way, self.from_deg)) - self.less_s
        last_deg, last_s = self.steps[-1]
        share = min((way - last_deg) / (self.from_deg - last_deg), 1.0)
        return last_s + (law - last_s) * share


OVERSHOOT_SPREAD_DEG = 0.02
"""How far from its mean the overshoot of a single move lies at most (`docs/reference/g2-motors.md`, *Overshoot*)."""


SHORT_WAYS = 2.0 / 3.0
"""What is left of an overshoot where ways are shorter: the play hides an axis that goes back for them."""


class Role(Enum):
    """What an axis does to the beam."""

    AZ = "azimuth"
    """Turns it about the vertical, clockwise as seen from above; 0 at north."""
    EL = "elevation"
    """Lifts it from the horizon."""
    SKEW = "skew"
    """Turns the feed about it."""
    ARC = "arc"
    """Swings it along a curve of its own: only a `SkyMapping` tells where to."""


class TurnBy(Enum):
    """Who chooses which way round an azimuth goes, where the cable lets it turn more than once."""

    MACHINE = "machine"
    """It takes an azimuth of the circle, and turns as it likes."""
    HOST = "host"
    """It takes the turn of its cable, tells it (`Turn.REPORTED`), and goes there as it stands on the scale."""


@dataclass(frozen=True)
class Axis:
    """One axis in the machine's own degrees."""

    name: str
    """How the seam calls it."""
    role: Role
    min_deg: float
    """Of an azimuth on the circle, 0 to 360, also where the machine counts otherwise (`turn_by`)."""
    max_deg: float
    speed_deg_s: float
    """The greatest; also of a machine that can be set slower."""
    acceleration_deg_s2: float
    """And braking. Where it is not known: one that is too small makes waits longer and STOP aim further ahead."""
    step_deg: float
    """The least way that a command can turn it."""
    overshoot_deg: float = 0.0
    """How far the rest position may lie from the command."""
    times: MeasuredTimes | None = None
    """Goes before speed and acceleration, where it is known."""
    play_deg: float | None = None
    """Of this dish's gear, which no reading shows; None if not measured."""
    speed_known: bool = True
    """False: speed and acceleration are the least that such machines have. Waits are as long as that may take, readings
    are not judged by it, and no time of arrival is told."""
    turn_by: TurnBy = TurnBy.MACHINE
    """Of an azimuth. Its range counts on the circle in either case; that of the cable is a fact of its own."""
    mean_overshoot_up_deg: float | None = None
    mean_overshoot_down_deg: float | None = None
    """How far past its target this dish's axis comes to rest on the mean, of moves to greater angles and to lesser;
    None if that was not seen yet."""

    @cached_property
    def index(self) -> int:
        """Its number above the seam, as the published interface counts motors: by role. KeyError for one on an arc."""
        return _NUMBERS[self.role]

    def mean_overshoot_deg(self, way_deg: float) -> float | None:
        """Return it in the direction of a way."""
        return self.mean_overshoot_up_deg if way_deg > 0.0 else self.mean_overshoot_down_deg

    def lead_deg(self, way_deg: float) -> float:
        """Return how far beyond where its shaft is wanted the motor is best sent while it turns that way, signed.

        Half the play less the mean overshoot: the one holds the shaft back, the other carries it on. 0 where one of
        both is not known, as they point against each other, and where they cancel as far as can be told: a stream of
        short ways overshoots by down to `SHORT_WAYS` of the mean (decision 0035).
        """
        overshoot_deg = self.mean_overshoot_deg(way_deg)
        if self.play_deg is None or overshoot_deg is None:
            return 0.0
        lead_deg = self.play_deg / 2.0 - overshoot_deg
        if lead_deg < 0.0:
            lead_deg = min(self.play_deg / 2.0 - SHORT_WAYS * overshoot_deg, 0.0)
        return math.copysign(lead_deg, lead_deg * way_deg)

    def gliding_lead_deg(self, way_deg: float) -> float:
        """Return how much more than `lead_deg` an axis is sent that glides on: it does not overshoot, signed.

        Up to half the play. Where that is not known, as far as the overshoot carries an axis that steps against it.
        """
        if self.play_deg is None:
            return math.copysign(self.mean_overshoot_deg(way_deg) or 0.0, way_deg)
        return math.copysign(self.play_deg / 2.0, way_deg) - self.lead_deg(way_deg)

    def least_way_deg(self, way_deg: float) -> float:
        """Return the least way that turns the shaft on: on a shorter one the motor may have to come back.

        It stands beyond its last target, and a play as large as that way back hides it.
        """
        overshoot_deg = self.mean_overshoot_deg(way_deg)
        if self.play_deg is None or overshoot_deg is None or overshoot_deg <= 0.0:
            return 0.0
        return max(0.0, overshoot_deg + OVERSHOOT_SPREAD_DEG - self.play_deg)


_NUMBERS = {Role.AZ: MOTOR_AZIMUTH, Role.EL: MOTOR_ELEVATION, Role.SKEW: MOTOR_SKEW}


@dataclass(frozen=True, slots=True)
class CableRange:
    """How far the cable lets the azimuth turn, counted from the homing reference; negative is counterclockwise."""

    min_deg: float
    max_deg: float
