"""The best chain of passes of one priority: weighted interval scheduling, exact."""

from __future__ import annotations

from bisect import insort
from collections.abc import Sequence

from birdcage.pursuit.schedule_piece import Piece, Turning

Value = tuple[int, int]
"""What a piece is worth: compared by the first number, then by the second; whole, so that sums are exact."""


def best_chain(pieces: Sequence[Piece], values: Sequence[Value], turning: Turning) -> list[int]:
    """Return which pieces, in order of time, are worth the most together, each following the one before it.

    Of equals the one is taken that is found first, in the order of `Piece.order`. The first number of each value is
    positive.
    """
    order = sorted(range(len(pieces)), key=lambda index: pieces[index].order)
    previous: dict[int, int | None] = {}
    # The best chain that ends with each piece; the best one first, and of equals the one that was found first.
    ranking: list[tuple[int, int, int, int]] = []
    for place, index in enumerate(order):
        seconds, height = values[index]
        last = next((each for each in ranking if turning.follows(pieces[each[3]], pieces[index])), None)
        previous[index] = None if last is None else last[3]
        if last is not None:
            seconds, height = seconds - last[0], height - last[1]
        insort(ranking, (-seconds, -height, place, index))
    chain: list[int] = []
    at = ranking[0][3] if ranking else None
    while at is not None:
        chain.append(at)
        at = previous[at]
    return chain[::-1]
