"""What the pursuit desk shows at one moment: immutable, made on the desk's own thread, read by any."""

from __future__ import annotations

from dataclasses import dataclass, field
from datetime import datetime, timedelta
from enum import Enum
from typing import TYPE_CHECKING

from birdcage.radio.now import RadioNow

if TYPE_CHECKING:
    from birdcage.sky.look import LookAngle
    from birdcage.sky.pass_row import PassRow
    from birdcage.tracking.plan import Plan, PlanTarget

NO_PLACE = "No place is set. `birdcage place add home WHERE --use` sets one: a city, a locator (JO21jv), or two angles."
"""The problem of a desk that does not know where the dish stands, and of a target that it is to locate."""

SAME_PASS = timedelta(minutes=15)
"""By how much newer elements may shift a scheduled pass that is still the same one."""


class Mode(Enum):
    """What is done with the chosen target."""

    WATCH = "watch"
    """Shown; nothing moves."""
    AIM = "aim once"
    FOLLOW = "follow"


@dataclass(frozen=True, slots=True)
class TargetMatch:
    """A target that fits what was typed."""

    text: str
    """To be given to `choose`."""
    name: str
    kind: str
    detail: str = ""
    """`25544 · 2 h old`, `geostationary`, `silent since 2025-08 · 33591`."""
    favourite: bool = False
    silent: bool = False
    """Whether it is known to send nothing any more."""


@dataclass(frozen=True, slots=True)
class Located:
    """Where a target that was typed stands now; for the go-to line."""

    text: str
    """What was typed."""
    name: str = ""
    """Of the one target that is meant; empty if `problem` says why there is none."""
    exact: bool = False
    """Whether that is by its whole name or number, and not by a part of a name."""
    az_deg: float | None = None
    """True; None if `problem` says why."""
    el_deg: float | None = None
    """The same, refraction included as set."""
    silence: str = ""
    """`silent since 2025-08-13`; empty for what is not known to be."""
    skew: str = ""
    """How far to turn a feed for a slot (`birdcage.sky.skew`); empty if that does not matter."""
    problem: str = ""
    """Why there is no direction: nothing or several are meant, it is below the horizon, no place is set."""
    several: bool = False
    """Whether several may be meant."""


@dataclass(frozen=True, slots=True)
class Scheduled:
    """One pass in the plan of autotrack, kept or left out."""

    name: str
    norad_id: int
    reach_start: datetime
    reach_end: datetime
    reach_s: float
    """How much of that is in reach: without gaps, as above the ceiling."""
    max_elevation_deg: float
    """Of the whole pass."""
    max_reach_elevation_deg: float
    priority: int
    kept: bool
    why: str = ""
    """Why it is left out, or cut short: `overlaps METEOR-M2 4 (priority 2)`."""
    is_part: bool = False
    """Whether what is kept is less than its pass: joined late, or left early."""

    def is_same_pass(self, other: Scheduled) -> bool:
        """Return whether two rows are of one pass."""
        same = (self.norad_id, self.name) == (other.norad_id, other.name)
        return same and abs(self.reach_start - other.reach_start) < SAME_PASS


@dataclass(frozen=True, slots=True)
class Unfinished:
    """What was being followed when the program ended in mid-pass."""

    name: str
    text: str
    since: datetime
    reach_end: datetime | None
    """None for what is always up in reach."""


@dataclass(frozen=True, slots=True)
class Resumable:
    """What STOP or a hand has ended or interrupted, and could be taken up again now."""

    name: str
    """Of the target; `autotrack` where nothing was followed when STOP switched that off."""
    plan: Plan | None
    reach_end: datetime | None
    """None for what is always up in reach, and for autotrack alone."""
    autotrack: bool
    """Whether autotrack goes on with it."""


@dataclass(frozen=True, slots=True)
class DeskNow:
    """All of it."""

    utc: datetime
    query: str = ""
    found: tuple[TargetMatch, ...] = ()
    found_note: str = ""
    """Why none of them is what was typed, and what to do; empty for nothing."""
    located: Located | None = None
    """Where the target stands that `locate` was asked for; None for none."""
    choice: str | None = None
    """What `choose` was given last."""
    aim: PlanTarget | None = None
    plan: Plan | None = None
    """For the present or next pass of the choice; of a target that does not pass, for the next hour."""
    passes: tuple[PassRow, ...] = ()
    """Its next ones, the plan's first."""
    look: LookAngle | None = None
    """Where it stands now, without refraction."""
    mode: Mode = Mode.WATCH
    autotrack: bool = False
    schedule: tuple[Scheduled, ...] = ()
    """What autotrack would do, or does: its dry run."""
    radio: RadioNow = field(default_factory=RadioNow)
    unfinished: Unfinished | None = None
    resumable: Resumable | None = None
    note: str = ""
    """What a person should know of the choice: silent, below the horizon. It can be followed all the same."""
    problem: str = ""
    """A sentence on what is missing, and what to do: `No place is set: birdcage place set ...`."""
    is_away: bool = False
    """Whether there is no desk to ask now: it would be another program's. Then `problem` says why."""
