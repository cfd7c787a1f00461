"""What a map of the world is asked to show, and how that is worked out."""

from __future__ import annotations

from dataclasses import dataclass, replace
from datetime import UTC, datetime
from typing import TYPE_CHECKING

from birdcage.sky.observer import Observer
from birdcage.sky.world import WorldView

from birdcage_tui.shown.sky_picture import ShownPass

if TYPE_CHECKING:
    from birdcage.sky.look_down import Mapped


@dataclass(frozen=True, slots=True)
class Ask:
    """What the map is to show: a moment to the second, the chosen pass, and one pass of each other satellite."""

    t_s: int
    chosen: ShownPass | None
    others: tuple[ShownPass, ...]


def world_of(ask: Ask, observer: Observer | None) -> WorldView:
    """Work out what was asked for; on a thread other than the app's: it computes with arrays."""
    from birdcage.sky.look_down import world_view

    chosen = None if ask.chosen is None else _mapped(ask.chosen)
    others = [_mapped(one) for one in ask.others]
    return world_view(datetime.fromtimestamp(ask.t_s, UTC), observer, chosen, others)


def _mapped(row: ShownPass) -> Mapped:
    from birdcage.sky.look_down import Mapped

    elements = replace(row.found.elements, name=row.name)
    return Mapped(elements, row.found.time_offset_s, row.favourite)
