"""The Pathway X2: `m 0  a 17000  np 111714`, after a wait that is drawn anew for each command."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from birdcage.sim.firmware import FirmwareKind
from birdcage.sim.trk.kin_firmware import KinFirmware
from birdcage.sim.trk.kin_knobs import KinSettings


@dataclass(frozen=True, slots=True)
class PathwayX2Settings(KinSettings):
    """The knobs of one; see `KinSettings`."""

    firmware: ClassVar[str] = "pathway-x2"

    move_reply: str = "np"
    """What `a <motor> <angle>` prints (written)."""
    lag_max_s: float = 15.0
    """Its longest wait: "10-15 at times, but sometimes it's instant" (written)."""


KIND = FirmwareKind(PathwayX2Settings, KinFirmware)
