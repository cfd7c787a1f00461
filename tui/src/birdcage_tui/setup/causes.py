"""The walk through the causes of a port that does not answer: likeliest first, one of them unfolded."""

from __future__ import annotations

from collections.abc import Sequence

from birdcage.setup.case import Cause
from birdcage.setup.step import StepView

from birdcage_tui.drawing.cell_text import cut, wrap
from birdcage_tui.setup.wiring import Line


def told_apart(step: StepView, causes: Sequence[Cause], detail: str) -> tuple[tuple[str, ...], str]:
    """Return the words of the step without what the walk tells itself, and the sentence of what was seen."""
    walked = {f"{cause.title}: {cause.what_to_do}" for cause in causes} | {detail}
    seen = next((words for words in step.words if words.startswith("Seen: ")), "")
    return tuple(words for words in step.words if words not in walked and words != seen), seen


def seen_lines(seen: str, width: int) -> list[Line]:
    """Return what was seen at each baud rate."""
    if not seen:
        return [(("dim", cut("birdcage has tried only this speed so far.", width)),)]
    return [(("accent", row),) for row in wrap(seen, max(width, 20))]


def cause_lines(causes: Sequence[Cause], chosen: int, width: int, room: int) -> list[Line]:
    """Return all causes within `room` rows: titles in a row each, the chosen one with why and what to do.

    Where even the titles do not fit, those around the chosen one stay.
    """
    if not causes:
        return []
    chosen = min(max(chosen, 0), len(causes) - 1)
    if sum(len(_block(cause, width)) + 1 for cause in causes) <= room:
        return [
            line for number, cause in enumerate(causes)
            for line in (_title(number, cause, len(causes), here=number == chosen), *_block(cause, width))
        ]  # fmt: skip
    block = _block(causes[chosen], width)
    titles = max(room - len(block), 1)
    first = min(max(chosen - titles // 2, 0), max(len(causes) - titles, 0))
    found: list[Line] = []
    for number in range(first, min(first + titles, len(causes))):
        found.append(_title(number, causes[number], len(causes), here=number == chosen))
        if number == chosen:
            found += block
    return found


def _title(number: int, cause: Cause, count: int, *, here: bool) -> Line:
    likely = ("warn", "  likely") if cause.likely else ("dim", "  possible")
    return (
        ("accent-strong" if here else "dim", "▶ " if here else "  "),
        ("strong" if here else "text", f"{number + 1}/{count} {cause.title}"),
        likely,
    )


def _block(cause: Cause, width: int) -> list[Line]:
    why = [(("dim", f"    {row}"),) for row in wrap(cause.why, max(width - 4, 20))]
    rows = wrap(cause.what_to_do.replace("`birdcage wiring` draws the plug.", "w draws the plug."),
                         max(width - 6, 20))  # fmt: skip
    todo = [(("accent", "  → " if not index else "    "), ("text", row)) for index, row in enumerate(rows)]
    return [*why, *todo]
