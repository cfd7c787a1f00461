"""The next passes that this dish can follow, a row each."""

from __future__ import annotations

from typing import TYPE_CHECKING

from birdcage_tui.drawing.canvas import Cells
from birdcage_tui.drawing.cell_text import fit
from birdcage_tui.shown.pass_words import count_text, length_text
from birdcage_tui.shown.view import View

if TYPE_CHECKING:
    from birdcage_tui.shown.sky_picture import ShownPass
    from birdcage_tui.widgets.spark import Sparks

EVENTS = {"reach": "reach in", "out": "leaves in", "AOS": "rises in", "LOS": "sets in"}
"""What comes next, before the time until it does."""
WITH_REACH, WITH_WORDS = 40, 46
"""Columns from which a row tells how long it is in reach; from which it says that this is what it tells."""
LEAST_NAME = 14
"""Columns of the name that count for more than the words behind the figures."""
HEADING = "In reach now and next"
CURVE, WITH_CURVE = 12, 32
"""Columns of the curve of elevation, and how many the name has where it is drawn, curve included."""
WITH_AZIMUTHS = 76
"""Columns from which a row tells where the satellite rises and sets."""


def troubled(view: View) -> bool:
    """Return whether something is wrong with the dish: its sentences come before any pass then."""
    state = view.state
    return not view.link_up or state.held is not None or state.fault is not None or state.homed is not True


def draw_next(
    cells: Cells, y: int, row: ShownPass, now_s: float, ink: str = "", sparks: Sparks | None = None, *,
    headed: bool = False,
) -> None:  # fmt: skip
    """Write what comes next and when, the name, the highest elevation and how long all of it is in reach.

    Without headings only the countdown tells how long of a pass that is in reach now. `ink`: all in one. `sparks` draws
    the elevation from AOS to LOS where there is room, louder where the dish can follow.
    """
    event = row.next_event(now_s)
    if event is None:
        return
    inside = row.reach.holds(now_s)
    dim, text = ink or "dim", ink or ("strong" if inside else "text")
    cells.put(1, y, EVENTS.get(event[1], event[1]), dim)
    cells.right(16, y, count_text(event[0] - now_s), text)
    length = "" if inside and not headed else length_text(row.reach_s)
    tail = f"{row.max_el_deg:2.0f}°"
    if cells.width >= WITH_REACH:
        tail = f"{tail} {length:>4}"
    if cells.width >= WITH_WORDS:
        tail = f"max {tail}" + (" in reach" if length else " " * len(" in reach"))
    if cells.width >= WITH_AZIMUTHS:
        tail = f"{row.aos_az_deg:3.0f}° to {row.los_az_deg:3.0f}°   {tail}"
    room = cells.width - 17 - len(tail) - 2
    if room < LEAST_NAME:
        tail = tail.removesuffix(" in reach" if length else " " * len(" in reach"))
        room = cells.width - 17 - len(tail) - 2
    if sparks is not None and room >= WITH_CURVE:
        room -= CURVE + 2
        sparks.draw(cells, 17 + room + 1, y, CURVE, row, "dim", "accent")
    cells.put(17, y, fit(row.name, room), text)
    cells.right(cells.width - 1, y, tail, dim)
