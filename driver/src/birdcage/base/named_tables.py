"""Tables with names in a TOML file of their own, as `presets.toml` and `places.toml` are.

They are read with every complaint, and written without touching what others wrote. A file that is damaged anywhere
is never written: what can be read of it is shown, and its owner mends it.
"""

from __future__ import annotations

import re
import tomllib
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Generic, Protocol, TypeVar

from birdcage.base.errors import ConfigError
from birdcage.base.paths import write_aside_and_rename
from birdcage.base.text import clean_all
from birdcage.base.user_file import read_user_file

MOST_BYTES = 1_000_000
"""A larger file is not written by a person."""
LONGEST_NAME = 40


class Named(Protocol):
    """An entry: frozen, told from others by its name."""

    @property
    def name(self) -> str:
        """What a person calls it."""


Entry = TypeVar("Entry", bound=Named)


@dataclass(frozen=True, slots=True)
class TablesRead(Generic[Entry]):
    """What a file holds, as far as it could be read."""

    entries: tuple[Entry, ...] = ()
    problems: tuple[str, ...] = ()
    """Sentences with file and line; while there are any, the file is not written."""


def same(one: str, other: str) -> bool:
    """Return whether two names are one to a person."""
    return " ".join(one.split()).casefold() == " ".join(other.split()).casefold()


def checked_name(name: str) -> str:
    """Return a name that may be kept. ValueError for none."""
    name = " ".join(name.split())
    if not name or len(name) > LONGEST_NAME or not name.isprintable():
        raise ValueError(f"a name has 1 to {LONGEST_NAME} characters that can be seen")
    return name


def number_of(row: dict[str, object], key: str, unit: str = "degrees") -> float:
    """Return a number of a table. ValueError when there is none."""
    value = row.get(key)
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise ValueError(f"{key} must be a number of {unit}")
    try:
        return float(value)
    except OverflowError:
        raise ValueError(f"{key} is no number of {unit}") from None


class NamedTables(Generic[Entry]):
    """How one such file is laid out: `[[table]]` after `[[table]]`."""

    def __init__(
        self, table: str, plural: str, header: str, *, read: Callable[[dict[str, object]], Entry],
        cells: Callable[[Entry], dict[str, object]],
    ) -> None:  # fmt: skip
        """Take the name of a table, of many, what a new file begins with, and how an entry is read and written.

        `read` raises ValueError for what is none; `cells` returns what stands in a table, None for what is left out.
        """
        self.table, self.plural, self.header = table, plural, header
        self._read, self._cells = read, cells
        self._heading = re.compile(rf"\s*\[\[\s*[\"']?{table}[\"']?\s*\]\]")

    def load(self, path: Path) -> TablesRead[Entry]:
        """Read the file; one that is absent is empty. Nothing is raised: what is wrong stands in `problems`."""
        try:
            raw = read_user_file(path, MOST_BYTES)
        except FileNotFoundError:
            return TablesRead()
        except OSError as error:
            return TablesRead((), (f"{path} can't be read ({error.strerror or error}).",))
        return self._parse(path, raw)

    def add(self, path: Path, entry: Entry, at: int | None = None) -> TablesRead[Entry]:
        """Keep another one, at the end or as the entry number `at`. ConfigError, nothing written: see `_write`."""

        def change(entries: list[Entry]) -> None:
            entries.insert(len(entries) if at is None else max(0, min(at, len(entries))), entry)

        return self._write(path, change)

    def replace(self, path: Path, name: str, entry: Entry) -> TablesRead[Entry]:
        """Put `entry` in the place of the one called `name`. ConfigError, nothing written: see `_write`."""

        def change(entries: list[Entry]) -> None:
            entries[self._index(path, entries, name)] = entry

        return self._write(path, change)

    def delete(self, path: Path, name: str) -> TablesRead[Entry]:
        """Take out the one called `name`. ConfigError, nothing written: see `_write`."""

        def change(entries: list[Entry]) -> None:
            del entries[self._index(path, entries, name)]

        return self._write(path, change)

    def _index(self, path: Path, entries: Sequence[Entry], name: str) -> int:
        found = next((index for index, entry in enumerate(entries) if same(entry.name, name)), None)
        if found is None:
            raise ConfigError(f'There is no {self.table} "{name}" in {path} any more. Nothing was written.')
        return found

    def _parse(self, path: Path, raw: bytes) -> TablesRead[Entry]:
        try:
            text = raw.decode("utf-8-sig")
        except UnicodeDecodeError as error:
            line = raw.count(b"\n", 0, error.start) + 1
            return TablesRead((), (f"{path} line {line} is not UTF-8 text.",))
        try:
            data = clean_all(tomllib.loads(text))
        except tomllib.TOMLDecodeError as error:
            return TablesRead((), (f"{path} is not valid TOML: {error}.",))
        except (RecursionError, ValueError) as error:
            # tomllib lets both through: brackets nested without end, numbers with thousands of digits.
            return TablesRead((), (f"{path} is not valid TOML: {type(error).__name__}.",))
        rows = data.get(self.table, [])
        if not isinstance(rows, list):
            return TablesRead((), (f"{path}: `{self.table}` must be tables: [[{self.table}]].",))
        lines = [number for number, line in enumerate(text.splitlines(), 1) if self._heading.match(line)]
        entries: list[Entry] = []
        problems: list[str] = []
        for index, row in enumerate(rows):
            where = f"{path} line {lines[index]}" if len(lines) == len(rows) else f"{path}, {self.table} {index + 1}"
            try:
                entry = self._entry(row)
                if any(same(entry.name, other.name) for other in entries):
                    raise ValueError(f'there is a {self.table} "{entry.name}" before it')
            except ValueError as wrong:
                problems.append(f"{where}: {wrong}.")
                continue
            entries.append(entry)
        return TablesRead(tuple(entries), tuple(problems))

    def _entry(self, row: object) -> Entry:
        if not isinstance(row, dict):
            raise ValueError(f"a {self.table} is a table: [[{self.table}]]")
        return self._read(row)

    def _write(self, path: Path, change: Callable[[list[Entry]], None]) -> TablesRead[Entry]:
        """Change the list as it is in the file now, and write it aside and rename.

        ConfigError, with nothing written: the file is damaged or can't be written, a name is there twice or no more.
        """
        now = self.load(path)
        if now.problems:
            raise ConfigError(f"{now.problems[0]} Fix that file, or move it away. Nothing was written.")
        entries = list(now.entries)
        change(entries)
        for index, entry in enumerate(entries):
            if any(same(entry.name, other.name) for other in entries[:index]):
                raise ConfigError(f'There is a {self.table} "{entry.name}" already. Nothing was written.')
        text = self._changed(path, now.entries, entries)
        read_back = self._parse(path, text.encode())
        if read_back.problems or read_back.entries != tuple(entries):
            raise ConfigError(f"{path} is laid out in a way that can't be changed by a program. Nothing was written.")
        try:
            write_aside_and_rename(path, text.encode())
        except OSError as error:
            raise ConfigError(f"{path} can't be written ({error.strerror or error}). Nothing was kept.") from error
        return read_back

    def _changed(self, path: Path, before: tuple[Entry, ...], after: list[Entry]) -> str:
        """Return the new text: comments, order and keys unknown here stay with the entries they stand at."""
        import tomlkit
        from tomlkit.exceptions import TOMLKitError

        try:
            text = read_user_file(path, MOST_BYTES).decode("utf-8-sig")
        except FileNotFoundError:
            text = self.header
        try:
            document = tomlkit.parse(text)
            kept = list(document.get(self.table, []))
            rows = tomlkit.aot()
            for entry in after:
                index = next((i for i, old in enumerate(before) if same(old.name, entry.name)), None)
                if index is None and len(after) == len(before):
                    index = after.index(entry)  # renamed where it stands
                row = tomlkit.table() if index is None else kept[index]
                old = {} if index is None else self._cells(before[index])
                for key, value in self._cells(entry).items():
                    if value is None:
                        row.pop(key, None)
                    elif key not in old or old[key] != value:
                        row[key] = _item(value)
                rows.append(row)
            document.pop(self.table, None)
            if after:
                document[self.table] = rows
            # The library adds a blank line at every change.
            written = re.sub(r"\n{3,}", "\n\n", tomlkit.dumps(document)).rstrip() + "\n"
            was, now = ({**tomllib.loads(each), self.table: None} for each in (text, written))
        except (TOMLKitError, TypeError, ValueError, RecursionError) as error:
            raise ConfigError(f"{path} can't be changed by a program ({error}). Nothing was written.") from error
        if was != now:
            raise ConfigError(f"{path} holds more than {self.plural}, which would be changed too. Nothing was written.")
        return written


def _item(value: object) -> Any:  # noqa: ANN401 - whatever the library makes of it
    """Return what is put into the file: a long list has a line for each of its members."""
    import tomlkit

    if isinstance(value, tuple | list):
        return tomlkit.item([list(each) for each in value]).multiline(len(value) > 4)
    return value
