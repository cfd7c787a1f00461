"""What a raw console line may do, as data: every dialect has a table, and every face warns from it."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import IntEnum


class Grade(IntEnum):
    """How much a line may do; the higher, the worse."""

    HARMLESS = 0
    SETTING = 1
    """Changes a setting. What is in no table counts as this."""
    MOVES = 2
    RUINS = 3
    """Can ruin the dish or deadlock its shell."""


@dataclass(frozen=True, slots=True)
class Verdict:
    """What is to be said of one line before it is sent."""

    grade: Grade
    consequence: str
    """A sentence for a person; empty for a harmless line."""
    forgets: frozenset[str] = frozenset()
    """What no longer holds afterwards: of `position`, `turn`, `homed`, `limits`, `search`, `settings`."""
    limit: str = ""
    """Which limit a raw motion would break and by how much, as a sentence; empty when none, or not a motion."""
    motion: tuple[int, float] | None = None
    """The axis and the absolute angle (dish frame, degrees) that the line sends it to, when that can be read off it."""
    listed: bool = True
    """Whether the table knows the line."""
    takes_s: float = 0.0
    """How long it may keep the shell busy before the prompt comes back."""
    streams: bool = False
    """Whether it prints until a key ends it."""
    homes: tuple[int, ...] = ()
    """The axes whose reference it finds, with a motion that nothing stops."""
    restarts: bool = False
    """Whether the dish starts anew."""


@dataclass(frozen=True, slots=True)
class Hazard:
    """One row of a table: which lines it speaks of, in which menus, and what they do."""

    menus: frozenset[str]
    pattern: re.Pattern[str]
    """Matches the whole line, in small letters, with single spaces.

    Groups with a meaning: `axis` and `angle` of a motion (a signed angle is relative), `az` and `el` of a combined one,
    `reads` (each takes 0.1 s).
    """
    grade: Grade = Grade.HARMLESS
    consequence: str = ""
    forgets: frozenset[str] = frozenset()
    takes_s: float = 0.0
    streams: bool = False
    homes: tuple[int, ...] = ()
    restarts: bool = False
    unhomed: bool = False
    """Whether it holds only while an axis is not homed, or is not known to be."""

    def verdict(self) -> Verdict:
        """Return what this row says of a line that it speaks of."""
        return Verdict(
            self.grade,
            self.consequence,
            self.forgets,
            takes_s=self.takes_s,
            streams=self.streams,
            homes=self.homes,
            restarts=self.restarts,
        )


READ_S = 0.1
"""A generous guess of what one of the `reads` of a line takes; only a deadline depends on it."""


@dataclass(frozen=True, slots=True)
class HazardTable:
    """All rows of a dialect."""

    rows: tuple[Hazard, ...] = ()
    unlisted: Mapping[str, str] = field(default_factory=dict)
    """What is to be said of a line that no row knows, by menu; `""` for any other menu."""

    def judge(self, line: str, menu: str | None, *, homed: bool | None) -> tuple[Verdict, re.Match[str] | None]:
        """Return the gravest of what the rows say of `line`, and how that row matched it.

        `menu` None is not known: then the row of any menu counts. What no row knows counts as changing a setting.
        """
        text = " ".join(line.lower().split())
        found: list[tuple[Grade, int, Hazard, re.Match[str]]] = []
        for order, row in enumerate(self.rows):
            if (menu is not None and menu not in row.menus) or (row.unhomed and homed is True):
                continue
            if match := row.pattern.fullmatch(text):
                found.append((row.grade, -order, row, match))
        if not found:
            said = self.unlisted.get(menu or "", self.unlisted.get("", ""))
            return Verdict(Grade.SETTING, said, listed=False), None
        _grade, _order, row, match = max(found, key=lambda each: each[:2])
        reads = match.groupdict().get("reads")
        verdict = row.verdict()
        if reads is not None:
            verdict = Verdict(row.grade, row.consequence, row.forgets, takes_s=int(reads) * READ_S)
        return verdict, match
