"""Counts, days, angles and shares as a person says them."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from datetime import UTC, date, datetime

WEEKDAYS = ("Monday", "Tuesday", "Wednesday", "Thursday", "Friday", "Saturday", "Sunday")
MONTHS = (
    "January", "February", "March", "April", "May", "June", "July", "August", "September", "October", "November",
    "December",
)  # fmt: skip
SHORT = {"azimuth": "AZ", "elevation": "EL"}
"""Axes as every page of birdcage calls them."""
MOST_LISTED = 4
"""So many angles are listed; of more, the least and the greatest."""


def axis_word(axis: str) -> str:
    """Return an axis as the subject of a sentence: `AZ`, `Skew`, `An axis` where it is not known which."""
    return SHORT.get(axis) or axis.capitalize() or "An axis"


def times(count: int) -> str:
    """Return how often: once, twice, 3 times."""
    return {1: "once", 2: "twice"}.get(count, f"{count:,} times")


def many(count: int, one: str, more: str = "") -> str:
    """Return a count with its noun: 1 restart, 3 restarts."""
    return f"{count:,} {one if count == 1 else more or f'{one}s'}"


def day(moment: datetime | date, now: datetime) -> str:
    """Return a UTC day: today, yesterday, a weekday of the last six days, else its date."""
    then = moment.astimezone(UTC).date() if isinstance(moment, datetime) else moment
    back = (now.astimezone(UTC).date() - then).days
    if back in (0, 1):
        return ("today", "yesterday")[back]
    if 1 < back < 7:
        return WEEKDAYS[then.weekday()]
    year = "" if then.year == now.year else f" {then.year}"
    return f"{then.day} {MONTHS[then.month - 1]}{year}"


def on(moment: datetime, now: datetime) -> str:
    """Return the day of a single event: today, on Tuesday, on 3 November."""
    word = day(moment, now)
    return word if word in ("today", "yesterday") else f"on {word}"


def clock(moment: datetime) -> str:
    """Return a time of the day: 05:40 UTC."""
    return f"{moment.astimezone(UTC):%H:%M} UTC"


def how_often(moments: Sequence[datetime], now: datetime) -> str:
    """Return how often something happened, and since when: on Tuesday, twice today, 3 times since Tuesday."""
    first, last = moments[0], moments[-1]
    if len(moments) == 1:
        return on(first, now)
    if first.astimezone(UTC).date() == last.astimezone(UTC).date():
        return f"{times(len(moments))} {on(first, now)}"
    return f"{times(len(moments))} since {day(first, now)}"


def listed(words: Sequence[str]) -> str:
    """Return words as a list in a sentence: a, b and c."""
    return words[0] if len(words) == 1 else f"{', '.join(words[:-1])} and {words[-1]}"


def at_angles(angles_deg: Iterable[float], *, turns: bool = False) -> str:
    """Return where something happened: `at 62° and 65°`, or `between 40° and 310°`; empty for no angles.

    Of an axis that `turns` all round, they begin after the widest gap: `between 350° and 10°`.
    """
    whole = sorted({round(each) % 360 if turns else round(each) for each in angles_deg})
    if not whole:
        return ""
    if turns:
        gaps = [(each - whole[number - 1]) % 360 for number, each in enumerate(whole)]
        first = gaps.index(max(gaps))
        whole = whole[first:] + whole[:first]
    if len(whole) > MOST_LISTED:
        return f"between {whole[0]}° and {whole[-1]}°"
    return f"at {listed([f'{each}°' for each in whole])}"


def share(part: int, of: int) -> str:
    """Return a share as people count it: `12 of 4,100 (1 in 340)`."""
    if not part:
        return f"none of {of:,}"
    return f"{part:,} of {of:,} (1 in {max(1, round(of / part)):,})"
