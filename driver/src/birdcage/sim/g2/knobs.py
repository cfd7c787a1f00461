"""What can be chosen about a simulated Carryout G2 beside what every dish has (`birdcage.sim.settings`).

Each field is an option of the address: `sim:g2?second_move=queue&seed=3`. Provenance tags as there.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

from birdcage.sim.g2.motor_knobs import MotorSettings


@dataclass(frozen=True, slots=True)
class G2Settings(MotorSettings):
    """The knobs of one simulated G2. Angles in degrees, times in seconds of dish time."""

    firmware: ClassVar[str] = "g2"
    choices: ClassVar[Mapping[str, tuple[str, ...]]] = {
        **MotorSettings.choices,
        "second_move": ("retarget", "queue", "in_turn", "refuse", "block"),
        "second_other": ("together", "block"),
        "move_reply": ("angle", "none", "np"),
        "az_map": ("nearest", "home", "literal"),
        "az_print": ("wrapped", "cable"),
        "signed": ("relative", "absolute"),
        "out_of_range": ("error", "clamp"),
        "unhomed_move": ("error", "deadlock"),
        "unhomed_scan": ("deadlock", "error"),
    }

    nvs20: bool = True
    """Saved value of NVS 20, *Disable Tracker Proc?* (written; factory default FALSE): 1, so it does not move by
    itself.

    With 0 it homes and searches for a satellite after every power-on; a dish that starts without `boot` has found one.
    A fresh dish out of its box is `boot=1&nvs20=0`: it boots, homes by itself and searches. One that has booted and
    was not able to home, its search on, is `boot=1&nvs20=0&home_fails=1`, or at once `unhomed=1&nvs20=0`: an unhomed
    dish does not search (assumed), and works once a person homes it.
    """
    second_move: str = "retarget"
    """What `a` does while that axis moves: retarget, queue, refuse (an error text) or block the shell; or, in_turn,
    wait until both axes stand still, as a Trav'ler does (docs/reference/consoles.md, *Moving*). Open on a G2."""
    second_other: str = "together"
    """What `a` does while the other axis moves: both move together, or the shell blocks and answers when that axis
    stands still ("before accepting a new motor command": docs/reference/consoles.md, *Moving*). Open on a G2."""
    move_reply: str = "angle"
    """What `a <motor> <angle>` prints: `Angle = 46.00` (noted, read of the G2+), nothing, or
    `m 0  a 4600  np 111714` as a Pathway X2 does (docs/reference/g2.md, *Its kin*)."""
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
    unhomed_scan: str = "deadlock"
    """What the `scan` of the ADC menu does unhomed: hang for good (noted), or print the text of `unhomed_move`."""
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
    release_forgets: bool = True
    """Whether released motors count as not homed (assumed)."""
    release_sag: float = 3.0
    """How far the elevation sinks when the motors are released (assumed)."""
    rssi_read_s: float = 0.01
    """Time of one reading of `rssi <n>` (assumed)."""
    rssi_lead: str = "0 0"
    """The two integers that `rssi` prints before its named fields; their meaning is unknown (open)."""
    rssi_noise: float = 1.0
    """Standard deviation of one reading in counts (docs/reference/g2-signal.md, *Levels*)."""
    adc_floor: float = 235.0
    """Raw counts of the empty sky in the ADC menu (233 to 238, noted)."""
    adc_scale: float = 0.5
    """Raw counts of the ADC menu for each count of `rssi` (assumed)."""
    stream_s: float = 0.5
    """Time between two lines of a stream (assumed)."""
