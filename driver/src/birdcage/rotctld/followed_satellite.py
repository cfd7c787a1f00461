"""A satellite that a client follows, with the plan by which the dish follows it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from birdcage.base.geometry import separation, shortest_turn
from birdcage.rotctld.client_view import WishedDirection

if TYPE_CHECKING:
    from birdcage.station.pursuit_state import PursuitOptions
    from birdcage.tracking.curve import Curve
    from birdcage.tracking.plan import Plan

EARLY_S = 1.0
"""So much earlier or later than it did a client that wishes for where its satellite is may wish for it."""
AHEAD_S = 150.0
"""How far ahead a client with a threshold may wish at most."""
LOOK_S = 1.0
"""How finely the path is looked through: a satellite goes half of that beyond a point that is looked at."""
MORE_DEG = 0.3
"""By how much a client with a threshold may wish for more than that, beside what the satellite does in a second."""


@dataclass(frozen=True, slots=True)
class FollowedSatellite:
    """For any thread; nothing in it changes."""

    name: str
    norad_id: int
    plan: Plan
    options: PursuitOptions
    path: Curve
    """Where it stands, geometric: clients know of no refraction."""
    threshold_deg: float | None
    """By how far the client lets the dish lag, on either axis; None for one that wishes for where the satellite is."""
    tolerance_deg: float
    """How far beside the path a wish may lie."""
    leads_s: tuple[float, float]
    """Between which leads the client has wished."""
    steps_deg: float
    """How far off the dish was with the client's own steps: RMS on the sky."""
    is_far: bool
    """Whether the dish has to go a long way to where the plan begins, as to another turn of its cable."""

    def agrees(self, wish: WishedDirection, t_s: float) -> bool:
        """Return whether a wish at POSIX seconds `t_s` is one for this satellite."""
        if not self.path.start_s <= t_s <= self.path.end_s:
            return False
        if self.threshold_deg is None:
            begin_s, end_s = self.leads_s[0] - EARLY_S, self.leads_s[1] + EARLY_S
        else:
            az_deg, el_deg = self._at(t_s)
            gone_on = max(abs(shortest_turn(az_deg, wish.az_deg)), abs(wish.el_deg - el_deg))
            later_az, later_el = self._at(t_s + 1.0)
            rate = max(abs(shortest_turn(az_deg, later_az)), abs(later_el - el_deg))
            if gone_on > 1.1 * self.threshold_deg + MORE_DEG + rate:
                return False
            begin_s, end_s = -EARLY_S, AHEAD_S
        return self._distance(wish, t_s + begin_s, t_s + end_s) <= self.tolerance_deg

    def _distance(self, wish: WishedDirection, begin_s: float, end_s: float) -> float:
        """Return how far a wish lies from the path between two times: looked for coarsely, then finely."""
        for step_s in (LOOK_S, LOOK_S / 10.0, LOOK_S / 100.0):
            times = [begin_s + place * step_s for place in range(max(2, round((end_s - begin_s) / step_s)) + 1)]
            nearest_s = min(times, key=lambda t_s: separation(*self._at(t_s), wish.az_deg, wish.el_deg))
            begin_s, end_s = max(nearest_s - step_s, begin_s), min(nearest_s + step_s, end_s)
        return separation(*self._at(nearest_s), wish.az_deg, wish.el_deg)

    def _at(self, t_s: float) -> tuple[float, float]:
        """Return where it stands. Gpredict wishes for elevation 0 where it has set by then."""
        az_deg, el_deg = self.path.at(t_s)
        return az_deg % 360.0, max(el_deg, 0.0)
