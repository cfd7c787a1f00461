"""One axis: trapezoids of speed in closed form, and everything that it ever did."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace


@dataclass(frozen=True)
class Leg:
    """So long at one acceleration."""

    begins: float
    lasts: float
    deg: float
    speed: float
    accel: float

    @property
    def ends(self) -> float:
        return self.begins + self.lasts

    def at(self, now: float) -> tuple[float, float]:
        """Return place and speed."""
        t = min(max(now - self.begins, 0.0), self.lasts)
        return self.deg + (self.speed + self.accel * t / 2) * t, self.speed + self.accel * t

    def span(self) -> tuple[float, float]:
        """Return the lowest and the highest place of the leg."""
        places = [self.deg, self.at(self.ends)[0]]
        if self.accel and 0 < -self.speed / self.accel < self.lasts:
            places.append(self.at(self.begins - self.speed / self.accel)[0])
        return min(places), max(places)


class Motor:
    """Goes where it is sent, from whatever it does."""

    def __init__(self, deg: float, speed: float, accel: float) -> None:
        self.max_speed, self.accel = speed, accel
        self._done: list[Leg] = []
        self._legs: list[Leg] = []
        self.rest = deg
        """Where it will stand once all that it was told is done."""

    def at(self, now: float) -> float:
        """Return where it is."""
        return self._state(now)[0]

    def turns(self, now: float) -> bool:
        """Return whether it moves."""
        return now < self.ends - 1e-9

    @property
    def ends(self) -> float:
        """When it comes to rest; `-inf` while it rests."""
        return self._legs[-1].ends if self._legs else -math.inf

    def go(self, now: float, target: float) -> None:
        """Go to a place, at once."""
        deg, speed = self._cut(now)
        self._legs = self._plan(now, deg, speed, target)
        self.rest = target

    def go_then(self, begins: float, target: float) -> None:
        """Go to a place once it rests, at `begins` at the earliest."""
        begins = max(begins, self.ends)
        if self._legs:
            self._legs.append(Leg(self.ends, begins - self.ends, self.rest, 0.0, 0.0))
        else:
            self._legs.append(Leg(begins, 0.0, self.rest, 0.0, 0.0))
        self._legs += self._plan(begins, self.rest, 0.0, target)
        self.rest = target

    def halt(self, now: float) -> None:
        """Brake."""
        deg, speed = self._cut(now)
        self.rest = deg + speed * abs(speed) / 2 / self.accel
        self._legs = self._brake(now, deg, speed)

    def freeze(self, now: float) -> None:
        """Stand still as when the power goes."""
        self.rest = self._cut(now)[0]
        self._legs = []

    def span(self, now: float) -> tuple[float, float]:
        """Return the lowest and the highest place where it ever was."""
        here = self.at(now)
        under_way = [replace(leg, lasts=min(leg.lasts, now - leg.begins)) for leg in self._legs if leg.begins < now]
        spans = [leg.span() for leg in self._done + under_way] + [(here, here)]
        return min(low for low, _ in spans), max(high for _, high in spans)

    def _state(self, now: float) -> tuple[float, float]:
        for leg in self._legs:
            if now < leg.ends:
                return leg.at(now)
        return self.rest, 0.0

    def _cut(self, now: float) -> tuple[float, float]:
        """End all legs now; return place and speed."""
        state = self._state(now)
        for leg in self._legs:
            if leg.begins < now:
                self._done.append(replace(leg, lasts=min(leg.lasts, now - leg.begins)))
        self._legs = []
        return state

    def _brake(self, now: float, deg: float, speed: float) -> list[Leg]:
        if speed == 0.0:
            return []
        return [Leg(now, abs(speed) / self.accel, deg, speed, -math.copysign(self.accel, speed))]

    def _plan(self, now: float, deg: float, speed: float, target: float) -> list[Leg]:
        """Brake first where the way would lead past the target; then speed up, go on, brake."""
        stops_at = deg + speed * abs(speed) / 2 / self.accel
        sign = math.copysign(1.0, target - stops_at)
        if abs(target - stops_at) < 1e-9:
            return self._brake(now, deg, speed)
        if speed * sign < 0:
            legs = self._brake(now, deg, speed)
            return legs + self._plan(legs[-1].ends, stops_at, 0.0, target)
        along, way = speed * sign, (target - deg) * sign
        peak = min(math.sqrt(self.accel * way + along * along / 2), self.max_speed)
        change = math.copysign(self.accel, peak - along)
        cruise_s = (way - (peak * peak - along * along) / 2 / change - peak * peak / 2 / self.accel) / peak
        legs = []
        for lasts, accel in (
            (abs(peak - along) / self.accel, change),
            (cruise_s, 0.0),
            (peak / self.accel, -self.accel),
        ):
            if lasts > 0:
                leg = Leg(now, lasts, deg, speed, accel * sign)
                (deg, speed), now = leg.at(leg.ends), leg.ends
                legs.append(leg)
        return legs
