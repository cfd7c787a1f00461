"""What can be chosen about a G2's motor, stepper, scan and sleep commands, where no source quotes what they do.

Each field is an option of the address, as in `birdcage.sim.g2.knobs`. Provenance tags as in `birdcage.sim.settings`.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

from birdcage.sim.g2.board_knobs import BoardSettings


@dataclass(frozen=True, slots=True)
class MotorSettings(BoardSettings):
    """The knobs of the menus MOT, STEP and ADC. Angles in degrees, times in seconds of dish time."""

    choices: ClassVar[Mapping[str, tuple[str, ...]]] = {
        **BoardSettings.choices,
        "g_reply": ("none", "angles"),
        "position_unit": ("deg", "cdeg", "steps"),
        "scan_rssi": ("adc", "tuner"),
        "azscan_rssi": ("tuner", "adc"),
        "sweep_key": ("ignore", "abort"),
        "xponder_style": ("plain", "labelled", "blank"),
        "sleep": ("none", "silent", "wake"),
    }

    g_reply: str = "none"
    """What `g` prints once it is there or was broken off: nothing, or both angles as `a` does (open)."""
    position_unit: str = "deg"
    """The unit of the second number of `sp` and `sw`: degrees, centidegrees or microsteps (open)."""
    sp_homes: bool = True
    """Whether an unhomed axis counts as homed once `sp` told it where it is (assumed)."""
    vms_blocks: bool = True
    """Whether `vms` keeps the shell busy until its time is over (open)."""
    motorboth_deg: float = 10.0
    """How far `motorboth` turns both motors, and back (assumed)."""
    pid_kp: float = 250.0
    pid_kv: float = 50.0
    pid_ki: float = 0.0
    """The gains of both axes in NVS 128 to 133. STEP> prints Kp=250 and Kv=50 (noted); their being saved, and Ki,
    are assumed."""
    els2a_most: int = 59652
    """The largest step count that `els2a` converts: times 36000 it still fits 32 bits (assumed)."""

    scan_span: float = 10.0
    """Degrees that a sweep covers when it is not told (assumed)."""
    scan_step_cdeg: int = 100
    """Centidegrees between two positions when it is not told (`Scan Delta:100`, noted)."""
    scan_read_s: float = 0.05
    """Time of one reading of a sweep (open)."""
    scan_rssi: str = "adc"
    """Whether the `RSSI:` of `scan` in ADC> counts as `rssi` of that menu does (`RSSI:<adc>`, noted) or as
    that of DVB>."""
    azscan_rssi: str = "tuner"
    """Whether the `RSSI:` of `azscan` and `azscanwxp` counts as `rssi` of DVB> does (519 to 547 in
    docs/reference/g2-motors.md, *Sweeps*) or as that of ADC>."""
    sweep_key: str = "ignore"
    """Whether a key breaks a sweep off (open): the shell reads only between commands (noted)."""
    azscan_rows: int = 2
    """How many sweeps `azscan` makes, to and fro, when it is given an elevation step (open)."""
    xponder_s: float = 0.1
    """Time to tune to the next transponder of `azscanwxp` (open)."""
    xponder_style: str = "plain"
    """How `azscanwxp` tells transponders apart: not at all (one line each, in order), by ` Xponder:<n>` at the end of
    the line, or by an empty line after each position (open)."""

    sleep: str = "none"
    """What comes after NVS 38 seconds without input: nothing; the console is silent until power-on; or the next byte
    wakes it and is lost (open)."""
