"""The Pathway X1: what it answers no program reads, so all of that is an option."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from birdcage.sim.firmware import FirmwareKind
from birdcage.sim.trk.kin_firmware import KinFirmware
from birdcage.sim.trk.kin_knobs import KinSettings


@dataclass(frozen=True, slots=True)
class PathwayX1Settings(KinSettings):
    """The knobs of one; see `KinSettings`."""

    firmware: ClassVar[str] = "pathway-x1"


KIND = FirmwareKind(PathwayX1Settings, KinFirmware)
