"""Element sets that are dated in the future: a wrong date in a file, or a clock of this computer that is behind.

Which is unknown. So nothing is thrown away: such a set gives way to any with a date that can be, and counts as
long as there is none.
"""

from __future__ import annotations

from collections.abc import Sequence
from datetime import datetime, timedelta

from birdcage.sky.elements import ElementSet

AHEAD = timedelta(days=7)
"""Providers publish sets some days ahead: before a manoeuvre, and for navigation satellites."""


def is_ahead(epoch: datetime, now: datetime) -> bool:
    """Return whether an epoch is further in the future than sets are published."""
    return epoch - now > AHEAD


def ahead_words(elements: Sequence[ElementSet], now: datetime) -> str:
    """Return a sentence about those of some elements that are dated ahead; nothing where none is."""
    found = [each for each in elements if is_ahead(each.epoch, now)]
    if not found:
        return ""
    worst = max(found, key=lambda each: each.epoch)
    who = f"{worst.name} and {len(found) - 1} more are" if len(found) > 1 else f"{worst.name} is"
    return (
        f"{who} dated {worst.epoch:%Y-%m-%d}, more than {AHEAD.days} days ahead of this computer's clock "
        f"({now:%Y-%m-%d}): set aside for any elements with an earlier date. Is the clock right? `birdcage clock`"
    )
