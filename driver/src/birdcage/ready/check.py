"""One thing that a station needs: whether it is good, worth a look, or must be fixed first."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

State = Literal["good", "look", "must"]
Subject = Literal[
    "config", "place", "clock", "elements", "favourites", "ephemeris", "dish", "port", "search", "limits", "feed",
    "downlinks", "radio", "signal", "hooks",
]  # fmt: skip
GLYPHS: dict[State, str] = {"good": "✓", "look": "!", "must": "✗"}


@dataclass(frozen=True, slots=True)
class Check:
    """One line of the list."""

    subject: Subject
    """What it is about; several may be about one thing."""
    name: str
    state: State
    words: str
    remedy: str = ""
    """The command, or what else mends it; empty for what is good."""
