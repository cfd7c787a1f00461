"""One satellite of the catalogue: its elements, and what is known and said about it."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import datetime

from birdcage.sky.elements import ElementSet


def key_of(elements: ElementSet) -> str:
    """Return what the satellite is known by: its number, or its name where it has none."""
    return str(elements.norad_id) if elements.norad_id else elements.name.casefold()


@dataclass(frozen=True, slots=True)
class CatalogueEntry:
    """A satellite as the catalogue has it."""

    elements: ElementSet
    fetched: datetime
    """When these elements came in, UTC."""
    groups: tuple[str, ...] = ()
    tags: tuple[str, ...] = ()
    favourite: bool = False
    priority: int = 0
    """Higher comes first; 0 if not set."""
    time_offset_s: float | None = None
    """How much later than its elements say the satellite comes; None if not set."""
    time_offset_set: datetime | None = None
    """When the user set that, UTC."""

    @property
    def key(self) -> str:
        """What the satellite is known by in the catalogue."""
        return key_of(self.elements)

    @property
    def name(self) -> str:
        """The satellite's name."""
        return self.elements.name

    @property
    def norad_id(self) -> int:
        """Its catalogue number; 0 for none."""
        return self.elements.norad_id
