"""Whether a feed can hear a downlink: by its band, and by the kind of polarisation."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from fnmatch import translate
from functools import cache
from typing import TYPE_CHECKING

from birdcage.sky.downlinks import Downlink, Downlinks, called

if TYPE_CHECKING:
    from birdcage.base.config import FeedProfile
    from birdcage.sky.slots import Slot

BANDS_HZ = {"Ku": (10.7e9, 12.75e9), "L": (1.52e9, 1.71e9), "Ka": (18.3e9, 20.2e9)}
"""What slots send in, by the bands of `birdcage.sky.slots`."""
CROSSED_DB = 3.0
"""Lost between linear and circular: half the power, whichever way round."""


@dataclass(frozen=True, slots=True)
class FeedHearing:
    """That a feed hears a downlink, and what to expect of it."""

    downlink: Downlink
    whole: bool
    """Whether all of its band lies in the feed's."""
    loss_db: float | None
    """By the kinds of polarisation alone; None if one of them is not known."""

    center_hz: float
    """The middle of what of its band lies in the feed's."""

    @property
    def remark(self) -> str:
        """What is worth saying of it; empty for nothing."""
        parts = [] if self.whole else ["a part of its band"]
        if self.loss_db:
            parts.append(f"{self.loss_db:g} dB lost: {self.downlink.kind} into a feed of the other kind")
        return ", ".join(parts)


def has_band(feed: FeedProfile) -> bool:
    """Return whether a feed says what it hears at all."""
    return feed.freq_min_hz is not None and feed.freq_max_hz is not None


def hearing(downlink: Downlink, feed: FeedProfile) -> FeedHearing | None:
    """Return how a feed hears a downlink; None when it does not, or its band is not known.

    Whether anything is on the air there is another question: see `Downlink.alive`.
    """
    low_hz, high_hz = feed.freq_min_hz, feed.freq_max_hz
    if low_hz is None or high_hz is None or downlink.freq_max_hz < low_hz or downlink.freq_min_hz > high_hz:
        return None
    kinds = (downlink.kind, feed.polarization)
    loss_db = None if None in kinds else (0.0 if kinds[0] == kinds[1] else CROSSED_DB)
    heard_hz = max(low_hz, downlink.freq_min_hz), min(high_hz, downlink.freq_max_hz)
    return FeedHearing(downlink, heard_hz == (downlink.freq_min_hz, downlink.freq_max_hz), loss_db, sum(heard_hz) / 2.0)


def hearable(downlinks: Iterable[Downlink], feed: FeedProfile) -> tuple[FeedHearing, ...]:
    """Return what of it a feed can hear and that is not known to be off the air."""
    found = (hearing(each, feed) for each in downlinks if each.alive is not False)
    return tuple(each for each in found if each is not None)


def may_hear_slot(slot: Slot, feed: FeedProfile, downlinks: Downlinks) -> bool:
    """Return whether a feed may hear a place on the arc, which it does unless it is known that it cannot.

    By what is known to be sent from there; where nothing is, by what is sent in that band at all. A feed that does not
    say what it hears may hear anything.
    """
    low_hz, high_hz = BANDS_HZ[slot.band]
    sent = [each for each in downlinks.at(slot.longitude_deg) if low_hz <= each.center_hz <= high_hz]
    if has_band(feed) and sent:
        return bool(hearable(sent, feed))
    below = feed.freq_max_hz is not None and feed.freq_max_hz < low_hz
    return not below and (feed.freq_min_hz is None or feed.freq_min_hz <= high_hz)


def listener(downlinks: Iterable[Downlink], feed: FeedProfile) -> Callable[[int, str], bool]:
    """Return what tells whether a feed can hear a satellite, by number and name: quick enough for a whole catalogue.

    A satellite of which nothing is known counts as one that cannot be heard.
    """
    heard = [each.downlink for each in hearable(downlinks, feed)]
    numbers = {each.norad_id for each in heard if each.norad_id}
    of_all, of_unnumbered = _any_of(heard), _any_of(each for each in heard if not each.norad_id)

    def hears(norad_id: int, name: str) -> bool:
        if norad_id in numbers:
            return True
        pattern = of_unnumbered if norad_id else of_all
        return any(pattern.fullmatch(each) for each in called(name))

    return hears


def first_heard(table: Downlinks, feed: FeedProfile) -> Callable[[int, str], FeedHearing | None]:
    """Return what tells which downlink of a satellite is listened to with a feed, by number and name; None for none.

    It is the first of the table that the feed hears, of those known to be on the air where there is one.
    """

    @cache
    def first(norad_id: int, name: str) -> FeedHearing | None:
        heard = hearable(table.of(norad_id, name), feed)
        return min(heard, key=lambda each: each.downlink.alive is not True, default=None)

    return first


def _any_of(downlinks: Iterable[Downlink]) -> re.Pattern[str]:
    """Return one pattern for all that they are called; one that matches nothing for none."""
    patterns = sorted({pattern for each in downlinks for pattern in each.patterns})
    return re.compile("|".join(translate(each) for each in patterns) or "(?!)")
