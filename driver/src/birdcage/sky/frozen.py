"""A few real element sets that ship with birdcage, for a first look at how lists and plots work.

They are old: each carries its epoch, and `source` is `frozen`. Where a satellite stands today cannot be told from
them, so whoever points a real dish by them is told.
"""

from __future__ import annotations

from functools import cache
from importlib.resources import files

from birdcage.sky.elements import ElementSet
from birdcage.sky.formats import read_text

SOURCE = "frozen"


@cache
def frozen() -> tuple[ElementSet, ...]:
    """Return the sets that ship: the ISS of September 2026, the others of January 2018."""
    text = files("birdcage.sky").joinpath("data", "frozen.json").read_text(encoding="utf-8")
    return read_text(text, SOURCE).elements
