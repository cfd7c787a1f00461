"""What can be chosen about a simulated EasyComm rotator beside what every dish has (`birdcage.sim.settings`).

Each field is an option of the address: `sim:easycomm?kind=stock&seed=3`. The words in brackets as in
`docs/reference/consoles.md`, *How facts are tagged*.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

from birdcage.sim.settings import SimSettings


@dataclass(frozen=True, slots=True)
class EasycommSettings(SimSettings):
    """The knobs of one simulated rotator. Angles in degrees, times in seconds of dish time."""

    firmware: ClassVar[str] = "easycomm"
    choices: ClassVar[Mapping[str, tuple[str, ...]]] = {
        **SimSettings.choices,
        "kind": ("rp2040", "stock"),
        "replies": ("pair", "apart"),
        "bare_az": ("zero", "answer"),
    }

    kind: str = "rp2040"
    """Which firmware it runs: that of the RP2040 base station, or the stock one of the SatNOGS controller."""
    replies: str = "pair"
    """What the RP2040 answers to `AZ` or `EL` alone: both angles on a line (written), or each its own, as the
    published one is best changed to suit every Hamlib."""
    bare_az: str = "zero"
    """What `AZ` alone does to the stock firmware: it is a set with an empty number, 0 (read in v2.2), or a question
    (noted of v2.2.1)."""
    el: float = 0.0
    """Elevation at the start: the RP2040 begins level, the stock one at its switches."""
    line_end: str = "lf"
    """What ends a line that it sends (written: LF)."""
    overshoot: float = 0.0
    """Scale of the overshoot of a stepper; nothing is known of one here."""

    duty_max: float = 0.35
    """The greatest share of the supply that the control loop of the RP2040 gives a motor (written)."""
    az_full: float = 36.0
    """Speed of the azimuth at full duty, in deg/s: 16 RPM by 40:15 (reckoned from what is written, without load)."""
    el_full: float = 69.8
    """Speed of the elevation at full duty, in deg/s: 16 RPM by 55:40 (as above)."""
    lag: float = 0.05
    """Time constant with which a motor follows its duty (assumed)."""
    stiction: float = 0.01
    """Duty below which a motor does not turn (assumed; written is that there is some)."""
    endstops: bool = True
    """Whether switches are fitted at the lower ends of both axes (written: the board has one for each)."""
    imu: bool = True
    """Whether the accelerometer is fitted (written: optional)."""
    imu_noise: float = 0.1
    """Spread of the elevation that the accelerometer tells, in degrees (assumed)."""
    el_homes: bool = True
    """Whether the RP2040 drives its elevation level by the accelerometer when it gets power (read)."""
    alert: bool = False
    """Whether a motor driver reports a fault: `GE` then counts 8."""

    speed: float = 13.33
    """Greatest speed of the stock steppers in deg/s (read: 3200 of 86400 steps each second)."""
    accel: float = 6.67
    """Their acceleration in deg/s² (read: 1600 steps/s²)."""
    settle: float = 12.0
    """How long the stock firmware waits after it found its switches, and reads nothing (read)."""
    temperature: float = 27.0
    """What `IP0` tells, in degrees Celsius."""
