"""Reads sentences off a screen: cuts its rows at frames and gaps, and joins what was wrapped."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from tests.house.sentences import Sentence, split

FRAME = "─━│╭╮╰╯┌┐└┘├┤┬┴┼╶╴╷╵╔╗║═╬▂▐▌▄▀█┃┆┊"
APART = re.compile(rf"[{FRAME}\u2800-\u28ff]+|\s{{2,}}")
EDGES = "│┃║▐▌"


@dataclass(slots=True)
class _Block:
    """Text that begins at a column and goes on in the rows below, and where its last row ends."""

    text: str
    start: int
    row: int
    end: int
    edge: int


def _pieces(row: str) -> Iterator[tuple[int, str, int]]:
    """Yield each piece of text in a row: where it begins, itself, and where its pane ends."""
    begin = 0
    for gap in [*APART.finditer(row), None]:
        stop = len(row) if gap is None else gap.start()
        piece = row[begin:stop]
        if piece.strip():
            start = begin + len(piece) - len(piece.lstrip())
            edge = min((at for sign in EDGES if (at := row.find(sign, stop)) >= 0), default=len(row))
            yield start, piece.strip(), edge
        if gap is not None:
            begin = gap.end()


def blocks(rows: Iterable[str]) -> Iterator[str]:
    """Yield each text of a screen, whole: a row goes on below if the next word did not fit beside it."""
    open_: list[_Block] = []
    for number, row in enumerate(rows):
        for start, piece, edge in _pieces(row):
            first = piece.split(maxsplit=1)[0]
            figures = re.search(r"[^\W\d_]{2}", piece) is None  # a column of a table is no sentence
            above = None if figures else next(
                (each for each in open_ if each.start == start and each.row == number - 1
                 and each.edge == edge and each.end + 1 + len(first) > edge - 1), None)  # fmt: skip
            if above is None:
                open_.append(_Block(piece, start, number, start + len(piece), edge))
            else:
                above.text, above.row, above.end = f"{above.text} {piece}", number, start + len(piece)
        for each in [each for each in open_ if each.row < number]:
            open_.remove(each)
            yield each.text
    yield from (each.text for each in open_)


def of_screen(text: str, where: str) -> list[Sentence]:
    """Return the sentences on a screen."""
    return [Sentence(part, where) for block in blocks(text.splitlines()) for part in split(block)]
