"""What the station needs to be told before it begins. Built by `station.session` from `birdcage.toml` and flags."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

from birdcage.antenna.alignment import Alignment
from birdcage.link.link import Link

OpenLink = Callable[[str, int], Link]
"""Opens a port by its name at a baud rate. LinkError says what is wrong."""


@dataclass(frozen=True, slots=True)
class StationSettings:
    """Everything that does not change while the station lives."""

    port: str
    firmware: str
    open_link: OpenLink
    find_port: Callable[[str], str | None] = lambda port: port
    """Where that port is now: the same path, or another one with the same USB identity; None while it is gone."""
    baud: int | None = None
    delay_s: float = 2.0
    alignment: Alignment = field(default_factory=Alignment)
    min_elevation_deg: float | None = None
    max_elevation_deg: float | None = None
    cable_min_deg: float | None = None
    cable_max_deg: float | None = None
    sectors: tuple[tuple[float, float, float], ...] = ()
    """No-go sectors, true: from azimuth, clockwise to azimuth, below elevation."""
    feed_name: str = ""
    beam_deg: float | None = None
    stow_allowed: bool = False
    stop_releases_motors: bool = False
    survey: bool = True
    """Read identity and limits from the dish after connecting."""
    reconnect: bool = True
    refuse_motion: str | None = None
    """Why no motion may be taken at all: settings that limit it could not be read."""
    backup_folder: Path | None = None
    """Where tables are kept before the dish's settings are written."""
