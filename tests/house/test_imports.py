"""What an import costs and brings along, looked at in a fresh interpreter (`docs/architecture.md`, *The house*)."""

from __future__ import annotations

import ast
import json
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
DRIVER = ROOT / "driver/src"
APP = ROOT / "tui/src"

HEAVY = ("numpy", "sgp4", "skyfield", "astropy", "PIL", "urllib3")
FACES = ("textual", "rich", "click", "mcp")
ARRAYS = ("numpy", "sgp4")
WITH_ARRAYS = (
    "birdcage.calibration.fit",
    "birdcage.calibration.next_best",
    "birdcage.sky.element_error",
    "birdcage.sky.frames",
    "birdcage.sky.ground_track",
    "birdcage.sky.illumination",
    "birdcage.sky.look_down",
    "birdcage.sky.passes.",
    "birdcage.sky.propagate",
    "birdcage.sky.recognition",
    "birdcage.sky.reach",
    "birdcage.sky.sun_crossing",
    "birdcage.sky.sun_vectors",
    "birdcage.sky.search_worker",
    "birdcage.sky.pass_search_job",
    "birdcage.skymap.arc_lesson",
    "birdcage.skymap.arc_model",
    "birdcage.tracking.",
)
"""Where whole catalogues are computed. Whoever uses them imports them inside a function: see the test below."""


def modules(source: Path) -> list[str]:
    """Name every module under a source folder."""
    files = sorted(path.relative_to(source).with_suffix("") for path in source.rglob("*.py"))
    return [".".join(file.parts).removesuffix(".__init__") for file in files]


def unwelcome(module: str) -> frozenset[str]:
    """Name the packages that importing `module` must not bring along."""
    if module.startswith("birdcage_tui"):
        return frozenset(HEAVY)
    names = {*FACES, *HEAVY}
    if module.startswith("birdcage.cli"):
        names.remove("click")
    if module.startswith(WITH_ARRAYS):
        names -= {*ARRAYS}
    return frozenset(names)


def imported_by(module: str, source: Path) -> set[str]:
    """Name what the text of `module` imports, wherever in it."""
    path = source.joinpath(*module.split("."))
    text = (path / "__init__.py" if path.is_dir() else path.with_suffix(".py")).read_text(encoding="utf-8")
    names: set[str] = set()
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Import):
            names.update(alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and node.module:
            names.update({node.module, *(f"{node.module}.{alias.name}" for alias in node.names)})
    return names


def loaded_after(statement: str) -> set[str]:
    """Run a statement in a fresh interpreter and return the names of all modules it leaves loaded."""
    code = f"import sys\n{statement}\nprint('loaded:', *sys.modules)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=60, check=False)
    assert done.returncode == 0, f"`{statement}` fails in a fresh interpreter:\n{done.stderr}"
    return set(done.stdout.rpartition("loaded:")[2].split())


ZYGOTE = """
import importlib, json, os, sys
names, asked, ready = json.load(sys.stdin)
for name in ready:
    importlib.import_module(name)
asked = set(asked)
assert not asked & sys.modules.keys(), "what is made ready must not hold what is asked about"
proven = set()
for name in names:
    if name in proven:
        continue
    out, into = os.pipe()
    if not os.fork():
        os.close(out)
        importlib.import_module(name)
        with open(into, "w") as tell:
            json.dump(list(sys.modules), tell)
        os._exit(0)
    os.close(into)
    with open(out) as told:
        text = told.read()
    os.wait()
    brought = ["does not load"] if not text else sorted(asked & set(json.loads(text)))
    if brought:
        print(name, *brought, sep="\\t")
    else:
        proven |= set(json.loads(text))
"""
"""One interpreter that has loaded what all may use, and a child of it for every module that no clean one brought along.

What a clean import has loaded of ours was loaded cleanly: only the rest needs a child of its own.
"""
STANDARD = ("asyncio", "email.message", "json", "logging", "sqlite3", "ssl", "subprocess", "tomllib")


def brought_along(names: list[str], asked: frozenset[str], ready: tuple[str, ...] = ()) -> dict[str, list[str]]:
    """Import each of `names` by itself, and return which of the packages asked about it brings."""
    talk = json.dumps([names, sorted(asked), [*STANDARD, *ready]])
    done = subprocess.run(
        [sys.executable, "-c", ZYGOTE], input=talk, capture_output=True, text=True, timeout=60, check=False
    )
    assert done.returncode == 0, done.stderr
    print(done.stderr)  # why something does not load, shown where a test fails
    told = (line.split("\t") for line in done.stdout.splitlines())
    return {name: brought for name, *brought in told}


def allowed(asked: frozenset[str]) -> tuple[str, ...]:
    """Name what modules may bring that are asked about no more than this: loading it once saves most of the time."""
    rich = {"textual": ("textual.app", "textual.widgets"), "click": ("click",), "sgp4": ("numpy", "sgp4.api")}
    return tuple(name for package, names in rich.items() if package not in asked for name in names)


@pytest.mark.parametrize("source", [DRIVER, APP], ids=["driver", "app"])
def test_no_module_brings_anything_heavy_or_a_face(source: Path) -> None:
    names = modules(source)
    used = set().union(*(imported_by(name, source) for name in names))
    found = {}
    for asked in {unwelcome(name) for name in names}:
        some = [name for name in names if unwelcome(name) == asked]
        found.update(brought_along(sorted(some, key=lambda name: (name in used, name)), asked, allowed(asked)))
    assert found == {}


def test_the_check_of_imports_sees_what_is_there() -> None:
    names = ["birdcage.cli.commands.pos", "birdcage.sky.elements", "birdcage.sky.passes.search", "birdcage.sky.nothing"]
    assert brought_along(names, frozenset({"click", "numpy", "textual"})) == {
        "birdcage.cli.commands.pos": ["click"],
        "birdcage.sky.passes.search": ["numpy"],
        "birdcage.sky.nothing": ["does not load"],
    }
    assert "click" in loaded_after("import birdcage.cli.commands.pos")
    assert "numpy" not in loaded_after("import birdcage.sky.watch, birdcage_tui.shell.birdcage_app")


def test_the_driver_package_itself_imports_nothing() -> None:
    tree = ast.parse((DRIVER / "birdcage/__init__.py").read_text(encoding="utf-8"))
    imports = [node for node in ast.walk(tree) if isinstance(node, ast.Import | ast.ImportFrom)]
    assert [ast.unparse(node) for node in imports] == []
