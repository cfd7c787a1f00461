"""The plain values of the raw console, for the faces, which do not look below the station."""

from __future__ import annotations

import re
from dataclasses import dataclass

from birdcage.link.transcript_join import LineJoiner
from birdcage.link.transcript_line import Direction, TranscriptEntry, format_line, parse_line, printable
from birdcage.rotator.verdict import Grade, Verdict

__all__ = [
    "CONSOLE",
    "IDLE_S",
    "OTHER_CONSOLE",
    "Direction",
    "Grade",
    "LineJoiner",
    "MenuCommand",
    "RawMark",
    "RawReply",
    "TranscriptEntry",
    "Verdict",
    "format_line",
    "parse_line",
    "parse_mark",
    "printable",
]  # fmt: skip

CONSOLE = "console"
"""The lease holder's name while somebody talks to the firmware."""
OTHER_CONSOLE = "other console"
"""How an attached app calls that holder while the one who talks sits elsewhere."""
IDLE_S = 30.0
"""After so long without a line the console is given back."""

_ENTER = "Enter"
_MARK = re.compile(
    rf"raw by (?P<holder>[^:]+): (?P<line>.*) \((?P<grade>{'|'.join(grade.name for grade in Grade)})"
    r"(?:, (?P<about>.*))?\)",
    re.DOTALL,
)


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


@dataclass(frozen=True, slots=True)
class RawMark:
    """The remark in the transcript before a line that somebody typed: who typed what, and how bad it may be."""

    holder: str
    line: str
    grade: Grade
    about: str = ""
    """Whether it was confirmed, which limit it breaks; empty when there is nothing to say."""

    @property
    def text(self) -> str:
        """The remark: `raw by console: a 0 9999 (MOVES, confirmed; …)`."""
        about = f", {self.about}" if self.about else ""
        return f"raw by {self.holder}: {self.line or _ENTER} ({self.grade.name}{about})"


def parse_mark(remark: str) -> RawMark | None:
    """Return what a remark says; None when it is none of these marks."""
    found = _MARK.fullmatch(remark)
    if found is None:
        return None
    line = found["line"]
    return RawMark(found["holder"], "" if line == _ENTER else line, Grade[found["grade"]], found["about"] or "")
