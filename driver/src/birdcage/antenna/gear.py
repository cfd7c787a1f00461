"""A dish's own gear: the play of each axis, and how far past its target it comes to rest."""

from __future__ import annotations

AXES = ("azimuth", "elevation")
PLAY = "play_deg"
OVERSHOOT_UP = "mean_overshoot_up_deg"
"""On the mean, of moves to greater angles."""
OVERSHOOT_DOWN = "mean_overshoot_down_deg"
KINDS = {PLAY: "play", OVERSHOOT_UP: "overshoot up", OVERSHOOT_DOWN: "overshoot down"}
"""The facts of an axis that are about its gear, and their words."""
MOST_DEG = {PLAY: 0.15, OVERSHOOT_UP: 0.1, OVERSHOOT_DOWN: 0.1}
"""No more is believed, whoever says it. A play of more would lead a command out of the margin of a no-go sector."""
NAMES = {f"{axis}.{kind}": kind for axis in AXES for kind in KINDS}
"""Their flat names."""


def overshoot_name(axis: str, *, up: bool) -> str:
    """Return the flat name of the mean overshoot of an axis in one direction."""
    return f"{axis}.{OVERSHOOT_UP if up else OVERSHOOT_DOWN}"
