"""How the clients of the network protocol are served: what the dish's side of a server needs of the settings."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from birdcage.base.config import Settings


@dataclass(frozen=True, slots=True, kw_only=True)
class RotctldOptions:
    """By default as `[rotctld]` of `birdcage.toml` has it with nothing set."""

    read_only: bool = False
    """Whether clients may look only: nothing that they send moves the dish or sets anything."""
    strict: bool = False
    """Whether a wish that is not carried out is answered with ERJCTED, and not with success."""
    gap: Literal["hold", "error"] = "hold"
    """What clients get while the link is lost: the last position, or errors."""
    gap_s: float = 20.0
    """The longest loss of the link that is held over."""
    drive_s: float = 2.0
    """How long `M` moves the dish unless it is sent again."""
    idle_s: float = 120.0
    """After so long without a wish the dish parks, once the client that moved it has left; 0: never."""
    smoother: Literal["off", "on", "auto"] = "auto"
    """Whether the dish follows the target of a stream of wishes, and does not go from wish to wish."""
    park: tuple[float, float] | None = None
    """The named park position, true azimuth and elevation in degrees; None if none is set."""
    leapfrog: bool = False
    """Whether targets of a stream are sent beyond where they are, as `AntennaConfig.leapfrog_enabled` promises."""


def options_from(settings: Settings) -> RotctldOptions:
    """Return what `birdcage.toml` says; the park position is that of `[tracking]`."""
    own, az_deg, el_deg = settings.rotctld, settings.tracking.park_az_deg, settings.tracking.park_el_deg
    return RotctldOptions(
        read_only=own.read_only, strict=own.strict, gap=own.gap, gap_s=own.gap_s, drive_s=own.drive_s,
        idle_s=own.idle_s, smoother=own.smoother, park=None if az_deg is None or el_deg is None else (az_deg, el_deg),
    )  # fmt: skip
