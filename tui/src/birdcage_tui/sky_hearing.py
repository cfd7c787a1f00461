"""What the feed in use hears of a satellite, by the tables of downlinks."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from pathlib import Path

from birdcage.base.config import FeedProfile
from birdcage.sky.downlinks import load_downlinks
from birdcage.sky.downlinks_hearing import has_band, hearable

MOST = 3
"""Downlinks that are told of one satellite."""


def hearing_of(feed: FeedProfile, user_file: Path) -> Callable[[int, str], str] | None:
    """Return what tells it in words, `137.9 MHz LRPT`, empty for nothing; None for a feed without a band."""
    if not has_band(feed):
        return None
    table = load_downlinks(user_file)

    @cache
    def hears(norad_id: int, name: str) -> str:
        found = hearable(table.of(norad_id, name), feed)
        return ", ".join(f"{each.downlink.center_hz / 1e6:g} MHz {each.downlink.mode}" for each in found[:MOST])

    return hears
