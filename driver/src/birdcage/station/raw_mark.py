"""The remark that stands in the transcript before the bytes of a line that somebody typed: written and read here."""

from __future__ import annotations

import re
from dataclasses import dataclass

from birdcage.rotator.verdict import Grade

_ENTER = "Enter"
_MARK = re.compile(
    rf"raw by (?P<holder>[^:]+): (?P<line>.*) \((?P<grade>{'|'.join(grade.name for grade in Grade)})"
    r"(?:, (?P<about>.*))?\)",
    re.DOTALL,
)


@dataclass(frozen=True, slots=True)
class RawMark:
    """Who typed what, how bad it may be, and what else is to be said of it."""

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
