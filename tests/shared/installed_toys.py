"""Installs the package of toys into the running program, and takes it out again: no network, no trace, no neighbour."""

from __future__ import annotations

import importlib
import sys
import tomllib
from contextlib import contextmanager
from pathlib import Path

from birdcage.rotator import machines

TOYS = Path(__file__).parents[1] / "toys"


@contextmanager
def installed(folder):
    """Write what an installer would into `folder`, from the package's own pyproject, and put both on the path."""
    project = tomllib.loads((TOYS / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    info = folder / f"{project['name'].replace('-', '_')}-{project['version']}.dist-info"
    info.mkdir()
    (info / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {project['name']}\nVersion: {project['version']}\n")
    points = [
        line
        for group, names in project["entry-points"].items()
        for line in (f"[{group}]", *(f"{name} = {where}" for name, where in names.items()))
    ]
    (info / "entry_points.txt").write_text("\n".join(points) + "\n")
    added = [str(folder), str(TOYS / "src")]
    sys.path[:0] = added
    importlib.invalidate_caches()
    machines.look_anew()
    try:
        yield
    finally:
        sys.path[:] = [each for each in sys.path if each not in added]
        for name in [each for each in sys.modules if each.split(".")[0] == "birdcage_toys"]:
            del sys.modules[name]
        importlib.invalidate_caches()
        machines.look_anew()
