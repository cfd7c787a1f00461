"""The plain values of the raw console, for the faces, which do not look below the station."""

from __future__ import annotations

from dataclasses import dataclass

from birdcage.link.transcript_join import LineJoiner
from birdcage.link.transcript_line import Direction, TranscriptEntry, format_line, printable
from birdcage.rotator.verdict import Grade, Verdict
from birdcage.station.raw_mark import RawMark, parse_mark

__all__ = [
    "CONSOLE",
    "IDLE_S",
    "Direction",
    "Grade",
    "LineJoiner",
    "MenuCommand",
    "RawMark",
    "RawReply",
    "TranscriptEntry",
    "Verdict",
    "format_line",
    "parse_mark",
    "printable",
]  # fmt: skip

CONSOLE = "console"
"""The lease holder's name while somebody talks to the firmware."""
IDLE_S = 30.0
"""After so long without a line the console is given back."""


@dataclass(frozen=True, slots=True)
class RawReply:
    """What the dish answered to one line."""

    line: str
    lines: tuple[str, ...]
    """Neither echo nor prompt."""
    menu: str | None
    """None on a machine without menus."""
    prompt: str
    """As the dish wrote it; empty where it shows none."""
    took_s: float
    ended_by_key: bool = False
    """Whether it printed on until a bare Enter ended it."""


@dataclass(frozen=True, slots=True)
class MenuCommand:
    """One command of a menu."""

    menu: str | None
    name: str
    usage: str
    """Its arguments as the dish or its documentation writes them: `a <motor> <angle>`."""
    help: str
    """What it does; empty if undocumented."""
    told_by_dish: bool
    """Whether the dish itself listed it, rather than its documentation only."""
