"""Which menu a dish is in when its prompts don't tell: by what its help lists (decision 0010)."""

from __future__ import annotations

import re
from collections.abc import Iterable

from birdcage.console.dialect import ConsoleDialect

SUBMENU = "submenu"
"""A menu that is surely not the root, and that was not yet entered under its name."""

_ENTER = re.compile(r"\s*enter\s*<(\w+)>", re.IGNORECASE)
_EXPLAINED = re.compile(r"\s-|[:<\[(]")
_WORD = re.compile(r"[a-z0-9_]+")
_LONG = 3
"""From so many letters on a command is still known when one is lost."""
_MOST_SHARED = 0.5
"""A help that shares more of its words, or of the root's, with the root's may be the root's with bytes lost."""


def commands(lines: Iterable[str]) -> frozenset[str]:
    """Return the commands that help lines list: `Enter <dvb> - …`, `a [<motor>] - …`, or bare words in columns."""
    found: set[str] = set()
    for line in lines:
        words = _WORD.findall(line.lower())
        if enter := _ENTER.match(line):
            found.add(enter[1].lower())
        else:
            found.update(words[:1] if _EXPLAINED.search(line) else words)
    return frozenset(found)


def is_of_help(line: str, dialect: ConsoleDialect) -> bool:
    """Return whether a line lists nothing but known commands, a byte of each lost, doubled or spoilt at most."""
    known = {dialect.leave, "help", *dialect.prompts, *dialect.root_marks, *dialect.root_hints}
    known.update(*dialect.submenu_marks.values())
    listed = commands([line])
    return bool(listed) and all(
        word in known or any(_alike(command, word) for command in known if len(command) >= _LONG) for word in listed
    )


class MenuPlaces:
    """What each menu of one dish listed, on one connection. Pure."""

    def __init__(self, dialect: ConsoleDialect) -> None:
        self._dialect = dialect
        self._listed: dict[str, frozenset[str]] = {}
        self._tokens: dict[str, str] = {}
        self._unsure: frozenset[str] = frozenset()
        self._judged: frozenset[str] = frozenset()

    def judge(self, lines: tuple[str, ...]) -> str | None:
        """Return the menu whose help this is; None when it does not tell, or not yet: then it is asked for again.

        A menu that was not seen before must show the same twice.
        """
        words = frozenset(_WORD.findall(" ".join(lines).lower()))
        before, self._unsure = self._unsure, frozenset()
        dialect = self._dialect
        listed = commands(lines)
        if self.is_stranger(lines):
            return None
        for end, marks in dialect.marks_of_ends.items():
            if marks <= listed:
                self._listed[end] = self._judged = words
                return end
        if not self._is_submenu(words, listed) or not self._is_list(lines, listed):
            return None
        self._judged = words
        nearest = max(self._listed, key=lambda menu: _likeness(self._listed[menu], words), default=dialect.root)
        # Fewer words than half may be of any menu: `s` and `q` stand in the damaged help of most.
        known = self._listed.get(nearest, frozenset())
        if nearest not in dialect.ends and known <= words and 2 * len(known) >= len(words):
            return nearest
        if 2 * len(words & before) > len(words):
            self._judged = self._listed[SUBMENU] = words & before
            return SUBMENU
        self._unsure = words
        return None

    def is_stranger(self, lines: tuple[str, ...]) -> bool:
        """Return whether this help is plainly another firmware's."""
        listed, dialect = commands(lines), self._dialect
        unlike = bool(dialect.stranger_marks & listed) and not dialect.root_marks & listed
        return unlike or bool(dialect.foreign_marks & listed)

    def entered(self, menu: str, token: str) -> None:
        """Take in that the submenu that was just judged is `menu`, and shows this prompt."""
        self._listed.pop(SUBMENU, None)
        self._listed[menu] = self._judged
        self._tokens[menu] = token

    def may_be(self, menu: str) -> bool:
        """Return whether the submenu that was just judged listed the documented commands of `menu`."""
        marks = self._dialect.submenu_marks.get(menu)
        return marks is not None and marks <= self._judged

    def at_end(self, menu: str, token: str) -> None:
        """Take in which prompt a menu shows that `leave` must not reach: the root, or one that is left by nothing."""
        self._tokens[menu] = token

    def is_told_by(self, token: str, menu: str) -> bool:
        """Return whether this prompt is the one of `menu`, and surely neither the root's nor its parent's."""
        above = {self._tokens.get(self._dialect.root), self._tokens.get(self._dialect.parent(menu))}
        return None not in above and token not in above and self._tokens.get(menu) == token

    def was_entered(self, menu: str, now: str) -> bool:
        """Return whether the submenu `now`, which was just judged, is the one that its parent was left for.

        From the root any submenu is, but one that nothing leaves, which shows its own commands. One below another must
        list its documented commands, and not mostly the parent's.
        """
        dialect = self._dialect
        if menu in dialect.one_way or now in dialect.ends:
            return now == menu
        if dialect.parent(menu) == dialect.root:
            return True
        above = self._listed.get(dialect.parent(menu), frozenset())
        return now == menu or (
            now == SUBMENU and self.may_be(menu) and 2 * len(above & self._judged) <= len(above | self._judged)
        )

    def _is_submenu(self, words: frozenset[str], listed: frozenset[str]) -> bool:
        """Return whether this is surely not the help of the root, nor of a menu that nothing is known to leave.

        Whole or with bytes lost.
        """
        dialect = self._dialect
        if any(not self._is_apart(end, words, listed) for end in dialect.ends):
            return False
        return dialect.root in self._listed or any(marks <= listed for marks in dialect.submenu_marks.values())

    def _is_apart(self, end: str, words: frozenset[str], listed: frozenset[str]) -> bool:
        dialect, seen = self._dialect, self._listed.get(end)
        if seen is not None:
            if end == dialect.root and listed & (dialect.root_hints - set(dialect.prompts)):
                return False
            common = {dialect.leave, "help"}  # every menu may list these
            # Of words that noise has cut in two single letters are left, which may be commands elsewhere.
            shared = sum(len(word) > 1 for word in (words & seen) - common)
            return shared <= _MOST_SHARED * min(len(seen - common), len(words - common))
        hints = dialect.root_hints if end == dialect.root else dialect.marks_of_ends[end]
        return not listed & hints and not any(
            _alike(mark, word) for mark in dialect.marks_of_ends[end] for word in listed
        )

    def _is_list(self, lines: tuple[str, ...], listed: frozenset[str]) -> bool:
        """Return whether this is a list of commands, and not an error in unknown words."""
        if any(pattern.search(line) for line in lines for pattern, _ in self._dialect.refusals):
            return False
        return len(lines) > 1 or self._dialect.leave in listed


def _likeness(one: frozenset[str], other: frozenset[str]) -> float:
    """Return the share of the words of both that both have."""
    return len(one & other) / max(len(one | other), 1)


def _alike(mark: str, word: str) -> bool:
    """Return whether `word` may be `mark` with one byte lost, doubled or spoilt."""
    if abs(len(mark) - len(word)) > 1:
        return False
    start = next((i for i, (a, b) in enumerate(zip(mark, word, strict=False)) if a != b), min(len(mark), len(word)))
    return any(mark[start + i :] == word[start + j :] for i, j in ((0, 0), (1, 0), (0, 1), (1, 1)))
