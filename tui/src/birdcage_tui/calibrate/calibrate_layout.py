"""Where each part of the Calibrate tab stands, from the room under the tabs in cells."""

from __future__ import annotations

from collections.abc import Callable

from textual.geometry import Region

ROOMY = (100, 25)
"""From this size on all lists are seen at once."""
GRAND = (150, 38)
"""From this size on both pictures are, and the signal."""
NARROW, WIDE = 43, 62
"""Columns of what is pointed at, in a small and in a grand page."""
AIM = 11
VAST = 56
"""Rows from which peaks stand in the right column too."""
LEAST_FIT, TALL_SIGNAL = 11, 14
LEAST_PICTURE = 9
"""Rows that the picture keeps, whatever the figures need."""


def regions(width: int, height: int, *, fit_rows: Callable[[int], int], picture: str, listed: str) -> dict[str, Region]:
    """Return where each part stands, frames included; what is not named is not seen.

    `fit_rows` returns how many rows the figures and their warning take in a width, frame included; 0 where there are
    none: then the words have their room. `picture` (scatter, sky) and `listed` (objects,
    peaks, sets) are what is seen where there is room for one only.
    """
    if width >= GRAND[0] and height >= GRAND[1]:
        return _grand(width, height, fit_rows(WIDE))
    if width >= ROOMY[0] and height >= ROOMY[1]:
        return _roomy(width, height, picture, fit_rows)
    left = width - NARROW
    fit = min(fit_rows(left), height - LEAST_PICTURE)
    found = {
        picture: Region(0, 0, left, height - fit),
        "aim": Region(left, 0, NARROW, AIM),
        listed: Region(left, AIM, NARROW, height - AIM),
    }
    return found | ({"fit": Region(0, height - fit, left, fit)} if fit else {})


def _roomy(width: int, height: int, picture: str, fit_rows: Callable[[int], int]) -> dict[str, Region]:
    """Picture beside object and objects; figures and the other lists below."""
    fit = 34 if width < 116 else 44
    needs = fit_rows(fit)
    if not needs:
        left = width // 2 - 6
        return {picture: Region(0, 0, left, height), **_column(left, width - left, height)}
    lower = min(max(height // 3, 9, needs), 13)
    upper = height - lower
    left = min(max(upper * 2 + 4, 44), width - 56)
    sets = 26 if width < 116 else 32
    return {
        picture: Region(0, 0, left, upper),
        "aim": Region(left, 0, width - left, AIM),
        "objects": Region(left, AIM, width - left, upper - AIM),
        "fit": Region(0, upper, fit, lower),
        "peaks": Region(fit, upper, width - fit - sets, lower),
        "sets": Region(width - sets, upper, sets, lower),
    }


def _grand(width: int, height: int, fit_rows: int) -> dict[str, Region]:
    """Both pictures, as tall as they are wide on the screen; below them figures, peaks and sets."""
    left = width - WIDE
    half = left // 2
    if not fit_rows:
        return {
            "scatter": Region(0, 0, half, height),
            "sky": Region(half, 0, left - half, height),
            **_column(left, WIDE, height, signal=8),
        }
    if height >= VAST:
        return _vast(left, half, height, max(fit_rows, LEAST_FIT))
    upper = min(height - 15, half // 2 + 2)
    lower = height - upper
    sets = max(lower // 3, 5)
    return {
        "scatter": Region(0, 0, half, upper),
        "sky": Region(half, 0, left - half, upper),
        "fit": Region(0, upper, half, lower),
        "peaks": Region(half, upper, left - half, lower - sets),
        "sets": Region(half, height - sets, left - half, sets),
        "aim": Region(left, 0, WIDE, AIM),
        "signal": Region(left, AIM, WIDE, 9),
        "objects": Region(left, AIM + 9, WIDE, height - AIM - 9),
    }


def _vast(left: int, half: int, height: int, lower: int) -> dict[str, Region]:
    """The lists in the right column, where the objects alone would leave most of it blank."""
    top, upper = AIM + TALL_SIGNAL, height - lower
    objects = (height - top) // 2
    return {
        "scatter": Region(0, 0, half, upper),
        "sky": Region(half, 0, left - half, upper),
        "fit": Region(0, upper, half, lower),
        "sets": Region(half, upper, left - half, lower),
        "aim": Region(left, 0, WIDE, AIM),
        "signal": Region(left, AIM, WIDE, TALL_SIGNAL),
        "objects": Region(left, top, WIDE, objects),
        "peaks": Region(left, top + objects, WIDE, height - top - objects),
    }


def _column(x: int, width: int, height: int, signal: int = 0) -> dict[str, Region]:
    """What is pointed at and the lists, one below the other."""
    aim, peaks, sets = AIM, 4, 5
    top = aim + signal
    found = {
        "aim": Region(x, 0, width, aim),
        "objects": Region(x, top, width, height - top - peaks - sets),
        "peaks": Region(x, height - peaks - sets, width, peaks),
        "sets": Region(x, height - sets, width, sets),
    }
    return found | ({"signal": Region(x, aim, width, signal)} if signal else {})
