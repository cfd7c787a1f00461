"""Writes single keys into `birdcage.toml` and leaves the rest as its owner wrote it: comments, order, unknown parts."""

from __future__ import annotations

import math
import tomllib
from collections.abc import Mapping, MutableMapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from birdcage.base.config.document import read_document
from birdcage.base.config.schema import NAMED, KeyRow, rows
from birdcage.base.config.value import BadValue, did_you_mean, from_toml
from birdcage.base.errors import ConfigError
from birdcage.base.paths import write_aside_and_rename
from birdcage.base.user_file import read_user_file

if TYPE_CHECKING:
    from tomlkit import TOMLDocument

Value = str | float | bool | None | Sequence[Sequence[str | float]]
"""A sequence of sequences is a list of sectors or points; an empty one stays in the file as `[]`."""

ONE_LINE = 4
"""So many sectors or points stand in one line of the file; more have a line each."""


def edit(path: Path, changes: Mapping[str, Value]) -> None:
    """Set keys by their dotted path (`motion.min_elevation_deg`, `feed.NAME.beam_deg`); None takes a key out.

    The file is made if there is none, written aside and renamed; no copy of the old one is kept. A file that already
    says all this is not touched. ConfigError, with nothing written: the file is damaged or can't be written, there is
    no such setting, or a value is not allowed.
    """
    changes = {dotted: _plain(value) for dotted, value in changes.items()}
    for dotted, value in changes.items():
        if value is not None:
            _check(dotted, value)
    document = read_document(path)
    if document.problems:
        raise ConfigError(
            f"Nothing was written: {document.problems[0].text} Fix that file, or move it away, and try again."
        )
    if all(_found(document.data, dotted) == value for dotted, value in changes.items()):
        return
    text = _changed(path, changes)
    try:
        write_aside_and_rename(path, text.encode())
    except OSError as error:
        raise ConfigError(f"{path} can't be written ({error.strerror or error}): nothing was kept.") from error


def _plain(value: Value) -> Value:
    """Return what TOML knows: lists, whatever kind of sequence was given."""
    if isinstance(value, Sequence) and not isinstance(value, str):
        return [list(each) for each in value]
    return value


def _check(dotted: str, value: Value) -> None:
    row = _row(dotted)
    try:
        from_toml(row, value)
    except BadValue as error:
        raise ConfigError(f"{dotted} {error}. Nothing was written.") from None


def _row(dotted: str) -> KeyRow:
    parts = dotted.split(".")
    schema = f"{parts[0]}.NAME.{parts[-1]}" if parts[0] in NAMED and len(parts) == 3 and parts[1] else dotted
    known = {row.path: row for row in rows()}
    if schema not in known:
        raise ConfigError(f"There is no setting {dotted}{did_you_mean(dotted, known)}.")
    return known[schema]


def _found(data: object, dotted: str) -> object:
    for part in dotted.split("."):
        data = data.get(part) if isinstance(data, dict) else None
    return data


def _changed(path: Path, changes: Mapping[str, Value]) -> str:
    """Return the new text of the file, proven to say what was asked for and nothing else."""
    import tomlkit
    from tomlkit.exceptions import TOMLKitError

    try:
        text = read_user_file(path).decode("utf-8-sig")
    except FileNotFoundError:
        text = ""
    before = tomllib.loads(text)
    try:
        document = tomlkit.parse(text)
        for dotted, value in changes.items():
            _set(document, dotted, value)
        written = tomlkit.dumps(document)
        after = tomllib.loads(written)
    except (TOMLKitError, tomllib.TOMLDecodeError) as error:
        raise ConfigError(f"{path} can't be changed by a program ({error}): nothing was written.") from error
    for dotted, value in changes.items():
        _put(before, dotted, value)
    if _pruned(after) != _pruned(before):
        # Whatever way of writing TOML has fooled the library: better nothing than half.
        raise ConfigError(f"{path} is laid out in a way that can't be changed by a program: nothing was written.")
    return written


def _set(document: TOMLDocument, dotted: str, value: Value) -> None:
    import tomlkit

    *tables, key = dotted.split(".")
    here: MutableMapping[str, Any] = document
    for name in tables:
        if name not in here:
            if value is None:
                return
            # A table that only holds other tables, as [feed] may, needs no heading of its own.
            here[name] = tomlkit.table(is_super_table=name != tables[-1])
        inner = here[name]
        if not isinstance(inner, MutableMapping):
            raise ConfigError(f"`{name}` is a value in birdcage.toml, where a section belongs: nothing was written.")
        here = inner
    if value is None:
        here.pop(key, None)
    elif isinstance(value, Sequence) and not isinstance(value, str):
        here[key] = tomlkit.item(value).multiline(len(value) > ONE_LINE)
    else:
        here[key] = value


def _put(data: dict[str, Any], dotted: str, value: Value) -> None:
    *tables, key = dotted.split(".")
    for name in tables:
        data = data.setdefault(name, {})
    if value is None:
        data.pop(key, None)
    else:
        data[key] = value


def _pruned(data: object) -> object:
    """Return the data without empty tables, which mean nothing here, and with NaN equal to itself."""
    if isinstance(data, dict):
        parts = {key: _pruned(value) for key, value in data.items()}
        return {key: value for key, value in parts.items() if value != {}}
    return "nan" if isinstance(data, float) and math.isnan(data) else data
