"""What was read from a text: element sets, groups, and what could not be read and why."""

from __future__ import annotations

from dataclasses import dataclass, field

from birdcage.base.text import clean
from birdcage.sky.elements import ElementSet


@dataclass(frozen=True, slots=True)
class Complaint:
    """Something that was skipped, in words that a person can act on."""

    source: str
    """The file, or whatever the reader was told that the text is."""
    line: int
    """From 1; 0 where the whole source is meant."""
    why: str

    def __str__(self) -> str:
        where = f"{self.source}:{self.line}" if self.line else self.source
        return f"{where}: {self.why}"


@dataclass(frozen=True, slots=True)
class NumberGroup:
    """A named list of catalogue numbers, as a Gpredict `.cat` file holds it."""

    name: str
    norad_ids: tuple[int, ...]
    source: str


@dataclass(frozen=True, slots=True)
class ParseResult:
    """The good and the bad of one or more texts, each in the order of reading; doubles are kept."""

    elements: tuple[ElementSet, ...] = ()
    complaints: tuple[Complaint, ...] = ()
    groups: tuple[NumberGroup, ...] = ()


class Unreadable(ValueError):
    """One element set cannot be taken; the message says why.

    `where` names the part that is wrong: a keyword of an OMM, or `line 1` or `line 2` of a TLE; empty for the whole.
    """

    def __init__(self, why: str, where: str = "") -> None:
        super().__init__(why)
        self.where = where


@dataclass(slots=True)
class ParseCollector:
    """Where the readers of one text put what they find."""

    source: str
    elements: list[ElementSet] = field(default_factory=list)
    complaints: list[Complaint] = field(default_factory=list)
    groups: list[NumberGroup] = field(default_factory=list)

    def __post_init__(self) -> None:
        """Take the name of the source, which may be a file's, as it may be shown."""
        self.source = clean(self.source)

    def complain(self, line: int, why: str) -> None:
        """Note that something at this line, counted from 1, was skipped."""
        self.complaints.append(Complaint(self.source, line, clean(why)))

    def harvest(self) -> ParseResult:
        """Return all of it; complaints in the order of their lines."""
        complaints = sorted(self.complaints, key=lambda complaint: complaint.line)
        return ParseResult(tuple(self.elements), tuple(complaints), tuple(self.groups))
