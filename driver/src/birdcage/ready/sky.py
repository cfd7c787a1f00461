"""What a station needs to know of the sky: elements, clock, ephemeris."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from birdcage.ready.check import Check

if TYPE_CHECKING:
    from datetime import datetime

    from birdcage.base.paths import Paths
    from birdcage.sky.catalogue import CatalogueEntry

OLD_DAYS = 3.0
"""From this median age on, low satellites are worth an update: the station is then 2° off."""


def clock(paths: Paths, now: datetime) -> Check:
    """Whether the clock can be trusted, as `birdcage clock` says it."""
    from birdcage.gps.clock_check import check_clock
    from birdcage.gps.verdict import DOUBTFUL_S

    verdict = check_clock(now, paths.state)
    if not verdict.doubtful:
        return Check("clock", "clock", "good", verdict.sentence)
    wrong = verdict.offset_s is not None and abs(verdict.offset_s) > DOUBTFUL_S
    return Check(
        "clock", "clock", "must" if wrong else "look", verdict.doubt, "birdcage clock --gps, or --utc from a watch"
    )


def elements(paths: Paths, now: datetime) -> Iterator[Check]:
    """Whether there are elements, how old they are, and what that means for the favourites."""
    from birdcage.base.errors import StoreError
    from birdcage.sky.ahead import ahead_words
    from birdcage.sky.catalogue import Catalogue
    from birdcage.sky.catalogue.words import span

    if not paths.catalogue.exists():
        yield _none()
        return
    try:
        with Catalogue(paths.catalogue) as catalogue:
            entries, favourites = catalogue.entries(), catalogue.favourites()
    except StoreError as error:
        yield Check(
            "elements", "elements", "must", f"the catalogue can't be read: {error}", f"move {paths.catalogue} away"
        )
        return
    ages = sorted((now - each.elements.epoch).total_seconds() for each in entries if each.elements.source != "frozen")
    if not ages:
        yield _none()
        return
    middle = ages[len(ages) // 2]
    words = f"{len(ages)} satellites, half of them {span(middle)} old at most"
    if len(ages) == 1:
        words = f"one satellite, {span(middle)} old"
    old = middle > OLD_DAYS * 86400.0
    yield Check("elements", "elements", "look" if old else "good", words, "birdcage elements update" if old else "")
    ahead = ahead_words([each.elements for each in entries], now)
    if ahead:
        yield Check("elements", "epochs", "look", ahead, "birdcage elements update")
    if not favourites:
        yield Check("favourites", "favourites", "look", "none is named", "birdcage elements favourite NAME")
    for entry in favourites:
        yield _favourite(entry, now)


def _none() -> Check:
    return Check("elements", "elements", "must", "only the few old sets of birdcage", "birdcage elements update")


def _favourite(entry: CatalogueEntry, now: datetime) -> Check:
    from birdcage.sky.age import expected_error

    found = expected_error(entry.elements, now)
    offset = "" if entry.time_offset_s is None else f"; your offset {entry.time_offset_s:+g} s"
    if entry.time_offset_s is not None and entry.time_offset_set is not None:
        offset += f" is of {entry.time_offset_set:%Y-%m-%d}"
    words = f"{found.glyph} {found.grade}: {found.words}{offset}"
    if found.grade in ("fresh", "usable"):
        return Check("favourites", entry.name, "good", words)
    return Check(
        "favourites", entry.name, "must" if found.grade == "useless" else "look", words, "birdcage elements update"
    )


def ephemeris(now: datetime) -> Check:
    """Whether the excerpt that finds Sun, Moon and planets is there, and covers today."""
    from importlib.resources import files

    from birdcage.sky.ephemeris.worker import FIRST, LAST

    if not (files("birdcage.sky") / "data" / "de421_2020_2053.bsp").is_file():
        return Check(
            "ephemeris",
            "ephemeris",
            "must",
            "the excerpt of DE421 is missing from the installation",
            "install birdcage again",
        )
    if not FIRST <= now <= LAST:
        words = f"it covers {FIRST:%Y} to {LAST:%Y}, and the clock says {now:%Y-%m-%d}"
        return Check("ephemeris", "ephemeris", "must", words, "set the clock")
    return Check("ephemeris", "ephemeris", "good", f"DE421, to {LAST:%Y-%m-%d}")
