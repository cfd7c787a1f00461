"""The frequency at which a satellite is heard, where nobody has named one."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pathlib import Path

    from birdcage.base.config import FeedProfile
    from birdcage.sky.elements import ElementSet


def usual_frequency_hz(elements: ElementSet, feed: FeedProfile, downlinks: Path) -> float | None:
    """Return the middle of what the feed hears of its first downlink, of those known to be on the air first; else None.

    `downlinks`: the user's own table, which need not be there.
    """
    from birdcage.sky.downlinks import load_downlinks
    from birdcage.sky.downlinks_hearing import hearable

    heard = hearable(load_downlinks(downlinks).of(elements.norad_id, elements.name), feed)
    first = sorted(heard, key=lambda each: each.downlink.alive is not True)  # stable: in the order of the table
    return first[0].center_hz if first else None
