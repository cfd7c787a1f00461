"""Reading what a person typed, with a sentence for what can't be used."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from datetime import UTC, datetime, timedelta

from birdcage.setup.step import NoSuchChoice
from birdcage.sky.band import parse_frequency

_TIME = re.compile(r"(\d{1,2}):(\d\d)(?::(\d\d(?:\.\d+)?))?\s*z?", re.IGNORECASE)


def optional_number(values: Mapping[str, str], name: str, label: str, low: float, high: float) -> float | None:
    """Return a number, None if nothing was typed. A comma may stand for the point, `°` and `+` are allowed."""
    text = values.get(name, "").strip().rstrip("°").replace(",", ".").strip()
    if not text:
        return None
    try:
        value = float(text)
    except ValueError:
        raise NoSuchChoice(f"{label}: {values[name].strip()!r} is not a number.") from None
    if not math.isfinite(value) or not low <= value <= high:
        raise NoSuchChoice(f"{label}: {values[name].strip()} does not lie between {low:g} and {high:g}.")
    return value


def number(values: Mapping[str, str], name: str, label: str, low: float, high: float) -> float:
    """Return a number that has to be there."""
    value = optional_number(values, name, label, low, high)
    if value is None:
        raise NoSuchChoice(f"{label}: type a number between {low:g} and {high:g}.")
    return value


def frequency_hz(values: Mapping[str, str], name: str, label: str) -> float | None:
    """Return a frequency in Hz from `9750`, which is in MHz, or `9.75G`; 0 from `0`; None if nothing was typed."""
    text = values.get(name, "").strip().replace(",", ".")
    if not text:
        return None
    if text.strip("0.") == "":
        return 0.0
    try:
        return parse_frequency(text)
    except ValueError as error:
        raise NoSuchChoice(f"{label}: {error}") from None


def band_hz(values: Mapping[str, str], name: str, label: str) -> tuple[float | None, float | None]:
    """Return both ends of a band in Hz from `1670 to 1710 MHz` or `1.67-1.71 GHz`; nothing where nothing was typed.

    The unit of the upper end counts for the lower one too, where that has none.
    """
    text = values.get(name, "").strip()
    if not text:
        return None, None
    ends = re.split(r"\s+to\s+|\s*[-\u2013]\s*", text)
    if len(ends) != 2:
        raise NoSuchChoice(f"{label}: {text!r} is not a band. Type 1670 to 1710 MHz.")
    unit = re.sub(r"[-+0-9.,\s]", "", ends[1])
    low = ends[0] if re.search(r"[a-zA-Z]", ends[0]) else ends[0] + unit
    low_hz, high_hz = (frequency_hz({name: end}, name, label) for end in (low, ends[1]))
    if low_hz is None or high_hz is None or low_hz >= high_hz:
        raise NoSuchChoice(f"{label}: {text!r} does not go from a lower to a higher frequency.")
    return low_hz, high_hz


def yes(values: Mapping[str, str], name: str, label: str) -> bool:
    """Return whether `y` or `yes` was typed; nothing typed is no."""
    text = values.get(name, "").strip().lower()
    if text not in ("", "y", "yes", "n", "no"):
        raise NoSuchChoice(f"{label}: answer y or n.")
    return text in ("y", "yes")


def time_of_day(text: str, near: datetime) -> datetime:
    """Return the UTC time nearest to `near` that a watch shows as `12:03` or `12:03:20`."""
    found = _TIME.fullmatch(text.strip())
    if found is None or int(found[1]) > 23 or int(found[2]) > 59 or float(found[3] or 0) >= 60:
        raise NoSuchChoice(f"{text.strip()!r} is not a time. Type 12:03:20.")
    midnight = near.astimezone(UTC).replace(hour=0, minute=0, second=0, microsecond=0)
    told = midnight + timedelta(hours=int(found[1]), minutes=int(found[2]), seconds=float(found[3] or 0))
    return min((told + timedelta(days=days) for days in (-1, 0, 1)), key=lambda each: abs(each - near))
