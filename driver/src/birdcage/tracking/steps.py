"""What a task asks of whoever drives it: requests and waits, one at a time.

`docs/architecture.md`, *Threads*: a task is a generator. It yields a step, the station carries it out on its own
thread between exchanges, and sends a `StepResult` back. Times are POSIX seconds of the clock's UTC, so that a scaled
clock scales them all; azimuths are the dish's own, unrolled: the turn of the cable where that is known.
"""

from __future__ import annotations

from collections.abc import Callable, Generator, Mapping
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import TypeAlias

from birdcage.rotator.feature import Reading, Value


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

    patient: bool = False
    """Whether an answer is waited for as at rest: no target comes after it that its wait could hold up."""


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


@dataclass(frozen=True, slots=True)
class PointAt:
    """Point at a true direction, the usual way, and go on at rest there."""

    az_deg: float
    el_deg: float
    optional: bool = False
    """Whether one beyond the dish's limits is left out: the answer names no direction then. Else the task ends."""
    brisk: bool = False
    """Whether one look after the time at which it must rest is enough, and no second one that agrees is waited for."""


@dataclass(frozen=True, slots=True)
class HearAt(PointAt):
    """Point there, and read features of the machine at rest there; one look is enough, before or after."""

    ids: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class HomeAxis:
    """Find the reference of an axis by running it into its end stop."""

    axis: int
    """Motor number."""


@dataclass(frozen=True, slots=True)
class TakeReferences:
    """Axes were homed: read where the dish is."""

    whole: bool
    """Whether both were: the turn of the cable is counted from here then."""


@dataclass(frozen=True, slots=True)
class ReadFeatures:
    """Read features of the machine by their ids; in motion only those whose cost says `while_moving`."""

    ids: tuple[str, ...]
    optional: bool = False
    """Whether a machine that does not tell is no reason to end the task: the answer has no readings then."""


@dataclass(frozen=True, slots=True)
class WriteFeature:
    """Set a feature of the machine at rest; what it makes of that is in the answer."""

    id: str
    value: Value


@dataclass(frozen=True, slots=True)
class RunMotor:
    """Have a motor run without a target, by a feature that is `HELD`. Whoever drives sends STOP on every way out."""

    id: str
    value: float


@dataclass(frozen=True, slots=True)
class CheckSweep:
    """Judge the sweep that is to begin at a true direction, before anything is sent for it."""

    az_deg: float
    el_deg: float
    sweep: SweepAxis


@dataclass(frozen=True, slots=True)
class SweepAxis:
    """Have the machine sweep an axis by itself from where it stands; go on at rest at its end."""

    axis: int
    """Motor number."""
    span_deg: float
    step_deg: float
    transponders: int
    hear: Callable[[float, float, float], None]
    """Takes each reading as it comes: true azimuth, elevation, level."""


@dataclass(frozen=True, slots=True)
class FindWay:
    """Find how far an axis may turn to and fro, about where it stands. Sends nothing."""

    axis: int
    """Motor number."""
    longest_deg: float


Step: TypeAlias = (
    Wait
    | Send
    | SlewTo
    | PointAt
    | ReadPosition
    | Hear
    | LimitSpeeds
    | HomeAxis
    | TakeReferences
    | ReadFeatures
    | WriteFeature
    | RunMotor
    | CheckSweep
    | SweepAxis
    | FindWay
)


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
    readings: Mapping[str, Reading] = field(default_factory=lambda: MappingProxyType({}))
    """Of `ReadFeatures` and `WriteFeature`, by id: what the machine did not tell is left out."""
    true_az_deg: float | None = None
    """Of a `PointAt` or `SlewTo`: where the dish was read at its end, in true degrees."""
    true_el_deg: float | None = None
    unread: int = 0
    """Of a `SweepAxis`: how many lines could not be read."""
    took_s: float | None = None
    """Of a `ReadPosition`: how long the last question for it took; the dish was there at some time within."""
    way_deg: tuple[float, float] | None = None
    """Of a `FindWay`: its ends on the scale of `Send`; None where there is none, and `refused` says why."""
    refused: str = ""

    def is_lost(self, step: Step) -> bool:
        """Return whether the dish's answer to a step was lost, or came too late."""
        if isinstance(step, ReadPosition):
            return self.az_deg is None
        return isinstance(step, Send | LimitSpeeds) and self.sent_s is None


Steps: TypeAlias = Generator[Step, StepResult, None]
