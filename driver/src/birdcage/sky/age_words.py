"""What an expected error means for a person: a grade, a glyph and words."""

from __future__ import annotations

from typing import Literal

from birdcage.sky.ahead import AHEAD
from birdcage.sky.catalogue.words import span

Grade = Literal["fresh", "usable", "doubtful", "useless"]

GLYPHS: dict[Grade, str] = {"fresh": "●", "usable": "◐", "doubtful": "○", "useless": "✗"}
LIMITS: tuple[tuple[Grade, float, float], ...] = (("fresh", 0.3, 1.0), ("usable", 1.0, 3.0), ("doubtful", 5.0, 90.0))
"""Up to which pointing error, median and 90th percentile, in degrees. A dish of 33 inches loses 1 dB at 0.6° in the Ku
band and at 4.3° in the L band, one of 12 inches at 1.6° in the Ku band (`docs/tracking.md`, *What an error
costs*)."""

REENTERED = "re-entered?"
"""In the column of the error, where the elements themselves have the satellite down."""


def grade_of(error_deg: tuple[float, float] | None) -> Grade:
    """Return how far elements with that pointing error can be trusted: median and 90th percentile; None: not at all."""
    if error_deg is None:
        return "useless"
    return next((name for name, *most in LIMITS if error_deg[0] <= most[0] and error_deg[1] <= most[1]), "useless")


def worse(one: Grade, other: Grade) -> Grade:
    """Return the worse of two grades."""
    return max(one, other, key=list(GLYPHS).index)


def glyph_of(grade: Grade) -> str:
    """Return what stands for a grade beside its colour."""
    return GLYPHS[grade]


def degrees(angle: float | None) -> str:
    """Return an angle no finer than it is sure: `0.04°`, `2.2°`, `43°`; a dash for what is not known."""
    if angle is None:
        return "-"
    if angle < 0.01:
        return "<0.01°"
    return f"{angle:.2f}°" if angle < 1.0 else f"{angle:.1f}°" if angle < 10.0 else f"{angle:.0f}°"


def plus_minus(median_deg: float | None, p90_deg: float | None) -> str:
    """Return an error and the one that one case in ten exceeds: `±0.04° (90 %: 0.15°)`; `unknown` where it is."""
    if median_deg is None or p90_deg is None:
        return "unknown"
    return f"±{degrees(median_deg)} (90 %: {degrees(p90_deg)})".replace("±<", "<")


def age_words(age_s: float) -> str:
    """Return how old elements are: `6 h old`, `epoch 30 d ahead`."""
    return f"{span(age_s)} old" if age_s >= 0 else f"epoch {span(-age_s)} ahead"


def unknown_words(age_s: float, error_deg: tuple[float, float] | None, *, longest_s: float, down: str) -> str:
    """Return why the error is not known, as a clause; empty if it is. `down`: the re-entry in words."""
    if -age_s > AHEAD.total_seconds():
        return "its date or this computer's clock is wrong"
    if down:
        return down
    if error_deg is None:
        return "falling too fast for its error to be known"
    return f"figures end at {span(longest_s)}" if abs(age_s) > longest_s else ""


def words_of(
    age_s: float, error_deg: tuple[float, float] | None, *, measured: bool, closest: bool, longest_s: float, down: str
) -> str:
    """Return age and error in words; of what is older than `longest_s` the error is that of then."""
    why = unknown_words(age_s, error_deg, longest_s=longest_s, down=down)
    if error_deg is None or down or -age_s > AHEAD.total_seconds():
        return f"{age_words(age_s)}, {why}"
    figures = f"{'' if measured else 'about '}{plus_minus(*error_deg)}{' at closest' if closest else ''}"
    if why:
        return f"{age_words(age_s)}, error unknown: {why} with {figures}"
    return f"{age_words(age_s)}, {figures}"
