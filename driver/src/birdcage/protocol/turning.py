"""Which way round an azimuth goes while the turn of its cable is not known, as far as that is certain."""

from __future__ import annotations

from birdcage.protocol.model import DishModel

LONGEST_SURE_DEG = 175.0
"""Beyond this the last reading may be too old to tell which way is the shorter one."""
CLEAR_DEG = 1.0
"""How far a sure way keeps off where the dish might turn the other way round: more than an axis overshoots."""


def borders(model: DishModel) -> tuple[float, ...]:
    """Return the azimuths at which a dish may turn the other way round: north, and the stops of its cable.

    At north, for a Trav'ler "usually crosses" it but sometimes turns round, and its cable ends at "usually 360 or 455"
    (reference section 3); nobody knows of the others. Nowhere, where nothing winds up.
    """
    if model.cable is None:
        return ()
    return tuple(sorted({0.0, model.cable.min_deg % 360.0, model.cable.max_deg % 360.0}))


def goes_short(model: DishModel, start_deg: float, turn_deg: float) -> bool:
    """Return whether the azimuth goes by the short way `turn_deg` from `start_deg`, however far the cable has turned.

    It does where that way meets neither a stop of the cable nor north: it is safe for every turn then (DESIGN
    section 5).
    """
    if abs(turn_deg) > LONGEST_SURE_DEG:
        return False
    low, wide = min(start_deg, start_deg + turn_deg) - CLEAR_DEG, abs(turn_deg) + 2.0 * CLEAR_DEG
    return all((border - low) % 360.0 > wide for border in borders(model))
