"""Tables for people: columns as wide as they need, and on a terminal no wider than that."""

from __future__ import annotations

import shutil
import sys
from collections.abc import Sequence

from birdcage.cli.say import tell

GAP = "  "


def room() -> int | None:
    """Return how many characters a line of the terminal has; None if stdout is none: there is room for all."""
    return shutil.get_terminal_size().columns if sys.stdout.isatty() else None


def tell_table(head: Sequence[str], rows: Sequence[Sequence[str]], right: str = "") -> None:
    """Print rows in columns as wide as they need; `right` has an `r` for each column that is flush right."""
    widths = widths_of(head, rows)
    for row in (head, *rows):
        cells = (
            cell.rjust(width) if right[column : column + 1] == "r" else cell.ljust(width)
            for column, (cell, width) in enumerate(zip(row, widths, strict=True))
        )
        tell(GAP.join(cells).rstrip())


def widths_of(head: Sequence[str], rows: Sequence[Sequence[str]]) -> list[int]:
    """Return how wide each column is."""
    return [max(len(row[column]) for row in (head, *rows)) for column in range(len(head))]


def whole_width(widths: Sequence[int]) -> int:
    """Return how wide columns of these widths are together."""
    return sum(widths) + len(GAP) * (len(widths) - 1)


def fitting(
    head: Sequence[str], widths: Sequence[int], width: int | None, spared: Sequence[str], long: str, shortest: int
) -> tuple[list[int], int]:
    """Return which columns there is room for, and how wide the column `long` may be.

    `spared`: what a narrow terminal goes without, the first one first. `long` is cut, but to no less than `shortest`.
    """
    shown, cut_here = list(range(len(head))), head.index(long)
    if width is None:
        return shown, widths[cut_here]
    shortest = min(widths[cut_here], shortest)

    def others() -> int:
        return whole_width([widths[column] for column in shown]) - widths[cut_here]

    for each in spared:
        if others() + shortest <= width:
            break
        shown.remove(head.index(each))
    return shown, min(widths[cut_here], max(width - others(), shortest))


def cut(text: str, width: int) -> str:
    """Return a text that is no wider; `…` where something was cut off."""
    return text if len(text) <= width else f"{text[: max(width - 1, 0)]}…"
