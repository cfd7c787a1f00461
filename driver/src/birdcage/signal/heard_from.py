"""In which direction a reading was taken, if that is known."""

from __future__ import annotations

from birdcage.signal.source import SignalFacts
from birdcage.station.state import MOVING, LinkPhase, StationState

HOLDS_S, HOLDS_IN_MOTION_S = 2.0, 0.3
"""So long after it was read a position still holds: of a dish at rest, and of one that moves."""


def heard_from(at: float, facts: SignalFacts, state: StationState) -> tuple[float | None, float | None]:
    """Return true azimuth and elevation at a monotonic time in seconds; Nones while they were not read then.

    Whatever is not the dish tells also while the dish does not: then its last position is of before.
    """
    position = state.position
    if position is None or position.modelled:
        return None, None
    holds_s = HOLDS_IN_MOTION_S if state.activity in MOVING else HOLDS_S
    known = state.link.state is LinkPhase.UP and state.position_lost is None and abs(at - position.told_at) <= holds_s
    return (position.az_deg, position.el_deg) if facts.of_dish or known else (None, None)
