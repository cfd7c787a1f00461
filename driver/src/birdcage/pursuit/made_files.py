"""Files that hooks make of a pass: how a hook tells of one, and how large it is."""

from __future__ import annotations

import os
from contextlib import suppress
from pathlib import Path

TOLD = "birdcage-file:"
"""A line that a hook prints begins so, and goes on with an absolute path, or one below `~`."""
MOST_LOOKED_AT = 20_000
"""Files of one folder; what is beyond is not counted."""


def told_path(line: str) -> str | None:
    """Return the path that a line of a hook tells; None for any other line, and for a path that is not absolute."""
    head, _, rest = line.partition(TOLD)
    if head.strip() or not rest.strip():
        return None
    try:
        path = Path(rest.strip()).expanduser()
    except RuntimeError:  # no such user
        return None
    return str(path) if path.is_absolute() else None


def size_of(path: str) -> tuple[int, int] | None:
    """Return bytes and number of files of a file, or of all within a folder; None if nothing is there.

    Links are not followed, so a folder ends where it ends.
    """
    there = Path(path)
    try:
        if not there.is_dir():
            return there.stat().st_size, 1
    except (OSError, ValueError):
        return None
    total = count = 0
    for folder, _folders, names in os.walk(there):
        for name in names:
            with suppress(OSError):  # it was renamed meanwhile
                total += (Path(folder) / name).lstat().st_size
                count += 1
            if count >= MOST_LOOKED_AT:
                return total, count
    return total, count
