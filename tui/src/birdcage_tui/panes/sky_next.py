"""The next passes that this dish can follow, a row each."""

from __future__ import annotations

import heapq
from typing import TYPE_CHECKING

from birdcage_tui.canvas import Cells
from birdcage_tui.cell_text import fit
from birdcage_tui.passes.words import count_text, length_text
from birdcage_tui.view import View

if TYPE_CHECKING:
    from birdcage_tui.passes.model import Row

MOST = 40
WITH_WORDS = 46
"""Columns from which a row says what the time is that it ends with."""
WITH_AZIMUTHS = 76
"""Columns from which a row tells where the satellite rises and sets."""


def troubled(view: View) -> bool:
    """Return whether something is wrong with the dish: its sentences come before any pass then."""
    state = view.state
    return not view.link_up or state.held is not None or state.fault is not None or state.homed is not True


def next_rows(view: View) -> list[Row]:
    """Return the passes whose reach begins or ends next; none by elements that are too old for a dish."""
    if view.sky is None or view.sky.note:
        return []
    now_s = view.utc.timestamp()
    found = []
    for row in view.sky.rows:
        if row.age is not None and row.age.useless:
            continue
        if row.reach is not None and row.reach.intervals and row.reach.intervals[-1][1] > now_s:
            event = row.next_event(now_s)
            if event is not None:
                found.append((event[0], row))
    return [row for _, row in heapq.nsmallest(MOST, found, key=lambda pair: pair[0])]


def draw_next(cells: Cells, y: int, row: Row, now_s: float, ink: str = "") -> None:
    """Write what comes next and when, the name, the highest elevation and the minutes in reach; `ink`: all in one."""
    event = row.next_event(now_s)
    if event is None:
        return
    inside = row.reach is not None and row.reach.holds(now_s)
    dim, text = ink or "dim", ink or ("strong" if inside else "text")
    cells.put(1, y, f"{event[1]:<5}", dim)
    cells.right(13, y, count_text(event[0] - now_s), text)
    length = length_text(row.reach_s)
    tail = f"{row.max_el_deg:3.0f}°  {length:>4}" + (" in reach" if cells.width >= WITH_WORDS else "")
    if cells.width >= WITH_AZIMUTHS:
        tail = f"{row.aos_az_deg:3.0f}° to {row.los_az_deg:3.0f}°   max {tail}"
    room = cells.width - 15 - len(tail) - 2
    cells.put(15, y, fit(row.name, room), text)
    cells.right(cells.width - 1, y, tail, dim)
