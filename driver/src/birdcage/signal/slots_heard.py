"""Which geostationary satellites a dish may hear where it points, and which of them it has found."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import TYPE_CHECKING

from birdcage.base.geometry import separation, shortest_turn
from birdcage.sky.geostationary import look_at_slot
from birdcage.sky.observer import Observer
from birdcage.sky.slots import Slot, slots

if TYPE_CHECKING:
    from birdcage.tracking.planning.refraction import Refraction

BESIDE = 3.0
"""Slots so many widths of the beam away may be heard beside another one."""
MOST_BESIDE, MOST_PATTERNS = 5, 6
MEANT_DEG = 0.05
"""A direction so near to a slot is that of the slot."""
TILT_DEG = 4.0
"""A base may be so far from level: a satellite that is found higher or lower is another one."""
ECHOSTAR = range(0x1001, 0x100C)
"""Network ids that are registered for EchoStar, which is DISH (DVB, original network ids)."""


@dataclass(frozen=True, slots=True)
class SlotSeen:
    """A slot as it stands over a place. True degrees, refraction included."""

    slot: Slot
    az_deg: float
    el_deg: float

    def off(self, other: SlotSeen) -> tuple[float, float]:
        """Return how far right of this one another stands, and above it, on the sky."""
        across = shortest_turn(self.az_deg, other.az_deg) * math.cos(math.radians(self.el_deg))
        return across, other.el_deg - self.el_deg


def seen_at(slot: Slot, observer: Observer, refraction: Refraction) -> SlotSeen | None:
    """Return where a slot is seen; None for one below the horizon."""
    from birdcage.tracking.planning.refraction import lift_deg

    look = look_at_slot(observer, slot.longitude_deg)
    if not look.visible:
        return None
    return SlotSeen(slot, look.az_deg, look.el_deg + float(lift_deg(look.el_deg, refraction)))


@lru_cache(maxsize=8)
def seen_from(observer: Observer, refraction: Refraction) -> tuple[SlotSeen, ...]:
    """Return the slots in Ku band that are above the horizon and not known to be empty."""
    wanted = (slot for slot in slots() if slot.band == "Ku" and not slot.is_empty)
    return tuple(seen for slot in wanted if (seen := seen_at(slot, observer, refraction)) is not None)


def slot_typed(typed: str, among: Iterable[SlotSeen]) -> SlotSeen | None:
    """Return the slot whose longitude was typed, as `119W` or `28.2 °E`; None for none of these."""
    wanted = typed.replace("°", "").replace(" ", "").replace(",", ".").casefold()
    return next((seen for seen in among if seen.slot.label.replace("°", "").casefold() == wanted), None)


def apart_deg(seen: SlotSeen, among: Iterable[SlotSeen]) -> float:
    """Return how far the nearest other slot is, on the sky; 180 where there is none."""
    return min(
        (separation(seen.az_deg, seen.el_deg, each.az_deg, each.el_deg) for each in among if each is not seen),
        default=180.0,
    )


def pattern_of(seen: SlotSeen, among: Iterable[SlotSeen], width_deg: float) -> tuple[float, ...]:
    """Return the slots that may be heard beside one, for `PeakTask.patterns`: the nearest ones, within three beams."""
    beside = [
        (apart, seen.off(other))
        for other in among
        if other is not seen
        and (apart := separation(seen.az_deg, seen.el_deg, other.az_deg, other.el_deg)) < BESIDE * width_deg
    ]
    return tuple(value for _apart, off in sorted(beside)[:MOST_BESIDE] for value in off)


def patterns_near(
    az_deg: float, el_deg: float, among: Sequence[SlotSeen], width_deg: float
) -> tuple[tuple[float, ...], ...]:  # fmt: skip
    """Return what may be heard beside a source in this direction, for `PeakTask.patterns`.

    A slot that stands there is the one that is meant. Else the source may be any slot within a beam's width, or none.
    """
    near = sorted((separation(az_deg, el_deg, seen.az_deg, seen.el_deg), at) for at, seen in enumerate(among))
    if near and near[0][0] <= MEANT_DEG:
        return (pattern_of(among[near[0][1]], among, width_deg),)
    rows = [pattern_of(among[at], among, width_deg) for apart, at in near[:MOST_PATTERNS] if apart <= width_deg]
    return tuple(dict.fromkeys([(), *rows]))


def patterns_within(
    az_deg: float, el_deg: float, among: Sequence[SlotSeen], reach_deg: tuple[float, float], width_deg: float
) -> tuple[tuple[float, ...], ...]:
    """Return what may be heard beside any slot that is found so far to the sides, and up and down."""
    rows = [
        pattern_of(seen, among, width_deg)
        for seen in slots_found(az_deg, el_deg, among, reach_deg[0], reach_el_deg=reach_deg[1])
    ]
    return tuple(dict.fromkeys([(), *rows[:MOST_PATTERNS]]))


def slots_found(
    az_deg: float, el_deg: float, among: Iterable[SlotSeen], reach_az_deg: float, network: str = "", *,
    reach_el_deg: float = TILT_DEG,
) -> tuple[SlotSeen, ...]:  # fmt: skip
    """Return the slots that a source in this direction may be, likeliest first.

    Azimuth says little before north is set: a slot is possible within `reach_az_deg` on the sky, and within
    `reach_el_deg` in elevation. A network id that is registered for somebody leaves out the slots of others.
    """
    operator = _operator(network)
    possible = []
    for seen in among:
        across = shortest_turn(az_deg, seen.az_deg) * math.cos(math.radians(seen.el_deg))
        up = seen.el_deg - el_deg
        if abs(across) > reach_az_deg or abs(up) > reach_el_deg or (operator and operator not in seen.slot.networks):
            continue
        far = math.hypot(across / max(reach_az_deg, MEANT_DEG), up / max(reach_el_deg, MEANT_DEG))
        possible.append((far, seen.slot.longitude_deg, seen))
    return tuple(seen for _far, _longitude, seen in sorted(possible, key=lambda each: each[:2]))


def _operator(network: str) -> str:
    """Return whose network an id is (`0x1001`); empty where that is not known."""
    try:
        return "DISH" if int(network, 16) in ECHOSTAR else ""
    except ValueError:
        return ""
