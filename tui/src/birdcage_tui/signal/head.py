"""One row: which source is heard, by whom it is owned, and how often it tells."""

from __future__ import annotations

from birdcage.base.config.feeds import feed_label
from birdcage.signal.source import MONITOR
from birdcage.signal.tuner import STEADY_HZ

from birdcage_tui.drawing.canvas import Cells
from birdcage_tui.drawing.cell_text import cut
from birdcage_tui.shown.view import View
from birdcage_tui.widgets.pane import Pane

ROOMY = 110
"""Columns from which the rate that is asked for stands beside the one that is reached."""


class SignalHead(Pane):
    """Source and unit at the left; the rate that is reached at the right."""

    INK = "bar-dim"

    def draw(self, cells: Cells, view: View) -> None:
        """Write what is known of the source."""
        owner = view.state.signal_owners.get(view.heard.id, "")
        read_for = "" if owner in ("", MONITOR) else f", read for {owner.removeprefix('DEMO ')}"
        rate = "" if view.level is None or view.level.rate_hz is None else f"{view.level.rate_hz:.1f} readings a second"
        if rate and cells.width >= ROOMY:
            asked_hz = STEADY_HZ if view.heard.of_dish else view.heard.rate_hz
            rate = f"asked {asked_hz:.3g}/s, {rate}"
        by = f"dish {view.heard_by}" if view.heard.of_dish else view.heard_by
        said = f" Source: {by} ({view.heard.unit}), feed: {feed_label(view.state.feed_name)}{read_for}"
        cells.put(0, 0, cut(said, cells.width - len(rate) - 3), "bar-dim")
        cells.right(cells.width - 1, 0, rate, "bar-dim")
        if view.recorded:
            words = cut(view.recorded, cells.width - 2)
            cells.put(0, 0, f" {words}".ljust(cells.width - len(rate) - 2), "bar-warn")
