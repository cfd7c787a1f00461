"""Times and spans as people say them."""

from __future__ import annotations

from datetime import UTC, datetime


def span(seconds: float) -> str:
    """Return a length of time: `45 s`, `12 min`, `2 h`, `3.5 d`. A clock that was set back makes it 0."""
    seconds = max(seconds, 0.0)
    if seconds < 90:
        return f"{seconds:.0f} s"
    if seconds < 90 * 60:
        return f"{seconds / 60:.0f} min"
    if seconds < 36 * 3600:
        return f"{seconds / 3600:.1f}".removesuffix(".0") + " h"
    if seconds < 100 * 86400:
        return f"{seconds / 86400:.1f}".removesuffix(".0") + " d"
    return f"{seconds / 86400:.0f} d"


def age(then: datetime | None, now: datetime) -> str:
    """Return how long ago something was; `in 3 h` for what is still to come, a dash for what never was."""
    if then is None:
        return "-"
    seconds = (now - then).total_seconds()
    return span(seconds) if seconds >= 0 else f"in {span(-seconds)}"


def at(moment: datetime, now: datetime) -> str:
    """Return a time of day in UTC, with the date where it is another day's."""
    moment = moment.astimezone(UTC)
    return f"{moment:%H:%M} UTC" if moment.date() == now.astimezone(UTC).date() else f"{moment:%Y-%m-%d %H:%M} UTC"
