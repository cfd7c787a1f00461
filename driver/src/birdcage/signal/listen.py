"""How a task hears: it points, and reads the signal where the dish came to rest."""

from __future__ import annotations

from collections.abc import Generator, Sequence

from birdcage.signal.beam_fit import HeardDirection, Pattern
from birdcage.signal.ear import TaskEar
from birdcage.tracking.steps import PointAt, Step, StepResult

MOST_PATTERNS, MOST_NEIGHBOURS = 12, 6

Listening = Generator[Step, StepResult, HeardDirection | None]


def listen_at(ear: TaskEar, az_deg: float, el_deg: float, reads: int = 0, *, optional: bool = False) -> Listening:
    """Point at a true direction, and return what is heard there; None if nothing could be read.

    `reads`: how many readings, 0 for as many as suit the source. `optional`: a direction beyond the dish's limits is
    left out, which gives None; else it ends the task. NoReply where the source tells nothing any more.
    """
    there = yield PointAt(az_deg, el_deg, optional=optional)
    if there.true_az_deg is None or there.true_el_deg is None:
        return None
    values = yield from ear.values(reads or ear.reads)
    return HeardDirection(there.true_az_deg, there.true_el_deg, tuple(values)) if values else None


def check_number(name: str, value: object, low: float, high: float) -> None:
    """Raise TypeError, which refuses a task, for what is no number in this range: it may come from another program."""
    if isinstance(value, bool) or not isinstance(value, int | float) or not low <= value <= high:
        raise TypeError(f"{name} is {value!r}. Give a number from {low:g} to {high:g}")


def check_patterns(patterns: object) -> None:
    """Raise TypeError for what are no rows of offsets in degrees: right, above, right, above."""
    if not isinstance(patterns, tuple | list) or len(patterns) > MOST_PATTERNS:
        raise TypeError(f"patterns are no list of at most {MOST_PATTERNS} rows")
    for row in patterns:
        if not isinstance(row, tuple | list) or len(row) % 2 or len(row) > 2 * MOST_NEIGHBOURS:
            raise TypeError(f"a pattern is {row!r}. Give two numbers each for up to {MOST_NEIGHBOURS} neighbours")
        for value in row:
            check_number("a neighbour", value, -180.0, 180.0)


def neighbours_in(row: Sequence[float]) -> Pattern:
    """Return the neighbours that a row tells: how far right of the source, and above it, one after the other."""
    return tuple(zip(row[::2], row[1::2], strict=True))
