r"""A machine's settings as a file: what it has printed, under lines that say of what machine and when.

    # birdcage settings
    # machine: Carryout G2
    # firmware: g2
    # read: 2026-11-27T21:40:00Z
    # DEMO                                    only of a simulated dish
    # table:
    Num  Name                         Current      Saved      Default
    ...

What follows the last line of the head is what the machine has printed, byte for byte. Older backups have no head, or
`# DEMO` alone.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from datetime import datetime
from itertools import count
from pathlib import Path

from birdcage.base.errors import StoreError
from birdcage.base.reason import Reason
from birdcage.base.text import clean
from birdcage.base.user_file import read_user_file

MOST_BYTES = 262_144
"""A larger file is no table of settings: 150 rows take about 10,000."""
_TITLE, _TABLE, _DEMO = "# birdcage settings", "# table:", "# DEMO"


@dataclass(frozen=True, slots=True)
class SettingsDump:
    """What a file of settings holds."""

    printed: tuple[str, ...]
    machine: str = ""
    """Empty where the file does not say."""
    firmware: str = ""
    """As `Facts.firmware`; empty where the file does not say."""
    read: str = ""
    """When, as it stands in the file."""
    demo: bool = False


def backup_path(folder: Path, settings_name: str, firmware: str, utc: datetime) -> Path:
    """Return where a backup of this moment goes: a file that does not exist yet."""
    name = f"{settings_name}-{firmware}-{utc:%Y%m%dT%H%M%SZ}"
    names = (f"{name}.txt" if number == 1 else f"{name}-{number}.txt" for number in count(1))
    return next(path for each in names if not (path := folder / each).exists())


def read_settings_file(path: Path) -> SettingsDump:
    """Return what a file of settings holds. StoreError for what is none, or can't be read."""
    name = clean(str(path))
    try:
        data = read_user_file(path, MOST_BYTES)
    except OSError as error:
        raise StoreError(f"{name} can't be read: {error.strerror}. Nothing was sent.", reason=Reason.MISSING) from error
    return read_settings_text(data, name)


def settings_text(machine: str, firmware: str, utc: datetime, printed: Sequence[str], *, demo: bool) -> str:
    """Return such a file."""
    head = [_TITLE, f"# machine: {machine}", f"# firmware: {firmware}", f"# read: {utc:%Y-%m-%dT%H:%M:%SZ}"]
    lines = (*head, *([_DEMO] if demo else ()), _TABLE, *printed)
    return "".join(f"{line}\n" for line in lines)


def read_settings_text(data: bytes, name: str) -> SettingsDump:
    """Return what a file holds. StoreError (`damaged`), which calls it by `name`, for what is no such file."""
    try:
        text = data.decode()
    except UnicodeDecodeError:
        raise _no_dump(name, "it is not text in UTF-8") from None
    lines = text.removeprefix("\ufeff").split("\n")
    lines = [line.removesuffix("\r") for line in (lines if lines[-1] else lines[:-1])]
    for number, line in enumerate(lines, 1):
        if not line.isprintable():
            raise _no_dump(name, f"line {number} holds control characters")
    if not lines:
        raise _no_dump(name, "it is empty")
    head = lines[: lines.index(_TABLE)] if lines[0] == _TITLE and _TABLE in lines else []
    if not head:
        head = [line for line in lines[:1] if line == _DEMO]
        return SettingsDump(tuple(lines[len(head) :]), demo=bool(head))
    told = dict(line[2:].split(": ", 1) for line in head if ": " in line)
    return SettingsDump(
        tuple(lines[len(head) + 1 :]), clean(told.get("machine", "")), clean(told.get("firmware", "")),
        clean(told.get("read", "")), _DEMO in head,
    )  # fmt: skip


def _no_dump(name: str, why: str) -> StoreError:
    return StoreError(f"{name} is no dump of a dish's settings: {why}. Nothing was sent.", reason=Reason.DAMAGED)
