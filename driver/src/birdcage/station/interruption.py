"""What broke into a pursuit, and whether the dish is still as it was then."""

from __future__ import annotations

from dataclasses import dataclass

from birdcage.antenna.antenna import BirdcageAntenna
from birdcage.base.geometry import shortest_turn
from birdcage.base.held import HeldReason
from birdcage.station.state import Activity, LinkPhase, StationState

AS_BEFORE_DEG = 0.5
"""How far it may stand from where its last motion led."""

SENTENCES = {
    HeldReason.LINK: "Link lost: the dish stays still.",
    HeldReason.FAULT: "The dish no longer knows where it points. It stays still.",
    HeldReason.CLOCK: "The clock stepped, or the computer slept. The dish stays still.",
}


@dataclass(frozen=True, slots=True)
class Interruption:
    """One of them."""

    reason: HeldReason
    at: float
    """Monotonic seconds."""
    stops: int
    """How often STOP had been called."""
    rest_az_deg: float | None
    """Where the dish comes to rest by itself, in its own degrees; None if that was not known."""
    rest_el_deg: float | None
    cable_deg: float | None
    """On which turn of the cable that is; None if it was not known."""
    began: tuple[float, float] | None = None
    """Where a silent slew began, in the dish's own degrees: the first byte after the gap ends it on its way. None for
    any other motion, and where the turn of the cable is counted."""

    @classmethod
    def now(
        cls, reason: HeldReason, at: float, stops: int, state: StationState, antenna: BirdcageAntenna
    ) -> Interruption:
        """Note how the dish is left."""
        motion, here, cable = antenna.motion, state.position, antenna.gate.cable_deg
        rest = None if here is None else (here.dish_az_deg, here.dish_el_deg)
        began = None
        if motion is not None:
            rest = motion.rest
            if motion.silent and cable is None:
                began = motion.azimuth.read_deg, motion.elevation.read_deg
        if rest is None:
            return cls(reason, at, stops, None, None, None)
        if cable is not None and here is not None:
            cable += shortest_turn(here.dish_az_deg, rest[0])
        return cls(reason, at, stops, *rest, cable, began)

    def is_as_before(self, state: StationState, within_s: float) -> bool:
        """Return whether the gap was short, and the dish is seen at rest where it must be."""
        here, link, rest_az, rest_el = state.position, state.link, self.rest_az_deg, self.rest_el_deg
        if self.reason is not HeldReason.LINK or link.state is not LinkPhase.UP or link.since - self.at > within_s:
            return False
        if state.fault is not None or not state.homed or state.activity is not Activity.IDLE:
            return False
        if here is None or state.position_lost is not None or here.at < self.at or rest_az is None or rest_el is None:
            return False
        began_az, began_el = (rest_az, rest_el) if self.began is None else self.began
        off_az = _beside(shortest_turn(rest_az, here.dish_az_deg), shortest_turn(rest_az, began_az))
        off_el = _beside(here.dish_el_deg - rest_el, began_el - rest_el)
        return max(off_az, off_el) <= AS_BEFORE_DEG


def _beside(deg: float, end_deg: float) -> float:
    """Return how far an angle lies outside the way from 0 to another."""
    return max(min(0.0, end_deg) - deg, deg - max(0.0, end_deg), 0.0)
