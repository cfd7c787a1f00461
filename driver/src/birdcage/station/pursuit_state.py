"""What the station tells of a pursuit: which phase it is in, why it waits, and how well it points."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import datetime
from enum import Enum
from typing import TYPE_CHECKING, Literal, TypedDict

if TYPE_CHECKING:
    from birdcage.tracking.plan import Plan

DONE = "The pass is over."
"""Why a pursuit is over that was followed to its end."""
AtEnd = Literal["park", "stay", "next"]
"""What happens after the last leg. `next`: stay, whoever plans will ask for the next pass. Never stow."""


class Phase(Enum):
    """What a pursuit is doing."""

    WAITING = "waiting"
    """For the time to leave."""
    COUNTDOWN = "countdown"
    """It is about to move without a fresh request: `next_at` says when. STOP cancels it."""
    PREPOSITIONING = "prepositioning"
    READY = "ready"
    """At the first point of the plan."""
    FOLLOWING = "following"
    REWINDING = "rewinding"
    """The cable is turned back, as the plan has announced."""
    YIELDED = "yielded"
    """Somebody else has control; it goes on, after a countdown, when they give it back."""
    INTERRUPTED = "interrupted"
    """The link was lost, or the clock stepped: the dish stays still. `why` says what would make it go on."""
    PARKING = "parking"
    OVER = "over"
    """`why` says how it ended."""


@dataclass(frozen=True, slots=True)
class PursuitOptions:
    """How a plan is to be carried out. `birdcage.toml` has the same keys in `[tracking]`."""

    controller: Literal["auto", "fast", "velocity", "queued", "modelled", "leapfrog"] = "auto"
    """`auto`: by the dish's model. `velocity` is refused unless its owner has switched it on."""
    velocity_allowed: bool = False
    dead_band_steps: float = 0.5
    dead_band_db: float | None = None
    """By the beam of dish and feed; the greater of both counts."""
    at_end: AtEnd = "park"
    park_az_deg: float | None = None
    """True. Without a park direction the dish stays."""
    park_el_deg: float | None = None
    resume: bool = False
    """Whether it may go on by itself after a short loss of the link with nothing changed
    (`docs/decisions/0017-the-pursuit-and-the-lease.md`)."""
    resume_within_s: float = 10.0


@dataclass(frozen=True, slots=True)
class PointingSample:
    """One look at how well the dish points. True degrees, all of one moment."""

    at: float
    """Monotonic seconds."""
    utc: datetime
    target_az_deg: float
    """Where the target stands, with refraction."""
    target_el_deg: float
    planned_az_deg: float
    planned_el_deg: float
    commanded_az_deg: float
    commanded_el_deg: float
    reported_az_deg: float
    reported_el_deg: float
    error_deg: float
    """The dish's own: between where the target is computed to be and the reported direction, as an angle on the sky."""
    loss_db: float | None
    """What the error to expect costs with the beam of dish and feed; None if either is not known."""
    expected_error_deg: float | None
    """With what the age of the elements adds as a rule; None if that is not known."""


@dataclass(frozen=True, slots=True)
class Pursuit:
    """A pursuit at one moment. Part of `StationState`; None there when there is none."""

    number: int
    """Counts the pursuits of this station, from 1."""
    holder: str
    plan: Plan
    options: PursuitOptions
    phase: Phase
    since: float
    """Monotonic seconds at which the phase began."""
    why: str
    """A sentence: `Below the 18° floor until 03:21:10.`, `Gpredict has control.`"""
    next_what: str = ""
    """What happens next, as a word or two: `pre-position`, `reach`, `keyhole`, `park`."""
    next_at: datetime | None = None
    controller: str = ""
    """The one that steers, or would."""
    latency_s: float | None = None
    """As measured; None before there was a command."""
    sample: PointingSample | None = None
    """The last look while following."""
    rms_error_deg: float | None = None
    """So far, in this pursuit."""
    max_error_deg: float | None = None


class PursuitChanges(TypedDict, total=False):
    """What of a `Pursuit` is replaced while it lives."""

    plan: Plan
    phase: Phase
    since: float
    why: str
    next_what: str
    next_at: datetime | None
    controller: str
