"""What a raw console line may do, as data: every dialect has a table, and every face warns from it."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field, replace

from birdcage.protocol.raw_aim import rises_above
from birdcage.rotator.verdict import Grade, Verdict


@dataclass(frozen=True, slots=True)
class Hazard:
    """One row of a table: which lines it speaks of, in which menus, and what they do."""

    menus: frozenset[str]
    """Empty: in every menu, and on a machine without any."""
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
    releases: bool = False
    loose: bool = False
    """Whether it speaks of what might be left of any line, not of a command: only in the menu that the dish is in."""

    above_deg: float | None = None
    """It speaks only of what sends the elevation `el` higher than this, or to no readable angle; None: of every line.

    The group `motor`, where there is one, says which axis it is of.
    """

    def match(self, text: str) -> re.Match[str] | None:
        """Return how it matches a line that it speaks of; None where it does not."""
        match = self.pattern.fullmatch(text)
        return match if match is None or self.above_deg is None or rises_above(match, self.above_deg) else None

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
            releases=self.releases,
        )


def row_maker(menus: frozenset[str], root: str) -> Callable[..., Hazard]:
    """Return what makes a row of a dialect with these menus.

    It takes `all`, `sub` (all but the root) or the name of a menu, the pattern, grade and consequence (harmless unless
    told), and whatever else `Hazard` has.
    """
    places = {"all": menus, "sub": menus - {root}}

    def row(where: str, pattern: str, grade: Grade = Grade.HARMLESS, consequence: str = "", **more: object) -> Hazard:
        return Hazard(
            places.get(where, frozenset({where})),
            re.compile(pattern),
            grade,
            consequence,
            **more,  # type: ignore[arg-type]
        )

    return row


READ_S = 0.1
"""A generous guess of what one of the `reads` of a line takes; only a deadline depends on it."""
SEPARATORS = re.compile("[;&|]")
"""What parts commands on other consoles; no source says whether one of these dishes takes them."""
SHORTEST_ABBREVIATION = 2
UNLISTED_FORGETS = frozenset({"position", "turn", "limits", "search", "settings"})
"""What an undocumented line may have changed, unless the dish refuses it."""
_WORD = re.compile("[a-z0-9]+")

Found = tuple[Hazard, re.Match[str]]


@dataclass(frozen=True, slots=True)
class HazardTable:
    """All rows of a dialect."""

    rows: tuple[Hazard, ...] = ()
    unlisted: Mapping[str, str] = field(default_factory=dict)
    """What is to be said of a line that no row knows, by menu; `""` for any other menu."""
    unlisted_grade: Grade = Grade.SETTING
    """What such a line counts as at least: a motion where the machine takes several commands on one line."""

    def judge(self, line: str, menu: str | None, *, homed: bool | None) -> tuple[Verdict, re.Match[str] | None]:
        """Return the gravest of what the rows say of `line`, and how that row matched it.

        `menu` None is not known: then the row of any menu counts. What no row knows counts as `unlisted_grade`, or as
        worse if it would do worse in another menu, written out in full, or taken as several commands.
        """
        text = " ".join(line.lower().split())
        found = self._gravest(text, menu, homed)
        if found is None:
            return self._unlisted(text, menu, homed), None
        row, match = found
        verdict, reads = row.verdict(), match.groupdict().get("reads")
        if reads is not None:
            verdict = replace(verdict, takes_s=int(reads) * READ_S)
        parts = self._worse_part(text, menu, homed)
        if parts is not None and parts.grade > verdict.grade:
            return parts, None
        return verdict, match

    def _gravest(self, text: str, menu: str | None, homed: bool | None, *, elsewhere: bool = False) -> Found | None:
        found: list[tuple[Grade, int, Found]] = []
        for order, row in enumerate(self.rows):
            if (menu is not None and row.menus and menu not in row.menus) or (row.unhomed and homed is True):
                continue
            if row.loose and elsewhere:
                continue
            if match := row.match(text):
                found.append((row.grade, -order, (row, match)))
        return max(found, key=lambda each: each[:2])[2] if found else None

    def _unlisted(self, text: str, menu: str | None, homed: bool | None) -> Verdict:
        said = self.unlisted.get(menu or "", self.unlisted.get("", ""))
        worst = Verdict(self.unlisted_grade, said, UNLISTED_FORGETS, listed=False)
        suspects = (
            ("The menu may have changed meanwhile. Elsewhere:", self._row_verdict(text, None, homed)),
            ("It may be taken as an abbreviation.", self._abbreviated(text, menu, homed)),
            ("It may be taken as several commands.", self._worse_part(text, menu, homed)),
        )
        for why, verdict in suspects:
            if verdict is not None and verdict.grade > worst.grade:
                worst = replace(
                    verdict, consequence=f"{why} {verdict.consequence}", forgets=verdict.forgets | UNLISTED_FORGETS,
                    streams=False, homes=(), listed=False,
                )  # fmt: skip
        return worst

    def _row_verdict(self, text: str, menu: str | None, homed: bool | None) -> Verdict | None:
        found = self._gravest(text, menu, homed, elsewhere=menu is None)
        return None if found is None else found[0].verdict()

    def _abbreviated(self, text: str, menu: str | None, homed: bool | None) -> Verdict | None:
        """Judge the gravest command that `text` may abbreviate: no source says whether the dishes take that."""
        word, _, rest = text.partition(" ")
        if len(word) < SHORTEST_ABBREVIATION:
            return None
        names = {found[0] for row in self.rows if (found := _WORD.match(row.pattern.pattern))}
        lines = [f"{name} {rest}".strip() for name in sorted(names) if name.startswith(word) and name != word]
        return _worst(self._row_verdict(line, menu, homed) for line in lines)

    def _worse_part(self, text: str, menu: str | None, homed: bool | None) -> Verdict | None:
        """Judge a line as several commands. After the first, the menu may be any."""
        first, *others = (part.strip() for part in SEPARATORS.split(text))
        if not others:
            return None
        return _worst([self._row_verdict(first, menu, homed), *(self._row_verdict(o, None, homed) for o in others)])


def _worst(verdicts: Iterable[Verdict | None]) -> Verdict | None:
    return max((each for each in verdicts if each is not None), key=lambda each: each.grade, default=None)
