"""What goes along with a pass: the seam that the log, the user's hooks and the receiver keep to.

Anything else is added in the same way (`PursuitDesk.add_listener`): a recorder, a page on the web.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, fields
from datetime import datetime
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from birdcage.base.config import Settings
    from birdcage.sky.elements import ElementSet
    from birdcage.sky.observer import Observer
    from birdcage.station.events import Event
    from birdcage.station.pursuit_state import Pursuit
    from birdcage.tracking.plan import Plan


@dataclass(frozen=True, slots=True, eq=False)
class LivePass:
    """What is being followed, or will be, from the moment at which the station has taken it on."""

    pursuit: Pursuit
    settings: Settings
    """Those that count now. What has begun under others may be ended under those."""
    observer: Observer | None
    """Where the dish stands; None if no place is set."""
    elements: ElementSet | None
    """By which a satellite is followed; None for what is none."""

    @property
    def plan(self) -> Plan:
        """The plan that the station carries out."""
        return self.pursuit.plan

    def differs(self, other: LivePass) -> bool:
        """Return whether anything of it is another object than in `other`: plans are not compared by value."""
        return any(getattr(self, each.name) is not getattr(other, each.name) for each in fields(self))


@dataclass(frozen=True, slots=True)
class PassRemark:
    """A line of text about a target's pass, which may have ended, or not begun."""

    name: str
    """Of the target."""
    utc: datetime
    text: str


@dataclass(frozen=True, slots=True)
class PassFile:
    """A file or a folder that was made of a target's pass, which may have ended, or not begun."""

    name: str
    """Of the target."""
    utc: datetime
    path: str
    """An absolute one."""


class PassListener:
    """Does nothing by itself: override what is wanted.

    Methods without a word on threads are called on the desk's; none of them may wait. One that raises is told nothing
    more, but `close`; neither the pass nor another listener hears of it, and a sentence tells the user.
    """

    label = "listener"
    """What it is called in that sentence."""

    def begins(self, live: LivePass) -> None:
        """A pass is taken on: it waits for its start, or is under way."""

    def changes(self, live: LivePass) -> None:
        """More is known of it: another phase, a better plan, or a pursuit that took its place (`pursuit.number`)."""

    def ends(self) -> None:
        """Nothing is followed any more."""

    def hear(self, event: Event, *, demo: bool) -> None:
        """Take an event of the station: a sample is `Followed`. On the station's thread, whether a pass is on or not.

        `demo`: whether the dish is a simulated one.
        """

    def signal(self, value: float, unit: str, at: float) -> None:
        """Take the strength that a receiver tells, at a monotonic time. Any thread."""

    def remark(self, remark: PassRemark) -> None:
        """Take what another listener says of a pass. Any thread."""

    def made(self, file: PassFile) -> None:
        """Take that another listener has a file of a pass. Any thread."""

    def step(self) -> float:
        """Do what is due; return when to come again, in monotonic seconds, `inf` for not before something else."""
        return math.inf

    @property
    def busy(self) -> bool:
        """Whether `close` has something to end or to write. Any thread."""
        return False

    @property
    def problem(self) -> str:
        """What is not done, and why, as a sentence; empty when all is well."""
        return ""

    def close(self) -> None:
        """End, and write what is to be kept. The program waits for it: a fraction of a second at most."""
