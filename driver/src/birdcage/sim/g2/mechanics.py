"""The G2's two motors, whose current can be switched off (docs/reference/g2-motors.md)."""

from __future__ import annotations

from collections.abc import Callable

from birdcage.sim.dish import DishTruth
from birdcage.sim.g2.knobs import G2Settings
from birdcage.sim.trk.mechanics import TrkDish

SAG_RATE_DEG_S = 10.0


class G2Dish(TrkDish):
    """An azimuth and an elevation motor that move at once."""

    def __init__(self, settings: G2Settings, look: Callable[[], DishTruth]) -> None:
        super().__init__(settings, look)
        self._release_sag, self._release_forgets = settings.release_sag, settings.release_forgets

    def release(self, now_s: float) -> None:
        """Cut the current of both motors: the elevation sinks, and the position may be forgotten."""
        az, el = self.axes
        az.halt(now_s)
        el.fall(now_s, self._release_sag, SAG_RATE_DEG_S)
        for axis in self.axes:
            axis.released = True
            axis.homed = axis.homed and not self._release_forgets
