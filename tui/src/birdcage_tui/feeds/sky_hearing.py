"""What the feed in use hears of a satellite, by the tables of downlinks, and at which frequency to tell Doppler."""

from __future__ import annotations

from collections.abc import Callable
from datetime import datetime
from functools import cache
from pathlib import Path

from birdcage.base.config import FeedProfile
from birdcage.sky.downlinks import Downlink
from birdcage.sky.downlinks_age import is_doubtful
from birdcage.sky.downlinks_hearing import FeedHearing, first_heard, has_band, hearable
from birdcage.sky.downlinks_read import load_downlinks
from birdcage.sky.downlinks_words import air_words, satdump_words, signal_words

from birdcage_tui.shown.sky_picture import DopplerFrequency

MOST = 3
"""Downlinks that are told of one satellite."""


def hearing_of(feed: FeedProfile, user_file: Path, now: datetime) -> Callable[[int, str], str] | None:
    """Return what tells it in words, `137.9 MHz LRPT`, empty for nothing; None for a feed without a band.

    `?` stands behind what is doubtful.
    """
    if not has_band(feed):
        return None
    table = load_downlinks(user_file)

    @cache
    def hears(norad_id: int, name: str) -> str:
        found = hearable(table.of(norad_id, name), feed)
        return ", ".join(_brief(each, now) for each in found[:MOST])

    return hears


def naming_of(user_file: Path) -> Callable[[int, str], tuple[str, ...]]:
    """Return what tells what else a satellite is called: `AO-91` is `RADFXSAT (FOX-1B)` in the catalogue."""
    from birdcage.sky.targets import Resolver

    return cache(Resolver(None, load_downlinks(user_file)).other_names)


def _brief(heard: FeedHearing, now: datetime) -> str:
    doubt = " ?" if is_doubtful(heard.downlink, now) else ""
    return f"{heard.center_hz / 1e6:g} MHz {heard.downlink.mode}{doubt}"


def tuning_of(feed: FeedProfile, user_file: Path, now: datetime) -> Callable[[int, str], DopplerFrequency | None]:
    """Return what tells the frequency for Doppler: what the feed hears of a satellite, else what it sends at all.

    Else the middle of the feed's band; None for a feed without one.
    """
    table = load_downlinks(user_file)
    heard = first_heard(table, feed)

    @cache
    def tuned(norad_id: int, name: str) -> DopplerFrequency | None:
        first = heard(norad_id, name)
        if first is not None:
            sent = first.downlink
            return DopplerFrequency(first.center_hz, f"its {sent.mode}", signal_lines(sent, now))
        for one in table.of(norad_id, name):
            if one.alive is not False:
                return DopplerFrequency(one.center_hz, f"its {one.mode}", signal_lines(one, now))
        if feed.freq_min_hz is None or feed.freq_max_hz is None:
            return None
        return DopplerFrequency((feed.freq_min_hz + feed.freq_max_hz) / 2.0, "middle of feed")

    return tuned


def heard_by(feed: FeedProfile, user_file: Path) -> Callable[[int, str], FeedHearing | None]:
    """Return what tells which downlink of a satellite a feed listens to."""
    return first_heard(load_downlinks(user_file), feed)


def signal_lines(sent: Downlink, now: datetime) -> tuple[str, ...]:
    """Return `AHRPT, RHCP, 2.333 Mbaud`, `SatDump metop_ahrpt` and `on 2026-10-16`, as far as they are known."""
    pipeline = satdump_words(sent)
    return tuple(filter(None, (signal_words(sent), f"SatDump {pipeline}" if pipeline else "", air_words(sent, now))))
