"""A plan: a plain value that says what a dish will do during one pass, made before it moves."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import datetime
from enum import Enum
from typing import TYPE_CHECKING

from birdcage.sky.passes.model import Pass
from birdcage.sky.reach_model import PassReach
from birdcage.tracking.curve import Curve, Floats

if TYPE_CHECKING:
    from birdcage.sky.downlinks import Downlink
    from birdcage.sky.element_error import ElementError
    from birdcage.sky.skew import Skew
    from birdcage.tracking.day import Day
    from birdcage.tracking.planning.refraction import Refraction
    from birdcage.tracking.pointing_error import PointingError

SAME_PASS_S = 300.0
"""Two passes of one satellite are further apart than this; the elements, or where a search began, shift one by less."""


@dataclass(frozen=True, slots=True)
class PlanTarget:
    """Whom the plan follows."""

    name: str
    kind: str
    """As `birdcage.sky.targets`: `satellite`, `slot`, `body`, `star`, `fixed`."""
    norad_id: int | None = None
    frequency_hz: float | None = None
    """Of its downlink; decibels and Doppler are told at it."""
    time_offset_s: float = 0.0
    """How much later than computed it comes."""
    refraction: Refraction = "radio"
    """By what the path of the plan is lifted near the horizon."""
    skew: Skew | None = None
    """Of a slot that is not circular."""
    downlink: Downlink | None = None
    """What it sends at that frequency, where that is known."""


class PlanPart(Enum):
    """What the dish does during a stretch of the plan."""

    FOLLOW = "follow"
    REWIND = "rewind"
    """Turning the cable back to another turn; the target is lost meanwhile."""


@dataclass(frozen=True, slots=True)
class PlanLeg:
    """A stretch of the plan; legs follow each other in time, with gaps where the target cannot be reached."""

    part: PlanPart
    start_s: float
    end_s: float
    from_az_deg: float
    """The dish's own azimuth at the start: the turn of the cable where that is known."""
    to_az_deg: float
    turn: int | None = None
    """Cable = dish azimuth + 360 turn; None if nothing winds up, or the turn is not known."""
    waypoints: tuple[tuple[float, float], ...] = ()
    """Dish azimuth and elevation of every stop of a rewind, and of the way over a no-go sector to a leg that does not
    begin where the one before ended; the last one is where the next following begins. As in `Preposition`."""


@dataclass(frozen=True, slots=True)
class Preposition:
    """Where the dish waits for the first leg, and when it has to leave for it."""

    az_deg: float
    """The dish's own azimuth, as in `PlanLeg`."""
    el_deg: float
    true_az_deg: float
    true_el_deg: float
    waypoints: tuple[tuple[float, float], ...]
    """Dish azimuth and elevation of every stop on the way, the last one too: no step of azimuth is half a turn or
    more, so that the dish cannot choose another way round than was planned, and none cuts a no-go sector."""
    leave_s: float
    """The latest time to leave, in POSIX seconds."""
    slew_s: float


@dataclass(frozen=True, slots=True)
class Keyhole:
    """Where the target goes through faster than the dish can turn."""

    start_s: float
    end_s: float
    max_error_deg: float
    """The greatest error to be expected of this plan."""
    limit_deg: float
    """The least that is possible with both axes at once at their greatest speeds."""
    max_loss_db: float | None = None
    """What `max_error_deg` costs at most; None if the beam is not known."""


@dataclass(frozen=True, slots=True, eq=False)
class Forecast:
    """What the dish adds to the pointing error while it follows; `PointingError` adds what the elements do."""

    t_s: Floats
    error_deg: Floats
    loss_db: Floats | None
    """By the beam of dish and feed, as `Beam.loss_db`; None if that is not known."""
    rms_deg: float
    max_deg: float


@dataclass(frozen=True, slots=True)
class Incident:
    """Something that will happen, to be written on the time axis before it does."""

    at_s: float
    what: str
    """`aos`, `reach`, `tca`, `keyhole`, `rewind`, `unreach`, `los`."""
    text: str
    """For a person, what holds from then on: `above the 65° ceiling`, `cable turns back, up to 9.6 s`."""


@dataclass(frozen=True, slots=True, eq=False)
class Plan:
    """What will be done, and how well. Nothing in it changes; another plan replaces it."""

    aim: PlanTarget
    made_at: datetime
    passing: Pass | None
    """None for what does not pass: slots, stars, fixed directions, and bodies."""
    reach: PassReach
    sky: Curve
    """Where the target stands, from AOS to LOS: true degrees, lifted by refraction."""
    course: Curve | None
    """Where the dish is to stand, in its own degrees, azimuth unrolled as in `PlanLeg`, from the first leg to the last;
    None if nothing can be reached."""
    legs: tuple[PlanLeg, ...]
    preposition: Preposition | None
    keyholes: tuple[Keyhole, ...]
    forecast: Forecast | None
    incidents: tuple[Incident, ...]
    notes: tuple[str, ...] = ()
    """Sentences for a person: what will be missed and why, what was not known."""
    share: float | None = None
    """For axes that move in turn: what part of its time the azimuth was given. None for axes that move together."""
    refined: bool = True
    """Whether `share` was chosen by simulating the pass; False: 0.9 was taken, and a better one may follow."""
    elements: ElementError | None = None
    """How far off the elements may be; None for what follows none, and for orbits that are made up."""
    pointing: PointingError | None = None
    """What to expect of dish and elements together; None if nothing is followed."""
    day: Day | None = None
    """The next 24 hours of what does not pass; None for a pass, or where not all of them are known."""

    def is_same_pass(self, other: Plan) -> bool:
        """Return whether two plans are for the same pass of the same target: then one may replace the other under way.

        A target that does not pass has one pass only.
        """
        mine, its = self.aim, other.aim
        if (mine.kind, mine.name, mine.norad_id) != (its.kind, its.name, its.norad_id):
            return False
        if self.passing is None or other.passing is None:
            return self.passing is other.passing
        moved_s = abs(mine.time_offset_s - its.time_offset_s)
        return abs((self.passing.tca - other.passing.tca).total_seconds()) <= SAME_PASS_S + moved_s

    @property
    def goes_on(self) -> bool:
        """Whether following ends only because the plan does: another one carries it on."""
        return self.passing is None and bool(self.legs) and self.legs[-1].end_s >= self.sky.end_s - 1.0

    @property
    def reach_end_s(self) -> float | None:
        """When its last reach ends (POSIX seconds), as far as can be told.

        None: nothing is in reach, it is always up in reach, or no end was found within a day.
        """
        if not self.legs:
            return None
        if not self.goes_on:
            return self.legs[-1].end_s
        return None if self.day is None else self.day.reach_end_s(self.legs[-1].end_s - 1.0)

    @property
    def rewinds(self) -> tuple[PlanLeg, ...]:
        """The announced rewinds."""
        return tuple(leg for leg in self.legs if leg.part is PlanPart.REWIND)
