"""The page's words and numbers: short, and as wide as their columns."""

from __future__ import annotations

from datetime import UTC, datetime
from typing import TYPE_CHECKING

from birdcage.sky.reach_model import LossReason

if TYPE_CHECKING:  # the dashboard needs these words for its first frame, and no passes yet
    from birdcage.sky.reach_model import PassReach

    from birdcage_tui.shown.sky_picture import ShownPass

EDGES = frozenset({LossReason.FLOOR, LossReason.HORIZON})
"""What lies between the geometric horizon and reach at both ends of a pass."""
EVENT_WORDS = {"AOS": "rises", "reach": "in reach", "out": "out of reach", "LOS": "sets"}
"""What the words of `ShownPass.events` count to, spelt out."""


def count_text(span_s: float) -> str:
    """Return a countdown in six columns or fewer: `03:20`, from an hour on `2h05`, from a day on `3d4h`."""
    minutes, seconds = divmod(int(max(span_s, 0.0)), 60)
    if minutes < 60:
        return f"{minutes:02}:{seconds:02}"
    hours, minutes = divmod(minutes, 60)
    if hours < 24:
        return f"{hours}h{minutes:02}"
    return f"{hours // 24}d{hours % 24}h"


def length_text(span_s: float) -> str:
    """Return how long something lasts in five columns or fewer: `45s`, `8m05`, `38m`, `5h12`."""
    seconds = round(span_s)
    if seconds < 60:
        return f"{seconds}s"
    if seconds < 600:
        return f"{seconds // 60}m{seconds % 60:02}"
    minutes = round(span_s / 60.0)
    return f"{minutes}m" if minutes < 60 else f"{minutes // 60}h{minutes % 60:02}"


def clock_text(t_s: float, *, seconds: bool = True) -> str:
    """Return a time of day in UTC."""
    return f"{datetime.fromtimestamp(t_s, UTC):{'%H:%M:%S' if seconds else '%H:%M'}}"


def reach_sign(reach: PassReach) -> tuple[str, str, str]:
    """Return glyph, ink and words of whether a pass can be followed: in one go, with losses, or not; and why not.

    Every pass begins and ends below the floor or behind the horizon: that is no loss worth a word.
    """
    if not reach.intervals:
        return "○", "dim", ", ".join(reach.words(costliest_first=True))
    losses = reach.words(but=EDGES, costliest_first=True)
    if not losses and len(reach.intervals) > 1:
        losses = reach.words(costliest_first=True)
    return ("◍", "good", ", ".join(losses)) if losses else ("●", "good", "")


def reasons_text(reasons: str, width: int) -> str:
    """Return reasons in so many columns, none of them cut: `ceiling, cable`, else `ceiling +1`, else nothing."""
    first, _, rest = reasons.partition(", ")
    shorter = f"{first} +{rest.count(', ') + 1}" if rest else first
    return next((words for words in (reasons, shorter) if len(words) <= width), "")


def reach_text(row: ShownPass) -> str:
    """Return how long a pass is in reach in six columns.

    What is always up has no duration, and one that lasts beyond the search is told as more than that.
    """
    if not row.reach.intervals:
        return "none"
    if row.stays:
        return "parts" if row.reach.lost else "always"
    cut = row.still_up and row.los_s - row.reach.intervals[-1].end_s <= 1.0
    return f">{row.reach.total_s / 3600.0:.0f}h" if cut and row.reach.total_s >= 3600.0 else length_text(row.reach_s)


def standing_text(row: ShownPass) -> str:
    """Return what to say of a row for which nothing was found to come next."""
    return "always up" if row.stays else "stays up"


def shift_text(shift_s: float) -> str:
    """Return how far a view time is from now: `1 h 12 min ahead`, `40 s back`."""
    seconds = abs(round(shift_s))
    if seconds < 60:
        span = f"{seconds} s"
    elif seconds < 3600:
        span = f"{seconds // 60} min {seconds % 60:02} s" if seconds < 600 else f"{seconds // 60} min"
    else:
        span = f"{seconds // 3600} h {seconds % 3600 // 60:02} min"
    return f"{span} {'ahead' if shift_s >= 0 else 'back'}"
