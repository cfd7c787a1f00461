"""A machine that leaves the turn of its cable to the host: what it is sent is the turn that the gate has judged."""

from __future__ import annotations

from dataclasses import replace
from typing import Any, cast

from birdcage.antenna.gate import MotionGate
from birdcage.rotator.axis import TurnBy
from birdcage.rotator.ladder import StopOrder
from birdcage.rotator.rotator import Rotator
from birdcage.rotator.values import MOTOR_AZIMUTH, Taken


def by_cable(rotator: Rotator, gate: MotionGate) -> Rotator:
    """Return the machine as the antenna speaks to it: in azimuths of the circle."""
    if rotator.facts.azimuth.turn_by is TurnBy.MACHINE:
        return rotator
    return cast(Rotator, CableTurn(rotator, gate))


class CableTurn:
    """A `Rotator` around one that takes the turn of its cable for an azimuth. All else goes to that one."""

    def __init__(self, rotator: Rotator, gate: MotionGate) -> None:
        self._rotator, self._gate = rotator, gate
        self._last_deg = 0.0
        """The turn of the cable when it was last known: STOP may come when the position is in doubt."""

    def __getattr__(self, name: str) -> Any:  # noqa: ANN401 - whatever the machine has
        return getattr(self._rotator, name)

    def send(self, motor: int, deg: float, *, hurry: bool = False, busy_s: float = 0.0) -> Taken:
        """See `Rotator`."""
        return self._rotator.send(motor, self._on_cable(motor, deg), hurry=hurry, busy_s=busy_s)

    def stop_now(self, order: StopOrder) -> None:
        """See `Rotator`."""
        aim = {motor: self._on_cable(motor, deg) for motor, deg in order.aim_deg.items()}
        self._rotator.stop_now(replace(order, aim_deg=aim))

    def _on_cable(self, motor: int, deg: float) -> float:
        gate = self._gate
        if motor != MOTOR_AZIMUTH:
            return deg
        cable_deg, way = gate.cable_deg, gate.way_to(deg)
        self._last_deg = self._last_deg if cable_deg is None else cable_deg
        return self._last_deg + way.deg
