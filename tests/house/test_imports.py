"""What an import costs and brings along, looked at in a fresh interpreter (DESIGN section 3, laws 2 and 5)."""

from __future__ import annotations

import ast
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
DRIVER = ROOT / "driver/src"
APP = ROOT / "tui/src"

HEAVY = ("numpy", "sgp4", "skyfield", "astropy", "PIL", "urllib3")
FACES = ("textual", "rich", "click", "mcp")


def modules(source: Path) -> list[str]:
    """Name every module under a source folder."""
    files = sorted(path.relative_to(source).with_suffix("") for path in source.rglob("*.py"))
    return [".".join(file.parts).removesuffix(".__init__") for file in files]


def unwelcome(module: str) -> tuple[str, ...]:
    """Name the packages that importing `module` must not bring along."""
    if module.startswith("birdcage_tui"):
        return HEAVY
    if module.startswith("birdcage.cli"):
        return tuple(name for name in FACES + HEAVY if name != "click")
    return FACES + HEAVY


def loaded_after(statement: str) -> set[str]:
    """Run a statement in a fresh interpreter and return the names of all modules it leaves loaded."""
    code = f"import sys\n{statement}\nprint('loaded:', *sys.modules)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=60, check=False)
    assert done.returncode == 0, f"`{statement}` fails in a fresh interpreter:\n{done.stderr}"
    return set(done.stdout.rpartition("loaded:")[2].split())


@pytest.mark.parametrize("module", modules(DRIVER) + modules(APP))
def test_a_module_brings_nothing_heavy_and_no_face(module: str) -> None:
    loaded = loaded_after(f"import {module}")
    assert sorted(loaded.intersection(unwelcome(module))) == []


def test_the_driver_package_itself_imports_nothing() -> None:
    tree = ast.parse((DRIVER / "birdcage/__init__.py").read_text(encoding="utf-8"))
    imports = [node for node in ast.walk(tree) if isinstance(node, ast.Import | ast.ImportFrom)]
    assert [ast.unparse(node) for node in imports] == []
