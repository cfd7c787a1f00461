"""The Carryout G2+: `Angle = 46.00`, and a settings memory with the row of its TV search."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from birdcage.sim.firmware import FirmwareKind
from birdcage.sim.trk.kin_firmware import KinFirmware
from birdcage.sim.trk.kin_knobs import KinSettings


@dataclass(frozen=True, slots=True)
class G2PlusSettings(KinSettings):
    """The knobs of one."""

    firmware: ClassVar[str] = "g2plus"
    menu_words: ClassVar[tuple[str, ...]] = ("mot", "nvs")

    bare_a: str = "angles"
    """See `KinSettings`: as a G2 does (assumed)."""
    homes_at_boot: bool = False
    """See `KinSettings`: row 20 is saved as TRUE, as its owners have it (written)."""


KIND = FirmwareKind(G2PlusSettings, KinFirmware)
