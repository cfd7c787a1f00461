"""What can be chosen about the motors of a simulated Carryout G2, or of one of its kin.

Each field is an option of the address: `sim:g2?second_move=queue&seed=3`. Tags are those of
`birdcage.sim.settings`.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

from birdcage.sim.settings import SimSettings


@dataclass(frozen=True, slots=True)
class TrkSettings(SimSettings):
    """How the dish moves and answers. Angles in degrees, times in seconds of dish time."""

    choices: ClassVar[Mapping[str, tuple[str, ...]]] = {
        **SimSettings.choices,
        "second_move": ("retarget", "queue", "in_turn", "refuse", "block"),
        "second_other": ("together", "block"),
        "move_reply": ("angle", "none", "np"),
        "az_map": ("nearest", "home", "literal"),
        "az_print": ("wrapped", "cable"),
        "signed": ("relative", "absolute"),
        "out_of_range": ("error", "clamp"),
        "unhomed_move": ("error", "deadlock"),
    }

    second_move: str = "retarget"
    """What `a` does while that axis moves: retarget, queue, refuse (an error text) or block the shell; or, in_turn,
    wait until both axes stand still, as a Trav'ler does (docs/reference/consoles.md, *Moving*). Open on a G2."""
    second_other: str = "together"
    """What `a` does while the other axis moves: both move together, or the shell blocks and answers when that axis
    stands still ("before accepting a new motor command": docs/reference/consoles.md, *Moving*). Open on a G2."""
    move_reply: str = "angle"
    """What `a <motor> <angle>` prints: `Angle = 46.00` (noted, read of the G2+), nothing, or
    `m 0  a 4600  np 111714` as a Pathway X2 does (docs/reference/g2.md, *Its kin*)."""
    np_per_deg: float = 111714 / 170
    """The number behind `np` for each degree (written for 170 degrees of azimuth; for others assumed)."""
    out_of_range: str = "error"
    """Whether a target beyond the limits is refused or moved to the limit (open)."""
    out_of_range_text: str = "Angle out of range."
    """What it says when it refuses one (open)."""
    busy_text: str = "Error: motor busy."
    """What it says when `second_move` is refuse (open)."""
    unhomed_angle: str = "2147483647.00"
    """How `a` prints an axis that is not homed: INT_MAX (noted), its format (assumed)."""
    unhomed_move: str = "error"
    """What `a` does to an unhomed axis: `Step to Position EL angle error: 2147483647` (noted), or a deadlock."""
    signed: str = "relative"
    """Whether `a 0 -0.5` and `a 0 +0.5` are relative moves (noted) or absolute angles (docs/reference/g2-motors.md,
    *Moving*)."""
    az_map: str = "nearest"
    """The turn of the cable for an azimuth: the nearest that fits, that of home (-360 to 0), or as given (assumed)."""
    az_print: str = "wrapped"
    """Whether `a` prints 0..360 or the cable's angle (assumed)."""
    az_outside: bool = True
    """Whether azimuths outside 0..360 are taken (open)."""
    az_speed: float = 0.0
    """Azimuth speed in deg/s instead of NVS 80; 0 for NVS."""
    el_speed: float = 0.0
    """Elevation speed in deg/s instead of NVS 85; 0 for NVS."""
