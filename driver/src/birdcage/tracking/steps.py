"""What an activity asks of whoever drives it: requests and waits, one at a time.

`docs/architecture.md`, *Threads*: an activity is a generator. It yields a step, the station carries it out on its own
thread between exchanges, and sends a `StepResult` back. Times are POSIX seconds of the clock's UTC, so that a scaled
clock scales them all; azimuths are the dish's own, unrolled: the turn of the cable where that is known.
"""

from __future__ import annotations

from collections.abc import Generator, Mapping
from dataclasses import dataclass
from typing import TypeAlias


@dataclass(frozen=True, slots=True)
class Wait:
    """Go on at a time. Other work of the station is done meanwhile."""

    until_s: float


@dataclass(frozen=True, slots=True)
class Send:
    """Send one axis to an angle, through the gate, and go on when the dish has taken it."""

    axis: int
    """Motor number."""
    deg: float
    beyond: bool = False
    """Whether it is further than the course goes soon: where a no-go sector is in the way, the answer is a lost one."""


@dataclass(frozen=True, slots=True)
class SlewTo:
    """Send both axes along way points, the usual way, and go on at rest at the last one."""

    waypoints: tuple[tuple[float, float], ...]


@dataclass(frozen=True, slots=True)
class ReadPosition:
    """Read where the dish is."""


@dataclass(frozen=True, slots=True)
class Hear:
    """Read the dish's own tuner, if it has one, at most every `every_s` seconds of the wire's own time.

    Nothing has to be sent before `until_s`: the dish stands still on its target.
    """

    until_s: float
    every_s: float


@dataclass(frozen=True, slots=True)
class LimitSpeeds:
    """Set the greatest speed of axes, for velocity-matched moves; whoever drives restores them on every way out."""

    speeds_deg_s: Mapping[int, float]
    """By motor number."""


Step: TypeAlias = Wait | Send | SlewTo | ReadPosition | Hear | LimitSpeeds


@dataclass(frozen=True, slots=True)
class StepResult:
    """What came of a step."""

    now_s: float
    sent_s: float | None = None
    """When the line of a `Send` or `LimitSpeeds` began to go out; None if its answer was lost: it may have been
    taken."""
    az_deg: float | None = None
    """Of a `ReadPosition` or `SlewTo`: where the dish was; None if that is not known."""
    el_deg: float | None = None
    seen_s: float | None = None
    """When it was there, as well as can be told: in the middle of the exchange."""

    def is_lost(self, step: Step) -> bool:
        """Return whether the dish's answer to a step was lost, or came too late."""
        if isinstance(step, ReadPosition):
            return self.az_deg is None
        return isinstance(step, Send | LimitSpeeds) and self.sent_s is None


Activity: TypeAlias = Generator[Step, StepResult, None]
