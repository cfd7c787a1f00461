"""When a map begins and ends, as a person types it."""

from __future__ import annotations

from datetime import UTC, datetime, timedelta


def typed_time(text: str, after_s: float) -> float:
    """Return the next such time after a moment, in POSIX seconds: `23:00` is of UTC; 0 for an empty text.

    A date may come before it, as in ISO 8601. ValueError, with what to type, for anything else.
    """
    text = text.strip()
    if not text:
        return 0.0
    try:
        if "-" not in text and "T" not in text:
            day = datetime.fromtimestamp(after_s, UTC)
            hour, minute = (int(part) for part in text.removesuffix("Z").split(":"))
            when = day.replace(hour=hour, minute=minute, second=0, microsecond=0)
            return (when if when.timestamp() > after_s else when + timedelta(days=1)).timestamp()
        when = datetime.fromisoformat(text)
    except (ValueError, OverflowError):
        raise ValueError(f"{text!r} is not a time. Type 23:00 in UTC, or 2026-11-21T23:00Z.") from None
    return (when.replace(tzinfo=UTC) if when.tzinfo is None else when).timestamp()


def typed_times(start: str, until: str, now_s: float) -> tuple[float, float]:
    """Return start and end, 0 where none was typed. ValueError for what is no time, or for an end before the start."""
    start_s = typed_time(start, now_s)
    until_s = typed_time(until, max(start_s, now_s))
    if until_s and until_s <= max(start_s, now_s):
        raise ValueError("It would end before it begins. Type an end after the start.")
    return start_s, until_s
