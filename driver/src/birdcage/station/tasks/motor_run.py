"""A motor that runs without a target, as a task: while somebody holds a key, and short of every limit."""

from __future__ import annotations

from birdcage.antenna.antenna import BirdcageAntenna
from birdcage.base.clock import Clock
from birdcage.base.errors import MotionRefused, NoReply
from birdcage.base.geometry import shortest_turn
from birdcage.base.reason import Reason
from birdcage.rotator.axis import Axis
from birdcage.rotator.feature import Feature
from birdcage.station.tasks.held_key import HeldKeyTask
from birdcage.tracking.steps import ReadPosition, RunMotor, Steps, Wait

FIRST_S = 1.0
"""So long it runs after it was asked for once: a keyboard waits up to a second before it repeats a key that is held."""
EVERY_S = 0.1
"""How often the dish is read meanwhile."""
LATENCY_S = 0.3
"""From a reading to the moment at which STOP takes effect, beside `EVERY_S`: two answers, and a slow one among them."""
STILL_DEG, STILL_S = 0.15, 2.0
"""A motor that is on for so long, with a position that has not left so narrow a place, is not seen to turn."""


class MotorRunTask(HeldKeyTask):
    """Sets the motor running, reads where the dish is, and ends. STOP is sent by whoever drives it."""

    kind = "motor run"
    done_words = "No longer held: STOP was sent."

    def __init__(self, antenna: BirdcageAntenna, clock: Clock, holder: str, feature: Feature, value: float) -> None:
        """`feature` is one of those that are `HELD`, of the azimuth or the elevation."""
        assert feature.held is not None, "whoever asked has looked"
        super().__init__(antenna, clock, holder, FIRST_S)
        self.feature, self._value = feature, value
        self._az = antenna.model.azimuth.name == feature.held.axis
        self._seen_deg_s = 0.0
        """How fast it was seen to turn, and which way."""

    def hold(self, value: float) -> None:
        """It is asked for once more, perhaps the other way."""
        self._value = value
        self.renew()

    def refuse(self) -> None:
        """Raise MotionRefused where a run from here could not be ended before a limit.

        The way that it is wired to turn counts, and the way that it is seen to turn.
        """
        share = self._value / (self.feature.range.high if self.feature.range is not None else 1.0)
        for speed_deg_s in (share * (self._axis.speed_deg_s or 0.0), self._seen_deg_s):
            if speed_deg_s:
                self._refuse_way(self._braking_deg(speed_deg_s))

    def steps(self, now_s: float, *, asked: bool) -> Steps:  # noqa: ARG002 - nothing but a held key begins it
        """Run while it is asked for, nothing is in the way, and the dish tells where it is."""
        running: float | None = None
        still_since, still_deg = self._clock.monotonic(), self._deg
        while self.is_held:
            self.refuse()
            if running != self._value:
                running = self._value
                now_s = (yield RunMotor(self.feature.id, running)).now_s
                still_since, still_deg = self._clock.monotonic(), self._deg
            before_deg, before = self._deg, self._clock.monotonic()
            now_s = (yield Wait(now_s + EVERY_S * self._clock.rate)).now_s
            seen = yield ReadPosition()
            now_s, now = seen.now_s, self._clock.monotonic()
            if seen.az_deg is None:
                raise NoReply("The dish did not tell where it is, so STOP was sent.", reason=Reason.SILENT)
            self._seen_deg_s = self._way_deg(before_deg, self._deg) / max((now - before) * self._clock.rate, 1e-3)
            if abs(self._way_deg(still_deg, self._deg)) > STILL_DEG:
                still_since, still_deg = now, self._deg
            elif now - still_since >= STILL_S:
                raise MotionRefused(
                    f"The {self._axis.name} is not seen to turn, so STOP was sent. Either the motor does not turn, or "
                    "its encoder does not count: then nothing would end it at a limit.",
                    reason=Reason.FAILED,
                )

    @property
    def _axis(self) -> Axis:
        return self._antenna.model.azimuth if self._az else self._antenna.model.elevation

    @property
    def _deg(self) -> float:
        """Where the axis was read last: the dish's own angle."""
        self._antenna.gate.require_position()
        here = self._antenna.gate.position
        assert here is not None, "it was just required"
        return here.azimuth if self._az else here.elevation

    def _way_deg(self, before_deg: float, after_deg: float) -> float:
        return shortest_turn(before_deg, after_deg) if self._az else after_deg - before_deg

    def _braking_deg(self, speed_deg_s: float) -> float:
        """Return how far the axis gets at a speed before it rests, with its sign, if STOP is sent a look later."""
        axis, rate = self._axis, self._clock.rate
        brakes_deg = speed_deg_s**2 / (2.0 * axis.acceleration_deg_s2) if axis.acceleration_deg_s2 else 0.0
        way_deg = abs(speed_deg_s) * (EVERY_S + LATENCY_S) * rate + brakes_deg
        return way_deg if speed_deg_s > 0.0 else -way_deg

    def _refuse_way(self, way_deg: float) -> None:
        """Raise MotionRefused where a way from here leads out of the limits, or through a no-go sector."""
        gate, here = self._antenna.gate, self._deg
        (low, high), at = gate.el_limits_deg, here
        if self._az:
            low, high = self._axis.min_deg, self._axis.max_deg
            if gate.cable_limits is not None and gate.cable_deg is not None:
                (low, high), at = gate.cable_limits, gate.cable_deg
        limit = high if way_deg > 0.0 else low
        is_endless = self._az and gate.cable_limits is None and high - low >= 360.0
        if not is_endless and (at + way_deg - limit) * way_deg > 0.0:
            raise MotionRefused(
                f"The {self._axis.name} stands at {at:.2f}°, and its limit that way is {limit:.2f}°. At this speed it "
                f"needs {abs(way_deg):.2f}° to come to rest, so its motor is not run. Run it slower, or use a go-to.",
                reason=Reason.AZ_LIMIT if self._az else Reason.EL_LIMIT, limit_deg=limit, by_deg=abs(way_deg),
            )  # fmt: skip
        try:
            gate.check_axis(self._axis.index, (here + way_deg) % 360.0 if self._az else here + way_deg)
        except MotionRefused as refused:
            if refused.reason is Reason.SECTOR:
                raise
