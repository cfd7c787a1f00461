"""Where an axis is, as far as the commands that it was sent tell."""

from __future__ import annotations

import math
from functools import lru_cache

from birdcage.antenna.motion import plan_axis
from birdcage.base.geometry import shortest_turn
from birdcage.kinematics import Slew
from birdcage.rotator.axis import Axis
from birdcage.tracking.curve import Curve

DOUBT_DEG = 0.1
"""A reading at rest that is off by more than this, beside the overshoot of its axis, contradicts the model."""
UNSURE_S = 0.15
"""How much later or earlier than modelled an axis may be on its way."""


@lru_cache(maxsize=4)
def spans(course: Curve) -> tuple[tuple[float, float], tuple[float, float]]:
    """Return the least and the greatest azimuth of a course, and the same of its elevation."""
    az, el = course.az_deg, course.el_deg
    return (float(az.min()), float(az.max())), (float(el.min()), float(el.max()))


class AxisBelief:
    """One axis, modelled, in the dish's own degrees, unrolled. Times are POSIX seconds."""

    def __init__(self, axis: Axis, at_deg: float, now_s: float) -> None:
        self.axis = axis
        self.goal_deg = at_deg
        """Where it was sent last."""
        self._slew = Slew(at_deg, ())
        self.began_s = now_s
        """When it has acted on the command that it was sent last."""
        self._shift_deg = 0.0

    def at(self, t_s: float) -> tuple[float, float]:
        """Return where it is at a time, and how fast it turns."""
        at_deg, velocity = self._slew.at(t_s - self.began_s)
        return at_deg + self._shift_deg, velocity

    @property
    def rests_s(self) -> float:
        """When it comes to rest."""
        return self.began_s + self._slew.duration_s

    def planned(self, goal_deg: float, from_s: float) -> Slew:
        """Return its way to a goal if it gets the command at `from_s`."""
        at_deg, velocity = self.at(from_s)
        most = self.axis.speed_deg_s  # one that was faster before its limit was lowered brakes in next to no time
        return plan_axis(self.axis, at_deg, goal_deg, min(max(velocity, -most), most))

    def send(self, goal_deg: float, from_s: float) -> None:
        """Take in that it was sent to a goal."""
        self._slew, self.began_s, self._shift_deg = self.planned(goal_deg, from_s), from_s, 0.0
        self.goal_deg = goal_deg

    def quantised(self, deg: float, span_deg: tuple[float, float]) -> float:
        """Return the nearest angle that the motor can stand at, and no more than the course asks for anywhere.

        A course may touch a limit, and half a step beyond that the gate refuses.
        """
        return min(max(round(deg / self.axis.step_deg) * self.axis.step_deg, span_deg[0]), span_deg[1])

    def check(self, read_deg: float | None, seen_s: float) -> bool:
        """Compare with a reading; where that contradicts, go by the reading from then on and return False.

        A reading is a check only: it is older and coarser than what the commands tell.
        """
        if read_deg is None:
            return True
        at_deg, velocity = self.at(seen_s)
        read_deg = at_deg + shortest_turn(at_deg, read_deg)
        way_s = UNSURE_S if seen_s < self.rests_s + UNSURE_S else 0.0
        most_deg = DOUBT_DEG + self.axis.overshoot_deg + way_s * self.axis.speed_deg_s
        if abs(read_deg - at_deg) <= most_deg + abs(velocity) * UNSURE_S:
            return True
        self._slew, self.began_s, self._shift_deg, self.goal_deg = Slew(read_deg, ()), seen_s, 0.0, read_deg
        return False

    def lean_on(self, read_deg: float | None, seen_s: float, share: float) -> None:
        """Take in a share of what a reading is off: for an axis that never rests, whose small errors add up."""
        if read_deg is not None:
            self._shift_deg += share * shortest_turn(self.at(seen_s)[0], read_deg)


LAG_SHARE = 0.15
"""What a reading counts for the lag: one a second, so six seconds until a change shows."""


class AxisLag:
    """How far an axis stays behind the goals of a stream: a servo with a dead-band ends short of each.

    The mean of readings, from 0 to `most_deg`, how far a rest may lie from its command (`Axis.overshoot_deg`). An axis
    that runs past its goals has none: play hides that (decision 0035).
    """

    def __init__(self, most_deg: float) -> None:
        self._mean_deg = 0.0
        self._most_deg, self._wildest_deg = most_deg, 2.0 * most_deg

    def take(self, short_deg: float, way_deg: float) -> None:
        """Take in how far below its goal a reading was, while the target went that way. Nothing of one that stood."""
        if way_deg:
            behind_deg = math.copysign(1.0, way_deg) * short_deg
            behind_deg = min(max(behind_deg, -self._wildest_deg), self._wildest_deg)
            self._mean_deg += LAG_SHARE * (behind_deg - self._mean_deg)

    def lead_deg(self, way_deg: float) -> float:
        """Return how much further it is best sent while the target goes that way, signed."""
        lead_deg = min(max(self._mean_deg, 0.0), self._most_deg)
        return math.copysign(lead_deg, way_deg) if way_deg else 0.0
