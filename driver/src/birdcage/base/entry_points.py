"""Finds entry points of installed packages without `importlib.metadata`, whose import alone delays the first frame.

Reads `*.dist-info/entry_points.txt` of the folders on `sys.path`, in the form of the packaging specification
(https://packaging.python.org/specifications/entry-points/).
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path
from typing import Any


def entry_points(group: str) -> dict[str, str]:
    """Return what the installed packages name in a group: name to `module:attribute`. The first on the path counts."""
    found: dict[str, str] = {}
    for folder in sys.path:
        for file in _files(folder):
            for name, target in _in_group(file, group):
                found.setdefault(name, target)
    return found


def load(target: str) -> Any:  # noqa: ANN401 - whatever the package has there
    """Return what `module:attribute` names."""
    module, _, attribute = target.partition(":")
    loaded: Any = import_module(module)
    for name in filter(None, attribute.split(".")):
        loaded = getattr(loaded, name)
    return loaded


def _files(folder: str) -> Iterator[Path]:
    try:
        yield from sorted(Path(folder or ".").glob("*.dist-info/entry_points.txt"))
    except OSError:
        return  # no folder that can be read: an archive, or gone


def _in_group(file: Path, group: str) -> Iterator[tuple[str, str]]:
    try:
        text = file.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError):
        return
    inside = False
    for line in map(str.strip, text.splitlines()):
        if line.startswith("["):
            inside = line == f"[{group}]"
        elif inside and "=" in line and not line.startswith(("#", ";")):
            name, _, target = line.partition("=")
            yield name.strip(), target.partition("[")[0].strip()
