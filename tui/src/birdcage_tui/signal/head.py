"""One row: which source is heard, for what, and how often it tells; for a moment, what a key was answered."""

from __future__ import annotations

from birdcage.base.config.feeds import feed_label
from birdcage.signal.source import MONITOR
from birdcage.signal.tuner import STEADY_HZ

from birdcage_tui.drawing.canvas import Cells
from birdcage_tui.drawing.cell_text import cell_len, shorten
from birdcage_tui.shown.state_words import bad_day
from birdcage_tui.shown.view import View
from birdcage_tui.widgets.pane import Pane

ROOMY = 110
"""Columns from which the rate that is asked for stands beside the one that is reached."""
ANSWER_S = 10.0
"""So long an answer stands here, where row 2 has something else to say."""
SAME_S = 1.0
"""What is told so soon after STOP is told of it."""


class SignalHead(Pane):
    """Source and unit at the left; the rate that is reached at the right."""

    INK = "bar-dim"

    def draw(self, cells: Cells, view: View) -> None:
        """Write what is known of the source."""
        if answer := hidden_answer(view):
            cells.put(1, 0, shorten(answer, cells.width - 2), "bar")
            return
        told = [*filter(None, [view.recorded]), *_source(view)]
        forms = ((told[:count], rate) for count in range(len(told), 0, -1) for rate in _rates(view, cells.width))
        fits = (form for form in forms if _length(form[0]) + len(form[1]) + 3 <= cells.width)
        parts, rate = next(fits, (told[:1], ""))
        x = 1
        for part in parts:
            ink = "bar-warn" if part == view.recorded else "bar-dim"
            x = cells.put(x, 0, shorten(part, cells.width - 2), ink) + 2
        cells.right(cells.width - 1, 0, rate, "bar-dim")


def hidden_answer(view: View) -> str:
    """Return what a key was answered just now, where row 2 tells of something wrong; else nothing."""
    if not view.note or not view.told or bad_day(view) is None:
        return ""
    told, held = view.told[-1].utc, view.state.held
    if held is not None and held.utc is not None and (told - held.utc).total_seconds() < SAME_S:
        return ""  # row 2 tells of that STOP
    return view.note if (view.utc - told).total_seconds() <= ANSWER_S else ""


def _source(view: View) -> list[str]:
    """Return what is heard, for what, and through what: the last gives way first."""
    owner = view.state.signal_owners.get(view.heard.id, "")
    by = f"dish {view.heard_by}" if view.heard.of_dish else view.heard_by
    read_for = [] if owner in ("", MONITOR) else [f"for {owner.removeprefix('DEMO ')}"]
    return [f"Source: {by} ({view.heard.unit})", *read_for, f"Feed: {feed_label(view.state.feed_name)}"]


def _rates(view: View, width: int) -> list[str]:
    """Return how often it tells, the longest form first."""
    if view.level is None or view.level.rate_hz is None:
        return [""]
    rate = f"{view.level.rate_hz:.1f}"
    asked_hz = STEADY_HZ if view.heard.of_dish else view.heard.rate_hz
    asked = [f"asked {asked_hz:.3g}/s, {rate} readings a second"] if width >= ROOMY else []
    return [*asked, f"{rate} readings a second", f"{rate}/s"]


def _length(parts: list[str]) -> int:
    return sum(cell_len(part) + 2 for part in parts) - 2
