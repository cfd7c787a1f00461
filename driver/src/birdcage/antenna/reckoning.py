"""Where a machine is that does not tell: as its last move should have left it, and never more than that."""

from __future__ import annotations

import math

from birdcage.antenna.gate import UNTOLD, MotionGate
from birdcage.antenna.motion import DishMotion
from birdcage.base.errors import MotionRefused, PositionUnknown
from birdcage.rotator.facts import Facts
from birdcage.rotator.values import Position


class Reckoning:
    """Of one machine that reports no position at rest (SEAMS *Rotator*, `timed`)."""

    def __init__(self) -> None:
        self._position: Position | None = None
        self.since = -math.inf
        """Since when it should stand there; monotonic seconds."""
        self.moves_until = -math.inf
        """Until when it may still be on its way."""

    def begin(self, motion: DishMotion, rate: float) -> None:
        """A move has gone out."""
        self._position, self.moves_until = None, motion.over_by(rate)

    def abandon(self, motion: DishMotion, now: float, rate: float) -> None:
        """Something may have ended the move on its way, or not."""
        self._position, self.moves_until = None, max(now, self.moves_until, motion.over_by(rate))

    def tell(self, gate: MotionGate, motion: DishMotion | None, now: float, rate: float) -> Position:
        """Tell the gate where it should be, and return that; see `at`."""
        if gate.position is None and motion is None:
            self._position = None  # whatever made it doubtful
        try:
            dish = self.at(motion, now, rate)
        except PositionUnknown as unknown:
            gate.forget(unknown.reason)
            raise
        gate.see(dish)
        return dish

    def at(self, motion: DishMotion | None, now: float, rate: float) -> Position:
        """Return where it should be. PositionUnknown (`untold`) where no move that is over by its time says so."""
        if motion is not None:
            if now < motion.eta(rate) and not motion.start_known:
                raise self._untold("its first move is not over yet")
            self._position, self.since = motion.at(now, rate), now
        if self._position is None:
            raise self._untold("it was not sent anywhere yet, or was stopped on its way")
        return self._position

    def refuse_on_its_way(self, now: float) -> None:
        """Raise MotionRefused (`moving`) while a move that was given up may last: what another does then is unknown."""
        if now < self.moves_until:
            raise MotionRefused(
                f"The dish may still be on its way for {self.moves_until - now:.0f} s, and does not tell. Nothing was "
                "sent: wait until then.",
                reason="moving",
            )

    @staticmethod
    def _untold(why: str) -> PositionUnknown:
        return PositionUnknown(f"This dish does not tell where it points, and {why}.", reason=UNTOLD)


def farthest(facts: Facts, az_deg: float, el_deg: float) -> Position:
    """Return from where the way to dish angles is the longest: what a first move is timed from."""

    def end(low_deg: float, high_deg: float, deg: float) -> float:
        return low_deg if deg - low_deg >= high_deg - deg else high_deg

    azimuth, elevation = facts.azimuth, facts.elevation
    return Position(end(azimuth.min_deg, azimuth.max_deg, az_deg), end(elevation.min_deg, elevation.max_deg, el_deg))
