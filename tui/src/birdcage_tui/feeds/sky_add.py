"""Takes elements into the catalogue: from a file, or from text that a person pasted."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

MOST_TOLD = 3
"""Damaged places that are named; of more, their number is told."""
PASTED = "pasted text"
_BEGINS_TEXT = ("{", "[", "<", "1 ", "2 ", "0 ")


@dataclass(frozen=True, slots=True)
class AddOutcome:
    """What came of it."""

    words: str
    """A sentence or two: how many there are, and which lines could not be read."""
    whole: bool
    """Whether all of the text was read; else a person may mend it."""


def add_elements(catalogue: Path, typed: str) -> AddOutcome:
    """Add what was typed: a path (with ~), or elements as text. BirdcageError where the catalogue can't be written."""
    from birdcage.sky.catalogue import Catalogue
    from birdcage.sky.formats import read_path, read_text

    text = typed.strip()
    if "\n" in text or text.startswith(_BEGINS_TEXT):
        found = read_text(typed, PASTED)
    else:
        found = read_path(Path(text.strip("\"'")).expanduser())
    wrong = " ".join(f"{each}." for each in found.complaints[:MOST_TOLD])
    if len(found.complaints) > MOST_TOLD:
        wrong += f" {len(found.complaints) - MOST_TOLD} more."
    if not found.elements and not found.groups:
        return AddOutcome(f"No elements added. {wrong}".rstrip(), whole=False)
    with Catalogue(catalogue) as opened:
        added = opened.add(found.elements)
        for each in found.groups:
            opened.add_to_group(each.name, each.norad_ids)
    names = f" {found.elements[0].name}." if len(found.elements) == 1 else ""
    words = f"Elements: {added.new} new, {added.newer} newer, {added.kept} unchanged.{names}"
    return AddOutcome(f"{words} Not read: {wrong}" if wrong else words, whole=not wrong)
