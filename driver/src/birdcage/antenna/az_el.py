"""Azimuth, elevation and skew of any machine: all above goes by them, the machine by the names of its own axes."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

from birdcage.antenna.gate import MotionGate
from birdcage.base.clock import Clock
from birdcage.base.errors import CommandRefused
from birdcage.rotator.axis import TurnBy
from birdcage.rotator.facts import Facts
from birdcage.rotator.feature import Feature, Reading, Value
from birdcage.rotator.hooks import Hooks
from birdcage.rotator.ladder import StopOrder
from birdcage.rotator.rotator import Line, Rotator
from birdcage.rotator.values import MOTOR_AZIMUTH, MOTOR_ELEVATION, MOTOR_SKEW, Look, Position, Survey, Taken


class AzEl:
    """A machine as the antenna speaks to it; what is not about angles goes to the `Rotator` as it is.

    Axes go by number here (`Axis.index`), and azimuths lie on the circle: a machine that leaves the turn of its cable
    to the host is sent the turn that the gate has judged.
    """

    def __init__(self, rotator: Rotator, gate: MotionGate) -> None:
        self._rotator, self._gate = rotator, gate
        self._last_deg = 0.0
        """The turn of the cable when it was last known: STOP may come when the position is in doubt."""

    def __getattr__(self, name: str) -> Any:  # noqa: ANN401 - whatever the machine has
        return getattr(self._rotator, name)

    @property
    def facts(self) -> Facts:
        """See `Rotator`."""
        return self._rotator.facts

    @facts.setter
    def facts(self, facts: Facts) -> None:
        self._rotator.facts = facts

    @property
    def is_open(self) -> bool:
        """See `Rotator`."""
        return self._rotator.is_open

    @property
    def clock(self) -> Clock:
        """See `Rotator`."""
        return self._rotator.clock

    @property
    def line(self) -> Line:
        """See `Rotator`."""
        return self._rotator.line

    def open(self, address: str, baud: int | None, clock: Clock, hooks: Hooks) -> None:
        """See `Rotator`."""
        self._rotator.open(address, baud, clock, hooks)

    def stop_now(self, order: StopOrder) -> None:
        """See `Rotator`. Any thread."""
        self._rotator.stop_now(order)

    def settle(self, within_s: float) -> tuple[CommandRefused | None, ...]:
        """See `Rotator`."""
        return self._rotator.settle(within_s)

    def survey(self) -> Survey:
        """See `Rotator`."""
        return self._rotator.survey()

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
        """See `Rotator`."""
        return self.position(self._rotator.look(hurry=hurry, busy_s=busy_s))

    def position(self, look: Look) -> Position:
        """Return where the machine is that tells this."""
        facts, angles = self._rotator.facts, look.angles
        skew = None if facts.skew is None else angles.get(facts.skew.name)
        return Position(angles[facts.azimuth.name], angles[facts.elevation.name], skew)

    def send(self, motor: int, deg: float, *, hurry: bool = False, busy_s: float = 0.0) -> Taken:
        """See `Rotator`."""
        return self._rotator.send(self._named({motor: deg}), hurry=hurry, busy_s=busy_s)

    def begin_slew(self, az_deg: float, el_deg: float, skew_deg: float | None) -> None:
        """See `Rotator`."""
        to = {MOTOR_AZIMUTH: az_deg, MOTOR_ELEVATION: el_deg}
        self._rotator.begin_slew(self._named(to if skew_deg is None else {**to, MOTOR_SKEW: skew_deg}))

    def retarget(self, az_deg: float, el_deg: float) -> Mapping[str, float]:
        """Return what a `StopOrder` has to name to come to rest there."""
        return self._named({MOTOR_AZIMUTH: az_deg, MOTOR_ELEVATION: el_deg})

    def home(self, motor: int) -> None:
        """See `Rotator`."""
        self._rotator.home(self._name(motor))

    def by_number(self, values: Mapping[str, float]) -> dict[int, float]:
        """Return what the machine tells of its axes."""
        return {self._rotator.facts.named(name).index: value for name, value in values.items()}

    def _name(self, motor: int) -> str:
        return self._rotator.facts.axis(motor).name

    def _named(self, to: Mapping[int, float]) -> dict[str, float]:
        turn = self._rotator.facts.azimuth.turn_by is TurnBy.HOST
        return {
            self._name(motor): self._on_cable(deg) if turn and motor == MOTOR_AZIMUTH else deg
            for motor, deg in to.items()
        }

    def _on_cable(self, deg: float) -> float:
        gate = self._gate
        cable_deg, way = gate.cable_deg, gate.way_to(deg)
        self._last_deg = self._last_deg if cable_deg is None else cable_deg
        return self._last_deg + way.deg
