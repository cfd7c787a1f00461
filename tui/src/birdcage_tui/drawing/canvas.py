"""Two surfaces to draw on: cells that hold text, and braille dots (2 across, 4 down in a cell) laid over them."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from functools import lru_cache
from itertools import groupby, pairwise

from rich.segment import Segment
from rich.style import Style
from textual.strip import Strip

from birdcage_tui.drawing.cell_text import cell_len, pieces

_RANK = {ink: rank for rank, ink in enumerate(("", "faint", "line", "dim"))}
"""Quiet inks, quietest first; every other is louder."""
_BRAILLE = tuple(chr(0x2800 + dots) for dots in range(256))
_DOT = ((0x01, 0x08), (0x02, 0x10), (0x04, 0x20), (0x40, 0x80))


@lru_cache(maxsize=4096)
def _has_odd_widths(text: str) -> bool:
    return any(width != 1 or len(piece) != 1 for piece, width in pieces(text))


class Cells:
    """A rectangle of characters, each with the name of its ink; right of a wide one stands an empty text."""

    def __init__(self, width: int, height: int, ink: str = "text", glyphs: str = "braille") -> None:
        self.width, self.height = max(width, 0), max(height, 0)
        self.glyphs = glyphs
        """The set that the finished row is put into (`glyphs`): for shapes that have one of their own in it."""
        self._chars = [[" "] * self.width for _ in range(self.height)]
        self._inks = [[ink] * self.width for _ in range(self.height)]
        self._wide_rows: set[int] = set()
        self._shut: set[tuple[int, int]] = set()

    def put(self, x: int, y: int, text: str, ink: str = "text") -> int:
        """Write `text`, clipped at the edges. Return the column after it."""
        if not text.isascii() and _has_odd_widths(text):
            for piece, width in pieces(text):
                x = self._put_piece(x, y, piece, width, ink)
            return x
        first, end = max(x, 0), min(x + len(text), self.width)
        if 0 <= y < self.height and first < end:
            if y in self._wide_rows:
                for column in range(first, end):
                    self._part(column, y)
            self._chars[y][first:end] = text[first - x : end - x]
            self._inks[y][first:end] = [ink] * (end - first)
        return x + len(text)

    def run_of(self, ink: str, x: int, y: int) -> int:
        """Return how many cells from this one on have that ink."""
        row = self._inks[y][x:] if 0 <= y < self.height and x >= 0 else []
        return next((count for count, each in enumerate(row) if each != ink), len(row))

    def _put_piece(self, x: int, y: int, piece: str, width: int, ink: str) -> int:
        """Write one sign, a space for each of its cells where it lies across an edge."""
        whole = x >= 0 and x + width <= self.width
        for column, char in enumerate((piece, "")[:width] if whole else (" ",) * width, x):
            if 0 <= y < self.height and 0 <= column < self.width:
                self._part(column, y)
                self._chars[y][column], self._inks[y][column] = char, ink
                self._wide_rows.add(y)
        return x + width

    def _part(self, x: int, y: int) -> None:
        """Leave a space where half of a wide sign would be left, once its other half at this cell is another."""
        chars = self._chars[y]
        if chars[x] == "" and x:
            chars[x - 1] = " "
        if x + 1 < self.width and chars[x + 1] == "":
            chars[x + 1] = " "

    def put_dots(self, x: int, y: int, bits: Sequence[int], inks: Sequence[str]) -> None:
        """Write a row of braille, clipped at the sides; where there is no dot, what stands there is left alone."""
        chars, names = self._chars[y], self._inks[y]
        for column, (dots, ink) in enumerate(zip(bits, inks, strict=True), x):
            if dots and 0 <= column < self.width:
                if y in self._wide_rows:
                    self._part(column, y)
                chars[column], names[column] = _BRAILLE[dots], ink

    def right(self, x: int, y: int, text: str, ink: str = "text") -> None:
        """Write `text` to end before column `x`."""
        self.put(x - cell_len(text), y, text, ink)

    def free(self, x: int, y: int, length: int, *over: str) -> bool:
        """Return whether nothing stands there yet; braille in the inks `over` counts as nothing."""
        if not (0 <= y < self.height and x >= 0 and x + length <= self.width):
            return False
        if self._shut and not self._shut.isdisjoint((column, y) for column in range(x, x + length)):
            return False
        return all(
            char == " " or (ink in over and "\u2800" <= char <= "\u28ff")
            for char, ink in zip(self._chars[y][x : x + length], self._inks[y][x : x + length], strict=True)
        )

    def shut(self, x: int, y: int, length: int) -> None:
        """Keep what asks for free cells off these, the gaps between words too."""
        self._shut.update((column, y) for column in range(x, x + length))

    def put_row(self, x: int, y: int, chars: Sequence[str], inks: Sequence[str]) -> None:
        """Write signs of one cell each, every one in its own ink; all of it must lie inside."""
        self._chars[y][x : x + len(chars)] = chars
        self._inks[y][x : x + len(inks)] = inks

    def rows_unlike(self, before: Cells) -> list[int]:
        """Return the rows that hold something else than those of `before`, which is as wide."""
        return [
            y
            for y, (chars, names) in enumerate(zip(self._chars, self._inks, strict=True))
            if y >= before.height or chars != before._chars[y] or names != before._inks[y]
        ]

    def strip(self, y: int, inks: Mapping[str, Style]) -> Strip:
        """Return one row; neighbours in the same ink become one segment."""
        chars, names = self._chars[y], self._inks[y]
        segments, start = [], 0
        for name, group in groupby(names):
            end = start + len(list(group))
            segments.append(Segment("".join(chars[start:end]), inks[name]))
            start = end
        return Strip(segments, self.width)


class Braille:
    """Dots in ink, of which a cell has one: a louder ink clears quieter dots. `copy` keeps a static layer for reuse."""

    def __init__(self, width: int, height: int) -> None:
        self.width, self.height = max(width, 0), max(height, 0)
        self._bits = bytearray(self.width * self.height)
        self._inks: list[str] = [""] * (self.width * self.height)

    def copy(self) -> Braille:
        """Return an equal canvas that may be drawn on."""
        twin = Braille(0, 0)
        twin.width, twin.height = self.width, self.height
        twin._bits, twin._inks = bytearray(self._bits), list(self._inks)
        return twin

    def dot(self, x: float, y: float, ink: str) -> None:
        """Set the dot at column `x` (0 to 2 width) and row `y` (0 to 4 height); nothing happens outside."""
        column, row = math.floor(x), math.floor(y)
        if 0 <= column < self.width * 2 and 0 <= row < self.height * 4:
            index = (row >> 2) * self.width + (column >> 1)
            before = _RANK.get(self._inks[index], len(_RANK))
            rank = _RANK.get(ink, len(_RANK))
            if rank < before:
                return
            if rank > before:
                self._bits[index] = 0
            self._bits[index] |= _DOT[row & 3][column & 1]
            self._inks[index] = ink

    def line(self, x0: float, y0: float, x1: float, y1: float, ink: str, every: int = 1) -> None:
        """Draw a straight line, one dot in `every`."""
        steps = max(1, round(max(abs(x1 - x0), abs(y1 - y0))))
        across, up, floor, inks = x1 - x0, y1 - y0, math.floor, self._inks
        for step in range(0, steps + 1, every):
            x, y = x0 + across * step / steps, y0 + up * step / steps
            column, row = floor(x), floor(y)
            if 0 <= column < self.width * 2 and 0 <= row < self.height * 4:
                index = (row >> 2) * self.width + (column >> 1)
                if inks[index] == ink:  # most dots of a curve: nothing to weigh
                    self._bits[index] |= _DOT[row & 3][column & 1]
                else:
                    self.dot(x, y, ink)

    def trace(self, points: Sequence[tuple[float, float]], ink: str) -> None:
        """Draw a curve through points from left to right: one run of dots a column, however many points that has.

        A column's run goes half the way to the next column's, so that steep curves have no gaps.
        """
        floor = math.floor
        column, low, high, last = -(1 << 30), 0, -1, 0
        for x, y in points:
            at, row = floor(x), floor(y)
            if at == column:
                low, high = min(low, row), max(high, row)
            elif at == column + 1 and high >= low:
                middle = (last + row) // 2
                if row > last:
                    self._upright(column, low, max(high, middle), ink)
                    low, high = min(row, middle + 1), row
                else:
                    self._upright(column, min(low, middle + 1) if row < last else low, high, ink)
                    low, high = row, max(row, middle)
                column = at
            else:
                if high >= low:
                    self._upright(column, low, high, ink)
                    self.line(column, last, at, row, ink)
                column, low, high = at, row, row
            last = row
        if high >= low:
            self._upright(column, low, high, ink)

    def _upright(self, column: int, low: int, high: int, ink: str) -> None:
        """Set the dots of a column from one row to another."""
        if not 0 <= column < self.width * 2:
            return
        side, across, inks, bits = column & 1, column >> 1, self._inks, self._bits
        for row in range(max(low, 0), min(high, self.height * 4 - 1) + 1):
            index = (row >> 2) * self.width + across
            if inks[index] == ink:
                bits[index] |= _DOT[row & 3][side]
            else:
                self.dot(column, row, ink)

    def circle(
        self, x: float, y: float, radius: float, ink: str, spacing: float = 0.0, dot_aspect: float = 1.0
    ) -> None:
        """Draw a circle: one dot thick, or with a dot every `spacing` dots along it.

        `radius` is in widths of a dot; `dot_aspect` is how much taller than wide the terminal draws one.
        """
        if dot_aspect != 1.0:
            self.ellipse(x, y, radius, radius / dot_aspect, ink, spacing or 0.7)
            return
        if spacing <= 0:
            # Along the flatter axis of each eighth there is one dot a column: no corners, no gaps.
            reach = math.ceil(radius * math.sqrt(0.5))
            for step in range(-reach, reach + 1):
                other = math.sqrt(max(radius * radius - step * step, 0.0))
                for a, b in ((step, other), (step, -other), (other, step), (-other, step)):
                    self.dot(x + a + 0.5, y + b + 0.5, ink)
            return
        count = max(8, round(2 * math.pi * radius / spacing))
        for step in range(count):
            angle = 2 * math.pi * step / count
            self.dot(x + radius * math.sin(angle) + 0.5, y - radius * math.cos(angle) + 0.5, ink)

    def ellipse(self, x: float, y: float, across: float, up: float, ink: str, spacing: float = 1.0) -> None:
        """Draw an upright ellipse by its half axes, with a dot every `spacing` dots along it."""
        count = max(24, round(math.pi * (across + up)))
        angles = [2 * math.pi * step / count for step in range(count + 1)]
        points = [(x + across * math.sin(angle) + 0.5, y - up * math.cos(angle) + 0.5) for angle in angles]
        self.dotted(points, ink, spacing)

    def dotted(self, points: Sequence[tuple[float, float]], ink: str, spacing: float) -> None:
        """Draw a curve through `points` as dots that are evenly spaced along it."""
        due = 0.0
        for (x0, y0), (x1, y1) in pairwise(points):
            length = math.hypot(x1 - x0, y1 - y0)
            while due <= length and length > 0:
                self.dot(x0 + (x1 - x0) * due / length, y0 + (y1 - y0) * due / length, ink)
                due += spacing
            due -= length

    def signs(self) -> Iterator[tuple[int, int, str, str]]:
        """Return column, row, sign and ink of each cell that has dots."""
        for index, bits in enumerate(self._bits):
            if bits:
                yield index % self.width, index // self.width, _BRAILLE[bits], self._inks[index]

    def onto(self, cells: Cells, x: int, y: int) -> None:
        """Lay the dots over `cells`, with the top left corner at (x, y); cells without dots are left alone."""
        for row in range(max(0, -y), min(self.height, cells.height - y)):
            start = row * self.width
            bits = self._bits[start : start + self.width]
            if any(bits):
                cells.put_dots(x, y + row, bits, self._inks[start : start + self.width])
