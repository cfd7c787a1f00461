"""What an expected error means for a person: a grade, a glyph and words."""

from __future__ import annotations

from typing import Literal

from birdcage.sky.ahead import AHEAD
from birdcage.sky.catalogue.words import span

Grade = Literal["fresh", "usable", "doubtful", "useless"]

GLYPHS: dict[Grade, str] = {"fresh": "●", "usable": "◐", "doubtful": "○", "useless": "✗"}
LIMITS: tuple[tuple[Grade, float, float], ...] = (("fresh", 0.3, 1.0), ("usable", 1.0, 3.0), ("doubtful", 5.0, 90.0))
"""Up to which pointing error, median and 90th percentile, in degrees. A dish of 33 inches loses 1 dB at 0.6° in the Ku
band and at 4.3° in the L band, one of 12 inches at 1.6° in the Ku band (reference section 5)."""


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


def words_of(
    age_s: float, error_deg: tuple[float, float] | None, *, measured: bool, closest: bool, longest_s: float
) -> str:
    """Return age and error in words; of what is older than `longest_s` the error is that of then."""
    age = f"{span(age_s)} old" if age_s >= 0 else f"epoch {span(-age_s)} ahead"
    if -age_s > AHEAD.total_seconds():
        return f"{age}, its date or this computer's clock is wrong"
    if error_deg is None:
        return f"{age}, falling too fast for its error to be known"
    figures = f"{degrees(error_deg[0])} off{' at closest' if closest else ''}, one in ten {degrees(error_deg[1])}"
    about = "" if measured else "about "
    if abs(age_s) > longest_s:
        return f"{age}, error not known: after {span(longest_s)} it is {about}{figures}"
    return f"{age}, {about}{figures}"
