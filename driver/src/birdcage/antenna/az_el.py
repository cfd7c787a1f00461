"""Azimuth, elevation and skew of any machine: all above goes by them, the machine by the names of its own axes."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace
from typing import Any

from birdcage.antenna.gate import MotionGate
from birdcage.base.clock import Clock
from birdcage.base.errors import CommandRefused, MotionRefused, PositionUnknown
from birdcage.base.geometry import shortest_turn, wrap_360
from birdcage.base.reason import Reason
from birdcage.rotator.axis import TurnBy
from birdcage.rotator.facts import Facts
from birdcage.rotator.feature import Feature, Reading, Value
from birdcage.rotator.hooks import Hooks
from birdcage.rotator.ladder import StopOrder
from birdcage.rotator.rotator import LineStatus, Rotator
from birdcage.rotator.sweep import SweepOrder, SweptReading
from birdcage.rotator.values import MOTOR_AZIMUTH, MOTOR_ELEVATION, MOTOR_SKEW, Look, Position, Survey, Taken

MOST_MISSED_DEG = 1.0
"""Where no beam is known: about half the width of that of a small dish at Ku band."""


class AzEl:
    """A machine as the antenna speaks to it; what is not about angles goes to the `Rotator` as it is.

    Axes go by number here (`Axis.index`), and azimuths lie on the circle: a machine that leaves the turn of its cable
    to the host is sent the turn that the gate has judged.
    """

    def __init__(self, rotator: Rotator, gate: MotionGate) -> None:
        self._rotator, self._gate = rotator, gate
        self._clock: Clock | None = None
        self._looked_at = -math.inf
        self.most_missed_deg = MOST_MISSED_DEG
        """By how much a machine with a mapping may miss a direction that it is sent to."""
        self._told: Facts | None = None
        """Its facts once a person has told where its zeros point."""
        self.check_zero: Callable[[Mapping[str, float]], None] | None = None
        """Hears where it counts its axes to stand, and judges whether what was told still holds.

        It raises PositionUnknown (`unsynced`) where that does not, and NoReply where another reading must tell.
        """

    def __getattr__(self, name: str) -> Any:  # noqa: ANN401 - whatever the machine has
        return getattr(self._rotator, name)

    @property
    def facts(self) -> Facts:
        """See `Rotator`; once it was told where its zeros point, with that (`Facts.told_zero`)."""
        return self._told or self._rotator.facts

    @facts.setter
    def facts(self, facts: Facts) -> None:
        """Take what the machine itself tells: where its zeros point stays."""
        self._rotator.facts = facts
        if self._told is not None:  # it may be known only now for one that needs no telling
            self._told = facts.told_zero(self._told.zero_deg) if facts.zero_at_power_up else None

    def tell_zero(self, zero_deg: Mapping[str, float] | None) -> None:
        """Take in where the zeros of the machine point, by the names of its axes; None: not known (any more)."""
        self.check_zero = None
        self._told = None if zero_deg is None else self._rotator.facts.told_zero(zero_deg)

    def counted(self) -> Mapping[str, float]:
        """Ask once where the machine counts its axes to stand, from its own zeros."""
        return self._rotator.look().angles

    @property
    def is_open(self) -> bool:
        """See `Rotator`."""
        return self._rotator.is_open

    @property
    def clock(self) -> Clock:
        """See `Rotator`. The one that the line was opened with, as long as it is open."""
        return self._rotator.clock if self._clock is None else self._clock

    @property
    def line(self) -> LineStatus:
        """See `Rotator`."""
        return self._rotator.line

    def open(self, address: str, baud: int | None, clock: Clock, hooks: Hooks) -> None:
        """See `Rotator`."""
        self._rotator.open(address, baud, clock, hooks)
        self._clock = clock

    def close(self, within_s: float) -> None:
        """See `Rotator`."""
        self._clock = None
        self._rotator.close(within_s)

    def stop_now(self, order: StopOrder) -> None:
        """See `Rotator`. Any thread."""
        self._rotator.stop_now(order)

    def settle(self, within_s: float) -> tuple[CommandRefused | None, ...]:
        """See `Rotator`."""
        return self._rotator.settle(within_s)

    def survey(self) -> Survey:
        """See `Rotator`."""
        told, el_deg = self._rotator.survey(), self.facts.zero_deg.get(self.facts.elevation.name, 0.0)
        low, high = told.el_min_deg, told.el_max_deg
        if not el_deg or (low is None and high is None):
            return told
        return replace(
            told, el_min_deg=None if low is None else low + el_deg, el_max_deg=None if high is None else high + el_deg
        )

    @property
    def features(self) -> Mapping[str, Feature]:
        """See `Rotator`."""
        return self._rotator.features

    def read(self, ids: Iterable[str]) -> Mapping[str, Reading]:
        """See `Rotator`."""
        return self._rotator.read(ids)

    def write(self, feature: str, value: Value) -> Reading:
        """See `Rotator`."""
        return self._rotator.write(feature, value)

    def look(self, *, hurry: bool = False, busy_s: float = 0.0) -> Position:
        """See `Rotator`. Where it was asked just now (`next_look`), it is listened to until it may be asked again."""
        while (now := self.clock.monotonic()) < (until := self.next_look(now)):
            self._rotator.listen(until)
        self._looked_at = now
        return self.position(self._rotator.look(hurry=hurry, busy_s=busy_s))

    def next_look(self, at: float) -> float:
        """Return when the machine may be asked where it is, at a monotonic time or later."""
        return max(at, self._looked_at + (self._rotator.facts.least_look_interval_s or 0.0))

    def position(self, look: Look) -> Position:
        """Return where the machine is that tells this. PositionUnknown (`unsynced`) until its zeros were told."""
        facts, angles = self.facts, look.angles
        if facts.zero_at_power_up:
            if self._told is None:
                raise PositionUnknown(f"The position is unknown. {facts.must_be_synced}", reason=Reason.UNSYNCED)
            if self.check_zero is not None:
                self.check_zero(angles)
            angles = {name: deg + facts.zero_deg.get(name, 0.0) for name, deg in angles.items()}
        if facts.mapping is not None:
            return Position(*facts.mapping.to_sky(angles))
        skew = None if facts.skew is None else angles.get(facts.skew.name)
        return Position(angles[facts.azimuth.name], angles[facts.elevation.name], skew)

    def send(self, to: Mapping[int, float], *, hurry: bool = False, busy_s: float = 0.0) -> Taken:
        """See `Rotator`."""
        return self._rotator.send(self._named(to), hurry=hurry, busy_s=busy_s)

    def begin_slew(self, az_deg: float, el_deg: float, skew_deg: float | None) -> None:
        """See `Rotator`."""
        facts, to = self._rotator.facts, {MOTOR_AZIMUTH: az_deg, MOTOR_ELEVATION: el_deg}
        if facts.mapping is not None and facts.slew is None:
            self._rotator.send(self.retarget(az_deg, el_deg))
            return
        self._rotator.begin_slew(self._named(to if skew_deg is None else {**to, MOTOR_SKEW: skew_deg}))

    def retarget(self, az_deg: float, el_deg: float) -> Mapping[str, float]:
        """Return what a `StopOrder` has to name to come to rest there."""
        return self._named({MOTOR_AZIMUTH: az_deg, MOTOR_ELEVATION: el_deg})

    def home(self, motor: int) -> None:
        """See `Rotator`."""
        mapped = self._rotator.facts.mapping is not None  # then all of its own axes are homed, for the azimuth
        own = [axis.name for axis in self._rotator.facts.axes if mapped and motor == MOTOR_AZIMUTH]
        for name in own if mapped else [self._rotator.facts.numbered[motor].name]:
            self._rotator.home(name)

    def sweep(self, order: SweepOrder, hear: Callable[[SweptReading | None], None]) -> None:
        """See `Rotator`."""
        self._rotator.sweep(order, hear)

    def by_number(self, values: Mapping[str, float]) -> dict[int, float]:
        """Return what the machine tells of its axes."""
        return {self._rotator.facts.named[name].index: value for name, value in values.items()}

    def nearest(self, az_deg: float, el_deg: float) -> tuple[tuple[float, float], float]:
        """Return the direction that it can point to nearest to one, and by how many degrees on the sky it misses that.

        Azimuth and elevation are the machine's own, as everywhere here.
        """
        mapping = self._rotator.facts.mapping
        if mapping is None:
            return (az_deg, el_deg), 0.0
        angles, miss_deg = mapping.to_axes(az_deg, el_deg)
        return mapping.to_sky(angles), miss_deg

    def nearest_allowed(
        self, az_deg: float, el_deg: float, to_true: Callable[[float, float], tuple[float, float]], *, any_miss: bool
    ) -> tuple[float, float]:
        """Return the nearest direction; MotionRefused (`missed`) where it misses by more than `most_missed_deg`.

        `any_miss` takes it all the same. What is no angle is returned as it is.
        """
        if not (math.isfinite(az_deg) and math.isfinite(el_deg)):
            return az_deg, el_deg
        nearest, miss_deg = self.nearest(az_deg, el_deg)
        if miss_deg > self.most_missed_deg and not any_miss:
            true_az, true_el = to_true(*nearest)
            raise MotionRefused(
                f"The {self._rotator.facts.name} misses this direction by {miss_deg:.2f}°, more than the "
                f"{self.most_missed_deg:.2f}° allowed. Nothing was sent. The nearest that it reaches is azimuth "
                f"{true_az:.2f}°, elevation {true_el:.2f}°.",
                reason=Reason.MISSED, limit_deg=self.most_missed_deg, by_deg=miss_deg - self.most_missed_deg,
            )  # fmt: skip
        return nearest

    def _named(self, to: Mapping[int, float]) -> Mapping[str, float]:
        facts = self.facts
        if facts.mapping is not None:
            return facts.mapping.to_axes(to[MOTOR_AZIMUTH], to[MOTOR_ELEVATION])[0]
        named = {facts.numbered[motor].name: deg for motor, deg in to.items()}
        if facts.azimuth.turn_by is TurnBy.HOST and MOTOR_AZIMUTH in to:
            named[facts.azimuth.name] = self._on_cable(to[MOTOR_AZIMUTH])
        if facts.zero_deg:
            return {name: self._counted_from(facts, name, deg) for name, deg in named.items()}
        return named

    @staticmethod
    def _counted_from(facts: Facts, name: str, deg: float) -> float:
        """Return an angle as the machine counts it. One that takes azimuths of the circle gets one of the circle."""
        counted_deg = deg - facts.zero_deg.get(name, 0.0)
        on_circle = name == facts.azimuth.name and facts.azimuth.turn_by is TurnBy.MACHINE
        return wrap_360(counted_deg) if on_circle else counted_deg

    def _on_cable(self, deg: float) -> float:
        cable_deg, last_deg = self._gate.cable_deg, self._gate.last_cable_deg
        return last_deg + shortest_turn(last_deg, deg) if cable_deg is None else cable_deg + self._gate.way_to(deg).deg
