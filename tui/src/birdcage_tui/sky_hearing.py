"""What the feed in use hears of a satellite, by the tables of downlinks, and at which frequency to tell Doppler."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from pathlib import Path

from birdcage.base.config import FeedProfile
from birdcage.sky.downlinks import load_downlinks
from birdcage.sky.downlinks_hearing import has_band, hearable

from birdcage_tui.passes.model import Frequency

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
        return ", ".join(f"{each.center_hz / 1e6:g} MHz {each.downlink.mode}" for each in found[:MOST])

    return hears


def naming_of(user_file: Path) -> Callable[[int, str], tuple[str, ...]]:
    """Return what tells what else a satellite is called: `AO-91` is `RADFXSAT (FOX-1B)` in the catalogue."""
    from birdcage.sky.targets import Resolver

    return cache(Resolver(None, load_downlinks(user_file)).other_names)


def tuning_of(feed: FeedProfile, user_file: Path) -> Callable[[int, str], Frequency | None]:
    """Return what tells the frequency for Doppler: what the feed hears of a satellite, else what it sends at all.

    Else the middle of the feed's band; None for a feed without one.
    """
    table = load_downlinks(user_file)

    @cache
    def tuned(norad_id: int, name: str) -> Frequency | None:
        sent = [each for each in table.of(norad_id, name) if each.alive is not False]
        for heard in hearable(sent, feed):
            return Frequency(heard.center_hz, f"its {heard.downlink.mode}")
        for one in sent:
            return Frequency(one.center_hz, f"its {one.mode}")
        if feed.freq_min_hz is None or feed.freq_max_hz is None:
            return None
        return Frequency((feed.freq_min_hz + feed.freq_max_hz) / 2.0, "middle of feed")

    return tuned
