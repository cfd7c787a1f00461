"""What a person may type about the skew into the go-to line: `skew 45`, `sk=45`, `skew +5`. Pure."""

from __future__ import annotations

import re

from birdcage_tui.shown.view import View
from birdcage_tui.widgets.skew import has_skew, skew_deg, skew_limits

_BEGINS = re.compile(r"\s*(?:skew|sk)\b", re.IGNORECASE)
_WHOLE = re.compile(r"\s*(?:skew|sk)\s*[=:]?\s*([+\-]?(?:\d+(?:[.,]\d*)?|[.,]\d+))\s*°?\s*", re.IGNORECASE)


def is_skew(text: str) -> bool:
    """Return whether `text` is about the skew, and not about a direction."""
    return _BEGINS.match(text) is not None


def skew_of(text: str, view: View) -> float:
    """Return the angle that `text` leads to; with a sign it counts from where the skew was sent last.

    ValueError says what to type instead, or why the skew cannot be turned there.
    """
    dish = view.state.dish
    if dish is not None and not has_skew(view):
        raise ValueError(f"The {dish.name} has no skew axis.")
    found = _WHOLE.fullmatch(text.replace("−", "-"))
    if dish is None or found is None:
        raise ValueError("Type the skew: skew 45, or skew +5 from the last target.")
    number = found.group(1).replace(",", ".")
    angle_deg = float(number)
    if number[0] in "+-":
        sent = view.state.target_skew_deg
        start = skew_deg(view) if sent is None else sent
        if start is None:
            raise ValueError("The skew is unknown. Type an angle without a sign.")
        angle_deg += start
    low, high = skew_limits(view)
    if not low <= angle_deg <= high:
        raise ValueError(f"Skew {angle_deg:.2f}° is out of range. Type {low:.0f} to {high:.0f}.")
    return angle_deg


def skew_way(text: str, view: View) -> str:
    """Return what Enter would do, in one line. ValueError as of `skew_of`."""
    angle_deg, here = skew_of(text, view), skew_deg(view)
    words = f"skew {angle_deg:.2f}°"
    dish = view.state.dish
    if here is None or dish is None or dish.skew is None:
        return words
    way = angle_deg - here
    takes = "" if dish.skew.times is None else f", {dish.skew.times.seconds(way):.1f} s"
    return f"{words}   {way:+.2f}° from {here:.2f}°{takes}; azimuth and elevation stay"
