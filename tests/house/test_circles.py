"""No module needs one that needs it, imports inside functions counted (`docs/architecture.md`, *The house*).

`lint-imports` holds the floors, which are rooms; this holds the modules within them. An import for annotations alone,
under `TYPE_CHECKING`, is none: nothing runs.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PACKAGES = [ROOT / "driver/src/birdcage", ROOT / "tui/src/birdcage_tui"]


def sources(package: Path) -> dict[str, ast.Module]:
    """Return every module below a package, by its dotted name."""
    found = {}
    for path in sorted(package.rglob("*.py")):
        parts = path.relative_to(package.parent).with_suffix("").parts
        found[".".join(parts).removesuffix(".__init__")] = ast.parse(path.read_text(encoding="utf-8"))
    return found


def imports(node: ast.AST) -> Iterator[str]:
    """Name what is imported below a node, at any depth: both the module and each name of it, which may be a module."""
    for child in ast.iter_child_nodes(node):
        if isinstance(child, ast.If) and ast.unparse(child.test) in ("TYPE_CHECKING", "typing.TYPE_CHECKING"):
            for other in child.orelse:
                yield from imports(other)
        elif isinstance(child, ast.Import):
            yield from (alias.name for alias in child.names)
        elif isinstance(child, ast.ImportFrom):
            assert child.level == 0, "imports are absolute here"
            yield from (f"{child.module}.{alias.name}" for alias in child.names)
        else:
            yield from imports(child)


def edges(trees: Mapping[str, ast.Module]) -> dict[str, set[str]]:
    """Return which modules each one imports, of those that are there."""

    def module_of(name: str) -> str:
        while name and name not in trees:
            name = name.rpartition(".")[0]
        return name

    return {name: {module_of(each) for each in imports(tree)} - {name, ""} for name, tree in trees.items()}


def circles(graph: Mapping[str, set[str]]) -> list[list[str]]:
    """Return each circle that is met by walking down, as the modules on it in order."""
    found: list[list[str]] = []
    done: set[str] = set()

    def walk(name: str, way: list[str]) -> None:
        if name in way:
            found.append(way[way.index(name) :])
        elif name not in done:
            for each in sorted(graph[name]):
                walk(each, [*way, name])
            done.add(name)

    for name in sorted(graph):
        walk(name, [])
    return found


@pytest.mark.parametrize("package", PACKAGES, ids=lambda path: path.name)
def test_no_module_stands_in_a_circle(package: Path) -> None:
    assert circles(edges(sources(package))) == []


def test_the_check_sees_lazy_imports_and_no_annotations() -> None:
    texts = {
        "a": "def f():\n    from b import g",
        "b": "import c",
        "c": "import a.x",
        "d": "from typing import TYPE_CHECKING\nif TYPE_CHECKING:\n    from e import x",
        "e": "import d",
    }
    assert circles(edges({name: ast.parse(text) for name, text in texts.items()})) == [["a", "b", "c"]]
