"""How the pocket view shares out its rows: pure numbers, so that every size can be tested."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from birdcage_tui.pocket.reading import LARGE_WIDTH, digit_rows

LEAST_WIDTH, LEAST_HEIGHT = 40, 11
"""Of the page, that is without the status line: below it there are status, words and STOP alone."""
SKY_WIDTH, SKY_HEIGHT = 24, 8
"""The smallest sky worth drawing."""
TALL = 19
"""From so many rows on, buttons and STOP are three rows tall (`POCKET_TALL` in `screen_size`, less the status line)."""


@dataclass(frozen=True, slots=True)
class PocketLayout:
    """Rows of each part; 0 is not shown. `beside`: the sky stands right of a column `column` wide."""

    digits: int
    """Rows of the angles, which are part of `reading`."""
    reading: int
    signal: int
    words: int
    keys: int
    stop: int
    sky: bool
    beside: bool
    column: int


def arrange(
    width: int, height: int, *, heard: bool, wrong_in: Callable[[int], int], third_axis: bool = False
) -> PocketLayout:
    """Return the layout of a page so large, when a signal is heard or not, and with a row for a third axis or not.

    `wrong_in` returns how many rows of a width say what is wrong.
    """
    small = width < LEAST_WIDTH or height < LEAST_HEIGHT
    stop = 1 if height < TALL else 3
    keys = 0 if small else 2 if height < TALL else 4
    body = max(height - stop - keys, 0)
    if small:
        digits = digit_rows(width, body, wrong_in(width))
        return PocketLayout(digits, body, 0, 0, 0, stop, sky=False, beside=False, column=width)
    beside = width >= LEAST_WIDTH + SKY_WIDTH + 4 and body >= SKY_HEIGHT
    column = width
    if beside:
        column = max(LEAST_WIDTH, min(LARGE_WIDTH + 2, width - body * 2 - 4, width - SKY_WIDTH))
    wrong = wrong_in(column)
    # Digits, what it does or what is wrong, what STOP can do, cable.
    digits = digit_rows(column, body, wrong)
    least = digits + (wrong + 1 if wrong else 4 if third_axis else 3)
    reading = min(least, body)
    rest = body - reading
    sky = beside
    if not beside and rest >= SKY_HEIGHT + (4 if heard else 0):
        sky, rest = True, min(rest - SKY_HEIGHT, 5) if heard else 0
    if heard and rest >= (1 if wrong else 2):
        return PocketLayout(digits, reading, rest, 0, keys, stop, sky, beside, column)
    if rest >= (2 if wrong else 1):
        return PocketLayout(digits, reading, 0, rest, keys, stop, sky, beside, column)
    return PocketLayout(digits, reading + rest, 0, 0, keys, stop, sky, beside, column)
