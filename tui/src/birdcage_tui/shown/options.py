"""What a frame needs of the app's settings."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol


@dataclass(frozen=True, slots=True)
class SitePlace:
    """Where the dish stands, in degrees; east and north are positive."""

    latitude_deg: float
    longitude_deg: float
    name: str = ""


class FrameOptions(Protocol):
    """The settings that show in a frame; `feeds.settings.AppOptions` holds these and all others."""

    @property
    def place(self) -> SitePlace | None:
        """Where the dish stands; None while the user has not told it: then no geostationary arc is drawn."""

    @property
    def glyphs(self) -> str:
        """What pictures are drawn with: `braille`, `block` or `ascii`."""

    @property
    def map_colours(self) -> str:
        """The colours of maps of the sky; empty for the usual ones."""

    @property
    def cell_aspect(self) -> float:
        """How much taller than wide a character is: so circles are round."""

    @property
    def notice(self) -> str:
        """A sentence about the settings that a person must see; empty for none."""
