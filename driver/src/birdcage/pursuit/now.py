"""What the pursuit desk shows at one moment: immutable, made on the desk's own thread, read by any."""

from __future__ import annotations

from dataclasses import dataclass, field
from datetime import datetime
from enum import Enum
from typing import TYPE_CHECKING

from birdcage.radio.now import RadioNow

if TYPE_CHECKING:
    from birdcage.sky.look import LookAngle
    from birdcage.sky.pass_row import PassRow
    from birdcage.tracking.plan import Aim, Plan


class Mode(Enum):
    """What is done with the chosen target."""

    WATCH = "watch"
    """Shown; nothing moves."""
    AIM = "aim once"
    FOLLOW = "follow"


@dataclass(frozen=True, slots=True)
class Found:
    """A target that fits what was typed."""

    text: str
    """To be given to `choose`."""
    name: str
    kind: str
    detail: str = ""
    """`25544 · 2 h old`, `geostationary`."""
    favourite: bool = False


@dataclass(frozen=True, slots=True)
class Scheduled:
    """One pass in the plan of autotrack, kept or left out."""

    name: str
    norad_id: int
    reach_start: datetime
    reach_end: datetime
    max_reach_elevation_deg: float
    priority: int
    kept: bool
    why: str = ""
    """Why it is left out, or cut short: `overlaps METEOR-M2 4 (priority 2)`."""


@dataclass(frozen=True, slots=True)
class Unfinished:
    """What was being followed when the program ended in mid-pass."""

    name: str
    text: str
    since: datetime
    reach_end: datetime


@dataclass(frozen=True, slots=True)
class DeskNow:
    """All of it."""

    utc: datetime
    query: str = ""
    found: tuple[Found, ...] = ()
    choice: str | None = None
    """What `choose` was given last."""
    aim: Aim | None = None
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
    problem: str = ""
    """A sentence on what is missing, and what to do: `No place is set: birdcage place set ...`."""
