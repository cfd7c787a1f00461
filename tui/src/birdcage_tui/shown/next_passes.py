"""Which passes come next for this dish. Pure functions; the dashboard needs them for its first frame."""

from __future__ import annotations

import heapq
from typing import TYPE_CHECKING

from birdcage.station.pursuit_state import Phase

from birdcage_tui.shown.pursuit import pursuit_of
from birdcage_tui.shown.track_words import plain_name
from birdcage_tui.shown.view import View

if TYPE_CHECKING:
    from birdcage.station.state import StationState

    from birdcage_tui.shown.sky_picture import ShownPass, SkyPicture

CROWD = 100
"""With more passes than this some piece of debris would always come first."""
MOST = 40


def passes_ahead(sky: SkyPicture | None, t_s: float) -> list[ShownPass]:
    """Return the passes whose reach begins or ends next after a time; in a crowd favourites first.

    None by elements that are too old for a dish.
    """
    if sky is None or sky.note:
        return []
    found = []
    for row in sky.rows:
        if row.age.useless:
            continue
        if row.reach.intervals and row.reach.intervals[-1].end_s > t_s:
            event = row.next_event(t_s)
            if event is not None:
                found.append((event[0], row))
    crowd = len(found) > CROWD
    return [row for _, row in heapq.nsmallest(MOST, found, key=lambda one: (crowd and not one[1].favourite, one[0]))]


def next_rows(view: View) -> list[ShownPass]:
    """Return those of a frame."""
    return passes_ahead(view.sky, view.utc.timestamp())


def is_followed(row: ShownPass, state: StationState) -> bool:
    """Return whether a pass is the one that the dish follows now."""
    pursuit = pursuit_of(state)
    passing = None if pursuit is None or pursuit.phase is not Phase.FOLLOWING else pursuit.plan.passing
    if passing is None or (passing.norad_id, plain_name(passing.name)) != (row.norad_id, row.name):
        return False
    return abs(passing.tca.timestamp() - row.tca_s) < 60.0


def next_pass(sky: SkyPicture | None, t_s: float, state: StationState) -> ShownPass | None:
    """Return the first one that the dish does not follow already; None if none is known."""
    return next((row for row in passes_ahead(sky, t_s) if not is_followed(row, state)), None)
