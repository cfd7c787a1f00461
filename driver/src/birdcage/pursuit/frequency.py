"""What a satellite sends that this feed hears, and which of it is meant by a frequency."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pathlib import Path

    from birdcage.base.config import FeedProfile
    from birdcage.sky.downlinks import Downlink
    from birdcage.sky.downlinks_hearing import FeedHearing
    from birdcage.sky.elements import ElementSet

NEAR_HZ = 100_000.0
"""As near as this a frequency that a person typed is that of a downlink: beyond any Doppler, below any next channel."""


def sent_by(
    elements: ElementSet, feed: FeedProfile, downlinks: Path
) -> tuple[tuple[Downlink, ...], FeedHearing | None]:
    """Return what it is not known to have ceased to send, and which of it is listened to with this feed.

    `downlinks`: the user's own table, which need not be there.
    """
    from birdcage.sky.downlinks_hearing import first_heard
    from birdcage.sky.downlinks_read import load_downlinks

    table = load_downlinks(downlinks)
    sent = tuple(each for each in table.of(elements.norad_id, elements.name) if each.alive is not False)
    return sent, first_heard(table, feed)(elements.norad_id, elements.name)


def downlink_at(sent: tuple[Downlink, ...], hertz: float) -> Downlink | None:
    """Return which of it lies at a frequency; None for none."""
    for each in sent:
        if each.freq_min_hz - NEAR_HZ <= hertz <= each.freq_max_hz + NEAR_HZ:
            return each
    return None
