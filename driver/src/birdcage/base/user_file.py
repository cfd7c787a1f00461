"""Reads files that somebody else may have made: never a pipe or a device, which may block, and never without end."""

from __future__ import annotations

import errno
import os
import stat
from pathlib import Path

MOST_BYTES = 4_000_000
"""A larger file is not written by a person."""
_KINDS = ((stat.S_ISDIR, "a folder"), (stat.S_ISFIFO, "a pipe"), (stat.S_ISSOCK, "a socket"))
_FLAGS = os.O_RDONLY | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_BINARY", 0) | getattr(os, "O_CLOEXEC", 0)


def read_user_file(path: Path, most_bytes: int = MOST_BYTES) -> bytes:
    """Return what a file holds. OSError, whose `strerror` is for a person, for what is none or is larger; at once.

    FileNotFoundError where there is none.
    """
    check_regular(path)
    # Non-blocking: somebody may put a pipe in its place meanwhile.
    with os.fdopen(os.open(path, _FLAGS), "rb") as file:
        _check(os.fstat(file.fileno()), path)
        data = file.read(most_bytes + 1)
    if len(data) > most_bytes:
        raise OSError(errno.EFBIG, f"it is larger than {most_bytes / 1e6:g} MB", str(path))
    return data


def check_regular(path: Path) -> None:
    """Raise OSError for what is there and is no file: to open it might block. FileNotFoundError where nothing is."""
    _check(path.stat(), path)


def _check(found: os.stat_result, path: Path) -> None:
    if not stat.S_ISREG(found.st_mode):
        kind = next((words for is_kind, words in _KINDS if is_kind(found.st_mode)), "a device")
        raise OSError(errno.EINVAL, f"it is {kind}, not a file", str(path))
