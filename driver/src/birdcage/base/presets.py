"""Named directions, kept in `presets.toml`: read with every complaint, written without touching what others wrote.

A file that is damaged anywhere is never written: what can be read of it is shown, and its owner mends it.
"""

from __future__ import annotations

import math
import re
import tomllib
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

from birdcage.base.errors import ConfigError
from birdcage.base.geometry import wrap_360
from birdcage.base.paths import write_aside_and_rename

MOST_BYTES = 1_000_000
"""A larger file is not a list of presets."""
LONGEST_NAME = 40
LONGEST_NOTE = 200
HEADER = "# Directions with names. True degrees: azimuth clockwise from north, elevation above the horizon.\n\n"
TABLE = "preset"
_HEADING = re.compile(r"\s*\[\[\s*[\"']?preset[\"']?\s*\]\]")


@dataclass(frozen=True, slots=True)
class Preset:
    """A direction with a name. True degrees; azimuth in [0, 360), elevation from -90 to 180."""

    name: str
    az_deg: float
    el_deg: float
    note: str = ""


@dataclass(frozen=True, slots=True)
class Presets:
    """What a file holds, as far as it could be read."""

    path: Path
    entries: tuple[Preset, ...] = ()
    problems: tuple[str, ...] = field(default=())
    """Sentences with file and line; while there are any, the file is not written."""

    def named(self, name: str) -> Preset | None:
        """Return the preset of that name, whatever its capitals; None if there is none."""
        return next((preset for preset in self.entries if _same(preset.name, name)), None)


def checked(name: str, az_deg: float, el_deg: float, note: str = "") -> Preset:
    """Return a preset that may be kept. ValueError says what is wrong with it, in words for a person."""
    name, note = " ".join(name.split()), " ".join(note.split())
    if not name or len(name) > LONGEST_NAME or not name.isprintable():
        raise ValueError(f"a name has 1 to {LONGEST_NAME} characters that can be seen")
    if len(note) > LONGEST_NOTE or not note.isprintable():
        raise ValueError(f"a note has at most {LONGEST_NOTE} characters, all to be seen")
    if not (math.isfinite(az_deg) and -360.0 <= az_deg <= 360.0):
        raise ValueError("the azimuth lies from -360 to 360 degrees")
    if not (math.isfinite(el_deg) and -90.0 <= el_deg <= 180.0):
        raise ValueError("the elevation lies from -90 to 180 degrees")
    return Preset(name, wrap_360(az_deg), el_deg, note)


def load_presets(path: Path) -> Presets:
    """Read the file; one that is absent is empty. Nothing is raised: what is wrong stands in `problems`."""
    try:
        raw = path.read_bytes()
    except FileNotFoundError:
        return Presets(path)
    except OSError as error:
        return Presets(path, (), (f"{path} can't be read ({error.strerror or error}).",))
    return _parse(path, raw)


def add_preset(path: Path, preset: Preset, at: int | None = None) -> Presets:
    """Keep another one, at the end or as the entry number `at`. ConfigError, nothing written: see `_write`."""

    def change(entries: list[Preset]) -> None:
        entries.insert(len(entries) if at is None else max(0, min(at, len(entries))), preset)

    return _write(path, change)


def replace_preset(path: Path, name: str, preset: Preset) -> Presets:
    """Put `preset` in the place of the one called `name`. ConfigError, nothing written: see `_write`."""

    def change(entries: list[Preset]) -> None:
        entries[_index(path, entries, name)] = preset

    return _write(path, change)


def delete_preset(path: Path, name: str) -> Presets:
    """Take out the one called `name`. ConfigError, nothing written: see `_write`."""

    def change(entries: list[Preset]) -> None:
        del entries[_index(path, entries, name)]

    return _write(path, change)


def _same(one: str, other: str) -> bool:
    return " ".join(one.split()).casefold() == " ".join(other.split()).casefold()


def _index(path: Path, entries: list[Preset], name: str) -> int:
    found = next((index for index, preset in enumerate(entries) if _same(preset.name, name)), None)
    if found is None:
        raise ConfigError(f'There is no preset "{name}" in {path} any more. Nothing was written.')
    return found


def _parse(path: Path, raw: bytes) -> Presets:
    if len(raw) > MOST_BYTES:
        return Presets(path, (), (f"{path} is larger than a list of presets can be.",))
    try:
        text = raw.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = raw.count(b"\n", 0, error.start) + 1
        return Presets(path, (), (f"{path} line {line} is no UTF-8 text.",))
    try:
        data = tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        return Presets(path, (), (f"{path} is no valid TOML: {error}.",))
    except (RecursionError, ValueError) as error:
        # tomllib lets both through: brackets nested without end, numbers with thousands of digits.
        return Presets(path, (), (f"{path} is no valid TOML: {type(error).__name__}.",))
    rows = data.get(TABLE, [])
    if not isinstance(rows, list):
        return Presets(path, (), (f"{path}: `{TABLE}` must be tables: [[{TABLE}]].",))
    lines = [number for number, line in enumerate(text.splitlines(), 1) if _HEADING.match(line)]
    entries: list[Preset] = []
    problems: list[str] = []
    for index, row in enumerate(rows):
        where = f"{path} line {lines[index]}" if len(lines) == len(rows) else f"{path}, preset {index + 1}"
        try:
            preset = _read(row)
            if any(_same(preset.name, other.name) for other in entries):
                raise ValueError(f'there is a preset "{preset.name}" before it')
        except ValueError as wrong:
            problems.append(f"{where}: {wrong}.")
            continue
        entries.append(preset)
    return Presets(path, tuple(entries), tuple(problems))


def _read(row: object) -> Preset:
    if not isinstance(row, dict):
        raise ValueError(f"a preset is a table: [[{TABLE}]]")
    name, note = row.get("name"), row.get("note", "")
    if not isinstance(name, str) or not isinstance(note, str):
        raise ValueError("a preset has a name, and its note is text")
    return checked(name, _number(row, "az_deg"), _number(row, "el_deg"), note)


def _number(row: dict[str, object], key: str) -> float:
    value = row.get(key)
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise ValueError(f"{key} must be a number of degrees")
    try:
        return float(value)
    except OverflowError:
        raise ValueError(f"{key} is no angle") from None


def _write(path: Path, change: Callable[[list[Preset]], None]) -> Presets:
    """Change the list as it is in the file now, and write it aside and rename.

    ConfigError, with nothing written: the file is damaged or can't be written, a name is there twice or no more.
    """
    now = load_presets(path)
    if now.problems:
        raise ConfigError(f"{now.problems[0]} Mend that file, or move it away. Nothing was written.")
    entries = list(now.entries)
    change(entries)
    for index, preset in enumerate(entries):
        if any(_same(preset.name, other.name) for other in entries[:index]):
            raise ConfigError(f'There is a preset "{preset.name}" already. Nothing was written.')
    text = _changed(path, now.entries, entries)
    read_back = _parse(path, text.encode())
    if read_back.problems or read_back.entries != tuple(entries):
        raise ConfigError(f"{path} is laid out in a way that can't be changed by a program. Nothing was written.")
    try:
        write_aside_and_rename(path, text.encode())
    except OSError as error:
        raise ConfigError(f"{path} can't be written ({error.strerror or error}). Nothing was kept.") from error
    return read_back


def _changed(path: Path, before: tuple[Preset, ...], after: list[Preset]) -> str:
    """Return the new text: comments, order and keys unknown here stay with the presets they stand at."""
    import tomlkit
    from tomlkit.exceptions import TOMLKitError

    try:
        text = path.read_bytes().decode("utf-8-sig")
    except FileNotFoundError:
        text = HEADER
    try:
        document = tomlkit.parse(text)
        kept = list(document.get(TABLE, []))
        rows = tomlkit.aot()
        for preset in after:
            index = next((i for i, old in enumerate(before) if _same(old.name, preset.name)), None)
            if index is None and len(after) == len(before):
                index = after.index(preset)  # renamed where it stands
            row = tomlkit.table() if index is None else kept[index]
            old = None if index is None else before[index]
            for key in ("name", "az_deg", "el_deg", "note"):
                value = getattr(preset, key)
                if key == "note" and not value:
                    row.pop("note", None)
                elif old is None or getattr(old, key) != value:
                    row[key] = value
            rows.append(row)
        document.pop(TABLE, None)
        if after:
            document[TABLE] = rows
        # The library adds a blank line at every change.
        written = re.sub(r"\n{3,}", "\n\n", tomlkit.dumps(document)).rstrip() + "\n"
        was, now = ({**tomllib.loads(each), TABLE: None} for each in (text, written))
    except (TOMLKitError, TypeError, ValueError, RecursionError) as error:
        raise ConfigError(f"{path} can't be changed by a program ({error}). Nothing was written.") from error
    if was != now:
        raise ConfigError(f"{path} holds more than presets, which would be changed too. Nothing was written.")
    return written
