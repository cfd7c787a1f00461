"""The words of Hamlib's `get_status` that are true of the dish now."""

from __future__ import annotations

from collections.abc import Iterator

from birdcage.base.geometry import shortest_turn
from birdcage.rotctld.seen_dish import known_position
from birdcage.station.state import MOVING, Activity, Pointing, StationState

AT_LIMIT_DEG = 0.1
"""So near to a limit the dish stands at it: it rests up to 0.06 deg from where it was sent, and a step on top."""
MOVING_TO_DEG = 0.1
"""An axis that has no further to go than this does not count as moving."""
BUSY_WITH = (
    Activity.HOMING, Activity.STOWING, Activity.SWEEPING, Activity.INITIALIZING, Activity.MOTOR_RUN,
)  # fmt: skip


def status_words(state: StationState, *, busy: bool) -> tuple[str, ...]:
    """Return them in Hamlib's order; `busy`: a wish of this client would not be carried out now.

    Which axis moves, and which way, is told where this program has sent the dish; for any other motion MOVING stands
    alone. A limit of the cable is told where its turn is known. OVERLAP is never said: nothing here knows of one.
    """
    words = {"BUSY"} if busy or state.activity in BUSY_WITH else set()
    here = known_position(state)
    if state.activity in MOVING:
        words |= {"MOVING", *(_moving(state, here) if here is not None else ())}
    if here is not None:
        words |= set(_limits(state, here))
    return tuple(word for word in WORDS if word in words)


WORDS = (
    "BUSY", "MOVING", "MOVING_AZ", "MOVING_LEFT", "MOVING_RIGHT", "MOVING_EL", "MOVING_UP", "MOVING_DOWN",
    "LIMIT_UP", "LIMIT_DOWN", "LIMIT_LEFT", "LIMIT_RIGHT",
)  # fmt: skip
"""Those that this server may say, in Hamlib's order."""


def _moving(state: StationState, here: Pointing) -> Iterator[str]:
    motion = state.motion
    if motion is None or motion.to_skew_deg is not None:
        return
    if abs(shortest_turn(here.az_deg, motion.to_az_deg)) > MOVING_TO_DEG:
        yield "MOVING_AZ"
        if motion.az_way_deg is not None:
            yield "MOVING_RIGHT" if motion.az_way_deg > 0 else "MOVING_LEFT"
    if abs(up_deg := motion.to_el_deg - here.el_deg) > MOVING_TO_DEG:
        yield "MOVING_EL"
        yield "MOVING_UP" if up_deg > 0 else "MOVING_DOWN"


def _limits(state: StationState, here: Pointing) -> Iterator[str]:
    if state.el_max_deg is not None and here.el_deg >= state.el_max_deg - AT_LIMIT_DEG:
        yield "LIMIT_UP"
    if state.el_min_deg is not None and here.el_deg <= state.el_min_deg + AT_LIMIT_DEG:
        yield "LIMIT_DOWN"
    if here.cable_deg is None or state.cable_min_deg is None or state.cable_max_deg is None:
        return
    if here.cable_deg <= state.cable_min_deg + AT_LIMIT_DEG:
        yield "LIMIT_LEFT"
    if here.cable_deg >= state.cable_max_deg - AT_LIMIT_DEG:
        yield "LIMIT_RIGHT"
