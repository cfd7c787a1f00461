"""Where each answer of a step stands: choices in rows, and below each its fields, one a row, in columns."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass

from birdcage.setup.step import Choice, Field

from birdcage_tui.drawing.cell_text import cell_len

MOVES = "▲ moves the dish"
GAP = 2
INDENT = 6
"""Columns before the label of a field, which stands below the words of its choice."""
LEAST_FIELD, MOST_FIELD = 12, 42

Row = list[tuple[Choice, Field | None]]
"""Choices side by side, each with None; or one field of a choice."""


@dataclass(frozen=True, slots=True)
class Columns:
    """The columns that all fields of a step share, in cells."""

    label: int
    value: int
    unit: int


def columns(choices: Sequence[Choice], width: int) -> Columns:
    """Return columns that hold every field of these choices in rows of `width` cells."""
    fields = [field for choice in choices for field in choice.fields]
    label = max((cell_len(field.label) for field in fields), default=0)
    unit = max((cell_len(unit_text(field)) for field in fields), default=0)
    needs = max((cell_len(field.value or field.hint) + 3 for field in fields), default=0)
    free = width - INDENT - label - 1 - (unit + 1 if unit else 0)
    return Columns(label, max(min(needs, MOST_FIELD, free), LEAST_FIELD), unit)


def unit_text(field: Field) -> str:
    """Return the unit as it is written behind the value."""
    return field.unit.replace("deg", "°")


def key_text(choice: Choice) -> str:
    """Return the key of a choice as it is named on the keyboard."""
    return "Enter" if choice.key == "enter" else choice.key


def button_width(choice: Choice) -> int:
    """Return how many columns a choice takes."""
    return len(key_text(choice)) + 3 + cell_len(choice.label) + (len(MOVES) + 2 if choice.moves else 0)


def arrange(choices: Sequence[Choice], width: int, folded: Collection[str] = (), *, apart: bool = False) -> list[Row]:
    """Return the rows. Choices without fields share a row where they fit, unless `apart`.

    The `folded` ones show no fields.
    """
    rows: list[Row] = []
    free = 0
    for choice in choices:
        needs = button_width(choice) + GAP
        if apart or choice.fields or needs > free:
            rows.append([])
            free = width
        rows[-1].append((choice, None))
        free = 0 if choice.fields else free - needs
        if choice.name not in folded:
            rows += [[(choice, field)] for field in choice.fields]
    return rows


def fold_to(choices: Sequence[Choice], width: int, room: int, opened: str) -> frozenset[str]:
    """Return the names of the choices whose fields are not shown, so that the rows fit into `room`.

    Empty if all fit; otherwise all but the opened one.
    """
    if len(arrange(choices, width)) <= room:
        return frozenset()
    return frozenset(choice.name for choice in choices if choice.fields and choice.name != opened)
