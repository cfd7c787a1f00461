"""What autotrack chooses from: passes of favourites, and what the schedule in force has promised."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from datetime import datetime
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from birdcage.pursuit.now import Scheduled
    from birdcage.sky.passes.model import Pass
    from birdcage.sky.reach_model import PassReach


@dataclass(frozen=True, slots=True)
class Direction:
    """Where a dish points, in true degrees."""

    az_deg: float
    el_deg: float


Slew = Callable[[Direction, Direction], float]
"""How long a dish takes from one direction to another, in seconds."""


@dataclass(frozen=True, slots=True, eq=False)
class ScheduleCandidate:
    """A pass of a favourite."""

    passing: Pass
    reach: PassReach
    priority: int
    where: Callable[[datetime], Direction]
    """Where the satellite stands at a time of the pass."""
    silence: str = ""
    """Since when it is off the air; empty for what is not known to be."""


@dataclass(frozen=True, slots=True)
class KeptPass:
    """What the schedule in force says of the pass that is followed, or comes next."""

    scheduled: Scheduled
    following: bool
    """Whether the dish is on it already; else it only comes next."""
