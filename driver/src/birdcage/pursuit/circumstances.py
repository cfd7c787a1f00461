"""What a plan is made for: the dish as it is, where it stands, when, and how it is to be used."""

from __future__ import annotations

from dataclasses import dataclass, replace
from datetime import datetime
from math import floor
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from birdcage.base.config import Settings
    from birdcage.sky.observer import Observer
    from birdcage.tracking.mount import Mount, Standing


@dataclass(frozen=True, slots=True)
class Circumstances:
    """All of that at one moment."""

    now: datetime
    observer: Observer
    mount: Mount
    settings: Settings


@dataclass(frozen=True, slots=True)
class MountKey:
    """A mount without where exactly it points: a plan holds as long as this is the same."""

    mount: Mount
    turn: int | None
    """Which turn of the cable it stands in; None if the position is not known."""


def key_of(mount: Mount) -> MountKey:
    """Return the key of a mount."""
    return MountKey(replace(mount, standing=None), _turn(mount.standing))


def _turn(standing: Standing | None) -> int | None:
    return None if standing is None else floor(standing.az_deg / 360.0)
