"""What an acquired satellite is, and what it tells of how the dish stands."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from birdcage.base.config import FeedProfile
from birdcage.base.geometry import shortest_turn
from birdcage.rotator.feature import LOCK, NETWORK, NO_NETWORK, SNR, TRANSPONDER
from birdcage.signal.slots_heard import SlotSeen, slots_found
from birdcage.station.state import Pointing
from birdcage.station.task_state import TaskValue


@dataclass(frozen=True, slots=True)
class Acquired:
    """A source that was found (`AcquireTask.found`), with the slots that it may be, likeliest first."""

    az_deg: float
    """Its true direction, as the alignment in force has it."""
    el_deg: float
    sigma_deg: float
    heard: str
    """How it was heard, in a sentence."""
    told: Mapping[str, TaskValue]
    """What the task has found, by name."""
    may_be: tuple[SlotSeen, ...]
    position: Pointing
    """Of the dish, at rest in the middle of it."""

    def offsets(self, seen: SlotSeen, feed: FeedProfile) -> tuple[float, float]:
        """Return the offsets of the alignment, azimuth and elevation, that make it this slot."""
        dish_az_deg, dish_el_deg = dish_angles(self.position, self.az_deg, self.el_deg)
        az_deg = shortest_turn(dish_az_deg + feed.az_offset_deg, seen.az_deg)
        return round(az_deg, 2) + 0.0, round(seen.el_deg - dish_el_deg - feed.el_offset_deg, 2) + 0.0

    def off(self, seen: SlotSeen) -> tuple[float, float]:
        """Return how far from where this slot should be it was found: to the right, and above, in azimuth and el."""
        return shortest_turn(seen.az_deg, self.az_deg), self.el_deg - seen.el_deg


def dish_angles(position: Pointing, az_deg: float, el_deg: float) -> tuple[float, float]:
    """Return what a dish would read in the middle of a source, from what it reads at rest a little off it."""
    return position.dish_az_deg + shortest_turn(
        position.az_deg, az_deg
    ), position.dish_el_deg + el_deg - position.el_deg


def acquired(
    found: Mapping[str, TaskValue], position: Pointing, among: Sequence[SlotSeen], reach_az_deg: float
) -> Acquired:  # fmt: skip
    """Return what was found; `reach_az_deg` is how far the search went to the sides."""
    az_deg, el_deg, sigma_deg = (number_of(found, name) for name in ("az_deg", "el_deg", "sigma_deg"))
    network = str(found.get(NETWORK, NO_NETWORK))
    may_be = slots_found(az_deg, el_deg, among, reach_az_deg, network)
    return Acquired(az_deg, el_deg, sigma_deg, _heard_words(found), found, may_be, position)


def number_of(found: Mapping[str, TaskValue], name: str) -> float:
    """Return a number that a task has found. TypeError for what is none, from another program."""
    value = found[name]
    if isinstance(value, str | tuple):
        raise TypeError(f"{name} is {value!r}, which is no number")
    return float(value)


def _heard_words(found: Mapping[str, TaskValue]) -> str:
    decibels = found.get("unit") == "dB"
    words = [f"{number_of(found, 'rise'):.{1 if decibels else 0}f}{' dB' if decibels else ''} over the floor"]
    if LOCK in found:
        tuned = f" on transponder {number_of(found, TRANSPONDER):.0f}" if TRANSPONDER in found else ""
        words.append(f"{'locked' if found[LOCK] else 'no lock'}{tuned}")
    if SNR in found and found.get(LOCK) is not False:
        words.append(f"SNR {number_of(found, SNR):.1f} dB")
    if found.get(NETWORK, NO_NETWORK) != NO_NETWORK:
        words.append(f"network {found[NETWORK]}")
    return ", ".join(words)
