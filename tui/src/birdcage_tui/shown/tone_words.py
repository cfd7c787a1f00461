"""What the tone says: a pitch, or where there is only the terminal's bell its rhythm, by the part of the peak."""

from __future__ import annotations

from birdcage_tui.shown.level_words import is_late
from birdcage_tui.shown.view import View

SLOWEST_S, FASTEST_S = 1.6, 0.16
"""Between two bells at the floor, and at the peak: a terminal joins bells that come sooner."""
LOWEST_HZ, HIGHEST_HZ = 220.0, 1760.0
"""At the floor, and at the peak: three octaves, all of which a small loudspeaker plays."""
FRESH_S, MISSED = 1.5, 3.0
"""A reading counts so long, or so many times the pause between two, if that is longer."""


def tone_share(view: View) -> float | None:
    """Return the part of the peak that is heard now, 0 to 1; None for silence: it is not known, or no longer."""
    level = view.level
    if level is None or level.share is None or is_late(view, level) or not view.link_up:
        return None
    if view.now - level.at > max(FRESH_S, MISSED / level.rate_hz if level.rate_hz else 0.0):
        return None
    return min(1.0, max(0.0, level.share))


def bell_period_s(view: View) -> float | None:
    """Return the time from one bell to the next; None for silence.

    Equal steps of the share are equal ratios of time, which is what an ear tells apart.
    """
    share = tone_share(view)
    if share is None:
        return None
    period_s: float = SLOWEST_S * (FASTEST_S / SLOWEST_S) ** share
    return period_s


def pitch_hz(view: View) -> float | None:
    """Return the pitch; None for silence. Equal steps of the share are equal intervals."""
    share = tone_share(view)
    if share is None:
        return None
    pitch: float = LOWEST_HZ * (HIGHEST_HZ / LOWEST_HZ) ** share
    return pitch
