"""What can be chosen about a simulated rotctld beside what every dish has (`birdcage.sim.settings`).

Servers differ: these are the ways in which `docs/reference/rotctl.md` has them. Each field is an option of the address:
`sim:rotctl?dump_state=silent&stop=silent`.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

from birdcage.sim.settings import SimSettings


@dataclass(frozen=True, slots=True)
class RotctlSettings(SimSettings):
    """The knobs of one simulated server and its rotator. Angles in degrees, times in seconds of dish time."""

    firmware: ClassVar[str] = "rotctl"
    choices: ClassVar[Mapping[str, tuple[str, ...]]] = {
        **SimSettings.choices,
        "dump_state": ("tags", "bare", "error", "silent"),
        "stop": ("reply", "mute", "ignore", "error"),
    }

    az: float = 0.0
    """Azimuth at the start, within its range."""
    el: float = 0.0
    """Elevation at the start."""
    min_az: float = -180.0
    max_az: float = 450.0
    min_el: float = 0.0
    max_el: float = 90.0
    """Where both axes end, and what the server tells of that (measured of Hamlib's dummy)."""
    speed: float = 6.0
    """Of both axes at speed level 100, in deg/s (measured of Hamlib's dummy)."""
    accel: float = 12.0
    """Of both axes in deg/s² (assumed)."""
    overshoot: float = 0.0
    """Scale of the overshoot; nothing is known of one here."""
    park_az: float = 0.0
    park_el: float = 0.0
    """Where `K` sends it."""

    dump_state: str = "tags"
    """Whether it knows `dump_state`: as Hamlib has it, in the old form of bare numbers, not at all and says so, or not
    at all and silent, as the Discovery Drive."""
    stop: str = "reply"
    """What `S` does: stops and is answered, stops and is not (written of bridges by saveitforparts), is unknown, or is
    answered by an error."""
    knows: str = ""
    """The commands that it knows, as letters: `pP` of a Discovery Drive; empty for all."""
    code_space: bool = False
    """Whether a blank stands behind `RPRT 0` (written of bridges by saveitforparts)."""
    split: bool = False
    """Whether the lines of a position come in a segment each."""
    decimals: int = 2
    """Of the angles that it prints."""
    range_code: int = -1
    """The code of an angle beyond its range: -1 up to Hamlib 4.5, -21 from 4.6 on."""
    lost: bool = False
    """Whether the server has lost its rotator: then whatever needs that is answered `RPRT -6`."""
    flags_twice: bool = False
    """Whether the status flags are printed twice, as Hamlib 4.5 does."""
    model: int = 1
    rot_type: str = "AzEl"
    info: str = "Dummy rotator"
    """What it tells of its rotator."""
