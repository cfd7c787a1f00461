"""What a dish is and can do, as data: every dialect declares one `DishModel`, and every face reads it."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from enum import Enum

from birdcage.base.beam import Reflector


class Turn(Enum):
    """How well the turn of the cable is known (SEAMS *Frames*)."""

    REPORTED = "reported"
    COUNTED = "counted"
    """From a homing that this program saw."""
    REMEMBERED = "remembered"
    """Counted when it was last left, and the dish stands where it stood then."""
    UNKNOWN = "unknown"


class SecondMove(Enum):
    """What the command of a move does while a motor still runs."""

    RETARGET = "retarget"
    """It is taken at once."""
    QUEUE = "queue"
    """It is answered, and waits for the motor."""
    BLOCK = "block"
    """The shell waits for the motor, and answers nothing meanwhile."""
    UNKNOWN = "unknown"

    @property
    def waits(self) -> bool:
        """Whether the move begins only when the motor stands."""
        return self in (SecondMove.QUEUE, SecondMove.BLOCK)


class SearchSwitch(Enum):
    """How the firmware's own TV search is switched off."""

    FOR_GOOD = "for good"
    """By a setting, which holds from the next power-up on."""
    UNTIL_POWER_UP = "until power-up"
    """By ending it while it runs; it begins again at each power-up."""


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
"""How far from its mean the overshoot of a single move lies at most (reference section 7.4)."""


SHORT_WAYS = 2.0 / 3.0
"""What is left of an overshoot where ways are shorter: the play hides an axis that goes back for them."""


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
    times: MeasuredTimes | None = None
    """Goes before speed and acceleration, where it is known."""
    play_deg: float | None = None
    """Of this dish's gear, which no reading shows; None if not measured."""
    mean_overshoot_up_deg: float | None = None
    mean_overshoot_down_deg: float | None = None
    """How far past its target this dish's axis comes to rest on the mean, of moves to greater angles and to lesser;
    None if that was not seen yet."""

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


@dataclass(frozen=True, slots=True)
class SilentSlew:
    """A combined move that any byte aborts: while it lasts nothing is asked, and the position is modelled."""

    least_deg: float
    """An axis that has further to go than this is sent by it, as a queued move cannot be called back (SEAMS *STOP*)."""


@dataclass(frozen=True, slots=True)
class CableRange:
    """How far the cable lets the azimuth turn, counted from the homing reference; negative is counterclockwise."""

    min_deg: float
    max_deg: float


@dataclass(frozen=True, slots=True)
class StopMeans:
    """One rung of the ladder that STOP climbs, known before each move."""

    name: str
    """`retarget`, `abort` (of a silent slew), `end of move`, `release` or `power`."""
    proven: bool
    """Whether a source documents that it works on this firmware."""
    sentence: str
    loses_position: bool = False
    needs_consent: bool = False
    """Used only if the user enabled it in `birdcage.toml`."""


END_OF_MOVE = StopMeans(
    "end of move", proven=True, sentence="a move of one axis cannot be called back; it stops at its target"
)
POWER_SWITCH = StopMeans("power", proven=True, sentence="the power of the dish is cut, by hand", loses_position=True)


@dataclass(frozen=True, slots=True)
class Handling:
    """What a person at the dish has to know of it as a machine: sentences from its papers, empty if none is known.

    `docs/safety.md` has them all, with who says so.
    """

    clearance: str = ""
    """What must keep away from it."""
    weight: str = ""
    coax: str = ""
    """What voltage its coax carries, and what that forbids."""
    north: str = ""
    """How its base is marked."""
    home_remedies: Mapping[str, str] = field(default_factory=dict)
    """What helps an axis that fails to home, by the name of the axis."""


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
    second_same: SecondMove
    """What a second move does on the axis that moves."""
    second_other: SecondMove
    """What it does on the other one."""
    stop_ladder: tuple[StopMeans, ...]
    slew: SilentSlew | None
    """How long ways are gone; None if each axis is always sent by itself."""
    search_switch: SearchSwitch
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
    has_stow: bool
    position_reported: bool
    power_switch: str
    """What a person switches off where no STOP helps: `12 V switch`, `power switch`."""
    reflector: Reflector | None = None
    """As sold; None if its size is not known. It makes the beam, together with the feed."""
    skew: Axis | None = None
    """The axis that turns the feed about the beam; None if there is none."""
    handling: Handling = Handling()

    @property
    def axes(self) -> tuple[Axis, ...]:
        """Every axis that it has."""
        return tuple(axis for axis in (self.azimuth, self.elevation, self.skew) if axis is not None)

    @property
    def axes_together(self) -> bool:
        """Whether both axes are known to move at once."""
        return not self.second_other.waits

    @property
    def moves_in_turn(self) -> bool:
        """Whether it moves one axis at a time, or takes a command only when the one before is done."""
        return self.second_same.waits or self.second_other.waits

    def blocking(self) -> DishModel:
        """Return the same dish, seen to answer no command of a move while a motor runs (reference section 2.6)."""
        kept = tuple(rung for rung in self.stop_ladder if rung.name != "retarget")
        return replace(
            self,
            second_same=SecondMove.BLOCK,
            second_other=SecondMove.BLOCK,
            stop_ladder=(END_OF_MOVE, *kept, POWER_SWITCH),
        )

    def axis(self, index: int) -> Axis:
        """Return the axis that the firmware counts as `index`; KeyError for any other."""
        return {axis.index: axis for axis in self.axes}[index]
