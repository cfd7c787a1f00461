"""What lies between the motor's count and the shaft: the play of the gear, a known error, and two hard stops."""

from __future__ import annotations

from collections.abc import Iterable

from birdcage.sim.motion import MotionProfile


class Gear:
    """Follows a count. Angles are degrees of the axis; times are seconds of dish time."""

    def __init__(self, low_deg: float, high_deg: float, backlash_deg: float, position_deg: float) -> None:
        self.low_deg, self.high_deg = low_deg, high_deg
        self.half_deg = backlash_deg / 2
        self.play_deg = position_deg
        """Where the loose end of the gear was when the present motions were ordered."""
        self.error_deg = 0.0
        """How far the shaft is from where the count would have it."""

    def shaft(self, motions: Iterable[MotionProfile], now_s: float) -> float:
        """Return where the shaft is."""
        out, error = self._follow(motions, now_s)
        return out + error

    def settle(self, motions: Iterable[MotionProfile], now_s: float) -> None:
        """Go on from here: the motions until now are forgotten."""
        self.play_deg, self.error_deg = self._follow(motions, now_s)

    def place(self, count_deg: float, shaft_deg: float) -> None:
        """Both stand still, here."""
        self.play_deg, self.error_deg = count_deg, shaft_deg - count_deg

    def strike(self, motion: MotionProfile) -> MotionProfile | None:
        """Return the motion as it ends at a stop, in the units of the count; None when it reaches neither."""
        hits = []
        for direction, stop_deg in ((1, self.high_deg), (-1, self.low_deg)):
            where = stop_deg - self.error_deg + direction * self.half_deg
            when = motion.passes(where, direction)
            if when is not None:
                hits.append((when, where, direction))
        return motion.cut(*min(hits)) if hits else None

    def _follow(self, motions: Iterable[MotionProfile], now_s: float) -> tuple[float, float]:
        """Walk along: the shaft moves once the play is taken up, and steps beyond a stop are lost."""
        out, error = self.play_deg, self.error_deg
        for motion in motions:
            turn = motion.turning_point()
            places = [] if turn is None or turn[0] > now_s else [turn[1]]
            for place in (*places, motion.at(max(now_s, motion.start_s))[0]):
                out = min(max(out, place - self.half_deg), place + self.half_deg)
                error = min(max(error, self.low_deg - out), self.high_deg - out)
            if now_s < motion.end_s:
                break
        return out, error
