"""A moment as a person types it: `21:30`, `+1h30`, `-20m`, `2026-11-22 04:10`, always UTC."""

from __future__ import annotations

import re
from datetime import UTC, datetime, timedelta

EXAMPLES = "21:30, +1h30, -20m or 2026-11-22 04:10 (UTC)"
_CLOCK = re.compile(r"(\d{1,2}):(\d{2})(?::(\d{2}))?z?", re.IGNORECASE)
_SHIFT = re.compile(r"([+-])\s*(?:(\d+)\s*d)?\s*(?:(\d+)\s*h)?\s*(?:(\d+)\s*(?:m(?:in)?)?)?", re.IGNORECASE)


def moment_of(text: str, shown: datetime) -> datetime:
    """Return the moment that was typed; `shown` (aware) is the one that is shown.

    A time of day is the next one from then on; a sign counts from it, in minutes where no unit is given. ValueError
    says what to type instead.
    """
    plain = text.strip()
    clock = _CLOCK.fullmatch(plain)
    if clock is not None:
        return _next(shown, int(clock[1]), int(clock[2]), int(clock[3] or 0))
    shift = _SHIFT.fullmatch(plain)
    if shift is not None and any(shift.groups()[1:]):
        days, hours, minutes = (int(part or 0) for part in shift.groups()[1:])
        if max(days * 24 + hours, minutes // 60) > 24 * 366:
            raise ValueError("This is more than a year away.")
        by = timedelta(days=days, hours=hours, minutes=minutes)
        return shown + (by if shift[1] == "+" else -by)
    try:
        whole = datetime.fromisoformat(plain)
    except ValueError:
        raise ValueError(f"Type {EXAMPLES}.") from None
    if len(plain) <= len("2026-11-22"):
        raise ValueError(f"Which time of that day? Type {plain} 04:10.")
    return whole.replace(tzinfo=UTC) if whole.tzinfo is None else whole.astimezone(UTC)


def _next(shown: datetime, hour: int, minute: int, second: int) -> datetime:
    if hour > 23 or minute > 59 or second > 59:
        raise ValueError("Type a time from 00:00 to 23:59.")
    there = shown.astimezone(UTC).replace(hour=hour, minute=minute, second=second, microsecond=0)
    return there if there >= shown else there + timedelta(days=1)
