"""Which way round an azimuth goes: decided here, for the gate and for whoever tells it beforehand."""

from __future__ import annotations

import math
from dataclasses import dataclass

from birdcage.base.geometry import shortest_turn
from birdcage.rotator.facts import Facts

LONGEST_SURE_DEG = 175.0
"""Beyond this the last reading may be too old to tell which way is the shorter one."""
CLEAR_DEG = 1.0
"""How far a sure way keeps off where the dish might turn the other way round: more than an axis overshoots."""


def borders(model: Facts) -> tuple[float, ...]:
    """Return the azimuths at which a dish may turn the other way round: north, and the stops of its cable.

    At north, for there is one that "usually crosses" it but sometimes turns round, and whose cable ends at "usually
    360 or 455" (`docs/reference/travler.md`, *Cable*); unknown of the others. Nowhere, where nothing winds up.
    """
    if model.cable is None:
        return ()
    return tuple(sorted({0.0, model.cable.min_deg % 360.0, model.cable.max_deg % 360.0}))


def goes_short(model: Facts, start_deg: float, turn_deg: float) -> bool:
    """Return whether the azimuth goes by the short way `turn_deg` from `start_deg`, however far the cable has turned.

    It does where that way meets neither a stop of the cable nor north: it is safe for every turn then.
    """
    if abs(turn_deg) > LONGEST_SURE_DEG:
        return False
    low, wide = min(start_deg, start_deg + turn_deg) - CLEAR_DEG, abs(turn_deg) + 2.0 * CLEAR_DEG
    return all((border - low) % 360.0 > wide for border in borders(model))


@dataclass(frozen=True, slots=True)
class AzimuthWay:
    """How the azimuth turns to a target; signed degrees, clockwise positive."""

    deg: float
    """The way that is expected."""
    other_deg: float | None = None
    """The way that it may take instead, the other way round; None if there is no doubt."""
    turns: tuple[float, ...] = ()
    """The turns of the cable that reach the target, the one that the dish takes first; only where its turn is known.

    Empty if that one is not allowed.
    """

    @property
    def longest_deg(self) -> float:
        """How far it may have to turn, without a sign."""
        return max(abs(self.deg), abs(self.other_deg or 0.0))


def azimuth_way(
    model: Facts, start_deg: float, az_deg: float, cable_deg: float | None, limits: tuple[float, float] | None
) -> AzimuthWay:
    """Return how the azimuth gets from `start_deg` to `az_deg`.

    `cable_deg` is the turn of the cable, None if it is not known, and `limits` how far it may turn; None where
    nothing winds up. With a known turn the nearest is taken that the dish itself allows: how the firmware chooses is
    not documented, and of a user's narrower limits it knows nothing. Without one, the other way round is ruled
    out only where no turn makes the dish take it (`docs/decisions/0027-remembered-turn.md`).
    """
    short_deg = shortest_turn(start_deg, az_deg)
    if limits is None:
        return AzimuthWay(short_deg)
    if cable_deg is not None:
        own = limits if model.cable is None else (model.cable.min_deg, model.cable.max_deg)
        nearest = cable_deg + short_deg
        fits = [turn for k in (-2, -1, 0, 1, 2) if own[0] <= (turn := nearest + 360.0 * k) <= own[1]]
        turns = tuple(sorted(fits, key=lambda turn: abs(turn - cable_deg)))
        if not turns:
            return AzimuthWay(short_deg)
        allowed = limits[0] <= turns[0] <= limits[1]
        return AzimuthWay(turns[0] - cable_deg, turns=turns if allowed else ())
    if abs(short_deg) < model.azimuth.step_deg or goes_short(model, start_deg, short_deg):
        return AzimuthWay(short_deg)
    return AzimuthWay(short_deg, short_deg - math.copysign(360.0, short_deg))


def is_safe_at_any_turn(model: Facts, start_deg: float, az_deg: float, limits: tuple[float, float]) -> bool:
    """Return whether the cable stays within its limits on the way to `az_deg`, however far it has turned."""
    cable = model.cable
    if cable is None:
        return True
    if limits[1] - limits[0] < 360.0:
        return False
    turns = [turn for k in (-2, -1, 0, 1, 2) if cable.min_deg <= (turn := start_deg + 360.0 * k) <= cable.max_deg]
    return all(azimuth_way(model, start_deg, az_deg, turn, limits).turns for turn in turns)
