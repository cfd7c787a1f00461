"""A curve through many points is one run of dots a column, without gaps."""

from __future__ import annotations

import math
from collections import defaultdict

import pytest
from birdcage_tui.drawing.canvas import Braille, Cells
from rich.style import Style

LEFT = ((0x01, 0x02, 0x04, 0x40), (0x08, 0x10, 0x20, 0x80))
"""Of a braille cell: the bits of its left and of its right column, from the top."""


def dots_of(width, height, points):
    """Return which dots are set, as columns and rows."""
    canvas, cells = Braille(width, height), Cells(width, height)
    canvas.trace(points, "accent")
    canvas.onto(cells, 0, 0)
    lines = [cells.strip(y, defaultdict(Style)).text for y in range(height)]
    bits = [[max(ord(char) - 0x2800, 0) for char in line] for line in lines]
    return {
        (2 * x + side, 4 * y + row)
        for y, line in enumerate(bits)
        for x, bit in enumerate(line)
        for side in (0, 1)
        for row in range(4)
        if bit & LEFT[side][row]
    }


def wave(step):
    return [(x * step, 16.0 + 14.0 * math.sin(x * step / 5.0)) for x in range(round(60 / step))]


@pytest.mark.parametrize("step", [0.1, 0.4, 1.0, 3.7])
def test_a_curve_has_no_gaps_and_no_dot_far_from_it(step):
    dots = dots_of(30, 8, wave(step))
    columns = {}
    for x, y in dots:
        columns.setdefault(x, []).append(y)
    assert sorted(columns) == list(range(max(columns) + 1))
    for x in range(max(columns)):
        here, there = columns[x], columns[x + 1]
        assert sorted(here) == list(range(min(here), max(here) + 1))
        assert min(abs(one - other) for one in here for other in there) <= 1
    curve = wave(0.05)
    reach = 1.5 + step
    assert all(min(math.hypot(x + 0.5 - a, y + 0.5 - b) for a, b in curve) < reach for x, y in dots)


def test_all_points_of_a_column_are_between_its_lowest_and_its_highest():
    assert dots_of(2, 2, [(1.0, 5.0), (1.2, 0.0), (1.4, 7.0), (1.6, 3.0)]) == {(1, y) for y in range(8)}


def test_what_is_outside_is_left_out():
    assert dots_of(2, 1, [(-3.0, 1.0), (-2.0, 1.0)]) == set()
    assert dots_of(2, 1, [(1.0, -20.0), (2.0, 20.0)]) == {(1, y) for y in range(4)} - {(1, 3), (1, 2), (1, 1)} | {
        (2, y) for y in range(1, 4)
    }
    assert dots_of(2, 1, []) == set()
