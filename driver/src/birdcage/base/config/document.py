"""The file as it is: its tables, where each key stands, or why it could not be read at all."""

from __future__ import annotations

import re
import tomllib
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from birdcage.base.config.settings import Problem
from birdcage.base.text import clean, clean_all
from birdcage.base.user_file import read_user_file

_TABLE = re.compile(r"\s*\[{1,2}\s*([^\[\]]+?)\s*\]{1,2}\s*(#.*)?$")
_KEY = re.compile(r"\s*((?:[\w-]+|\"[^\"]*\"|'[^']*')(?:\s*\.\s*(?:[\w-]+|\"[^\"]*\"|'[^']*'))*)\s*=")
_PART = re.compile(r"[\w-]+|\"[^\"]*\"|'[^']*'")


@dataclass(frozen=True, slots=True)
class Document:
    """A file that was read, or what can be said of one that was not."""

    path: Path | None
    data: dict[str, Any] = field(default_factory=dict)
    problems: tuple[Problem, ...] = ()
    lines: dict[tuple[str, ...], int] = field(default_factory=dict)

    def line(self, path: tuple[str, ...]) -> int | None:
        """Return in which line the key stands, None if nowhere."""
        return _line_of(self.lines, path)


def read_document(path: Path | None) -> Document:
    """Read a TOML file; one that is absent is empty, one that is damaged too, and says so."""
    if path is None:
        return Document(None)
    try:
        raw = read_user_file(path)
    except FileNotFoundError:
        return Document(path)
    except OSError as error:
        return _unreadable(path, None, f"The file cannot be read: {error.strerror}.")
    try:
        text = raw.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = raw.count(b"\n", 0, error.start) + 1
        return _unreadable(path, line, "The file is damaged here: not UTF-8 text.")
    try:
        return Document(path, _clean(tomllib.loads(text)), (), _find_lines(text))
    except tomllib.TOMLDecodeError as error:
        found = re.search(r"\(at line (\d+)", str(error))
        line = int(found.group(1)) if found else len(text.rstrip().splitlines())
        what = re.sub(r"\s*\(at .*\)$", "", str(error))
        return _unreadable(path, line, f"The file is not valid TOML here ({what}).{_key_in(text, line)}")


def _clean(tables: dict[str, Any]) -> dict[str, Any]:
    """Return it with every text clean; the command of a signal keeps its line ends, which may mean something to it."""
    cleaned = clean_all(tables)
    signals = tables.get("signal")
    for name, table in signals.items() if isinstance(signals, dict) else ():
        command = table.get("command") if isinstance(table, dict) else None
        if isinstance(command, str):
            cleaned["signal"][clean(name)]["command"] = "\n".join(map(clean, command.split("\n")))
    return cleaned


def _unreadable(path: Path, line: int | None, what: str) -> Document:
    # Which limits it held is unknown, so it counts as holding some.
    sentence = f"{what} Every setting has its default."
    return Document(path, problems=(Problem(path, line, None, sentence, limits_motion=True),))


def _key_in(text: str, line: int) -> str:
    lines = text.splitlines()
    content = clean(lines[line - 1]).strip() if 0 < line <= len(lines) else ""
    return f" The line is: {content[:60]}." if content else ""


def _find_lines(text: str) -> dict[tuple[str, ...], int]:
    """Return the line, counted from 1, of each table and key by its full path. That it is TOML is known.

    Every table above a path has a line too: the first in which something of it stands. Keys inside inline tables
    have none of their own: see `_line_of`.
    """
    lines: dict[tuple[str, ...], int] = {}
    table: tuple[str, ...] = ()
    for number, line in enumerate(text.splitlines(), 1):
        if found := _TABLE.match(line):
            path = table = _parts(found.group(1))
        elif found := _KEY.match(line):
            path = table + _parts(found.group(1))
        else:
            continue
        for length in range(1, len(path) + 1):
            lines.setdefault(path[:length], number)
    return lines


def _line_of(lines: dict[tuple[str, ...], int], path: tuple[str, ...]) -> int | None:
    """Return the line of `path`, or of what it stands in; None if that is nowhere."""
    while path:
        if path in lines:
            return lines[path]
        path = path[:-1]
    return None


def _parts(dotted: str) -> tuple[str, ...]:
    return tuple(part.strip("\"'") for part in _PART.findall(dotted))
