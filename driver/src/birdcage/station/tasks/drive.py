"""Driving as a task: the dish goes on in a direction while somebody holds a key, and ends by itself."""

from __future__ import annotations

from birdcage.antenna.antenna import BirdcageAntenna
from birdcage.base.clock import Clock
from birdcage.base.errors import PositionUnknown
from birdcage.rotator.axis import Axis
from birdcage.station.tasks.held_key import HeldKeyTask
from birdcage.tracking.steps import ReadPosition, Send, Steps, Wait

EVERY_S = 0.2
"""How often the dish gets a target further on."""
AHEAD_S = 0.5
"""Each target lies so far ahead at full speed: without the next one the dish comes to rest there."""
MOST_AHEAD_DEG = 5.0
LEAST_AHEAD_DEG = 0.5
EACH_DEG = 2.0
"""How far each move goes on a dish that takes one at a time."""


class DriveTask(HeldKeyTask):
    """Sends targets just ahead, one after the other. Whatever keeps the next one back, the dish rests at the last."""

    kind = "drive"

    def __init__(self, antenna: BirdcageAntenna, clock: Clock, holder: str, az: int, el: int) -> None:
        """`az` and `el` are -1, 0 or 1: clockwise and up positive."""
        super().__init__(antenna, clock, holder)
        self._az, self._el = az, el

    def hold(self, az: int, el: int) -> None:
        """It is asked for once more, perhaps in another direction."""
        self._az, self._el = az, el
        self.renew()

    def steps(self, now_s: float, *, asked: bool) -> Steps:  # noqa: ARG002 - nothing but a held key begins it
        """Go on while it is asked for, and there is room."""
        while self.is_held:
            targets = self._targets()
            if not targets:
                return
            for axis, deg in targets:
                now_s = (yield Send(axis, deg)).now_s
            now_s = (yield Wait(now_s + EVERY_S * self._clock.rate)).now_s
            now_s = (yield ReadPosition()).now_s

    def _targets(self) -> list[tuple[int, float]]:
        """Return the axes that have room, and where to: the dish's own angles."""
        gate, model = self._antenna.gate, self._antenna.model
        here = gate.position
        if here is None:
            raise PositionUnknown("The dish does not know where it points, so it is not driven.")
        targets = []
        # It must have somewhere to go until the next reading.
        ahead_s = max(AHEAD_S, (model.least_look_interval_s or 0.0) + EVERY_S)
        motion, in_turn = self._antenna.motion, self._antenna.strategy.one_at_a_time
        # One move at a time begins where the last one ends; else each replaces the last, and is counted from here.
        az_deg, el_deg = motion.rest if in_turn and motion is not None else (here.azimuth, here.elevation)
        if self._az:
            to_deg = az_deg + self._az * (EACH_DEG if in_turn else _ahead_deg(model.azimuth, ahead_s))
            if gate.cable_limits is not None and gate.cable_deg is not None:
                low, high = (here.azimuth + limit - gate.cable_deg for limit in gate.cable_limits)
                to_deg = min(max(to_deg, low), high)
            if abs(to_deg - here.azimuth) > model.azimuth.step_deg:
                targets.append((model.azimuth.index, to_deg))
        if self._el:
            to_deg = el_deg + self._el * (EACH_DEG if in_turn else _ahead_deg(model.elevation, ahead_s))
            to_deg = gate.nearest_el_deg(to_deg)
            if abs(to_deg - here.elevation) > model.elevation.step_deg:
                targets.append((model.elevation.index, to_deg))
        return targets


def _ahead_deg(axis: Axis, ahead_s: float) -> float:
    way_deg = (axis.speed_deg_s or 0.0) * ahead_s
    return min(max(way_deg, LEAST_AHEAD_DEG), MOST_AHEAD_DEG)
