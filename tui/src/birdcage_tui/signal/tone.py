"""A tone for who looks at the dish and not at the screen: the terminal's bell, the faster the hotter."""

from __future__ import annotations

from birdcage_tui.shown.level_words import is_late
from birdcage_tui.shown.view import View

SLOWEST_S, FASTEST_S = 1.6, 0.16
"""Between two bells at the floor, and at the peak: a terminal joins bells that come sooner."""
WAITS_S = 0.3
"""How soon it is looked again while there is nothing to ring for."""


def bell_period_s(view: View) -> float | None:
    """Return the time from one bell to the next; None for silence: no part of a peak is known, or no longer.

    Equal steps of the share are equal ratios of time, which is what an ear tells apart.
    """
    level = view.level
    if level is None or level.share is None or is_late(view, level) or not view.link_up:
        return None
    share = min(1.0, max(0.0, level.share))
    period_s: float = SLOWEST_S * (FASTEST_S / SLOWEST_S) ** share
    return period_s
