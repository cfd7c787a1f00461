"""Rules about what the repository holds, for every file that is committed or about to be."""

from __future__ import annotations

import ast
import re
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
LONGEST_FILE = 400
SLEEPS_HERE = "driver/src/birdcage/base/clock.py"

# Written so that this file does not match itself.
PACKAGE_HOST = re.compile(r"\b(?:py[p]i\.(?:org|python)|pytho[n]hosted\.|anacond[a]\.(?:org|com)|np[m]js\.)")
MACHINE_PATH = re.compile(r"(?<![\w.~-])/(?:wor[k]|tm[p]|roo[t]|hom[e]|op[t]|User[s])/\w")


def repository_files() -> list[str]:
    listing = subprocess.run(
        ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"],
        cwd=ROOT, capture_output=True, text=True, check=True, timeout=60,
    )  # fmt: skip
    return sorted(name for name in set(listing.stdout.split("\0")) if name and (ROOT / name).is_file())


FILES = repository_files()
PYTHON = [name for name in FILES if name.endswith(".py")]
OURS = [name for name in PYTHON if name.startswith(("driver/", "tui/"))]


def text(name: str) -> str | None:
    """Return a file's text, or None for pictures, fonts and the like."""
    try:
        return (ROOT / name).read_text(encoding="utf-8")
    except UnicodeDecodeError:
        return None


def lines_matching(pattern: re.Pattern[str]) -> list[str]:
    return [
        f"{name}:{number}: {line.strip()[:120]}"
        for name in FILES
        for number, line in enumerate((text(name) or "").splitlines(), start=1)
        if pattern.search(line)
    ]


def sleeps(source: str) -> list[int]:
    """Return the lines that call, or import, the sleep of `time`."""
    return [
        node.lineno
        for node in ast.walk(ast.parse(source))
        if (
            isinstance(node, ast.Attribute)
            and node.attr == "sleep"
            and isinstance(node.value, ast.Name)
            and node.value.id == "time"
        )
        or (
            isinstance(node, ast.ImportFrom)
            and node.module == "time"
            and any(alias.name in {"sleep", "*"} for alias in node.names)
        )
    ]


def test_the_listing_sees_the_repository() -> None:
    assert {"pyproject.toml", "tests/house/test_text.py", SLEEPS_HERE} <= set(FILES)


def test_no_python_file_is_longer_than_a_person_reads() -> None:
    lengths = {name: len((text(name) or "").splitlines()) for name in PYTHON}
    assert {name: length for name, length in lengths.items() if length > LONGEST_FILE} == {}


def test_only_the_clock_sleeps() -> None:
    found = {name: sleeps(text(name) or "") for name in OURS}
    assert sorted(name for name, lines in found.items() if lines and name != SLEEPS_HERE) == []
    assert found[SLEEPS_HERE], "the rule looks for the wrong thing: the clock does sleep"


def test_no_lock_file_is_committed() -> None:
    assert [name for name in FILES if Path(name).name == "uv.lock"] == []


def test_no_text_names_a_package_host() -> None:
    assert lines_matching(PACKAGE_HOST) == []


def test_no_text_names_a_path_of_one_machine() -> None:
    assert lines_matching(MACHINE_PATH) == []


@pytest.mark.parametrize(("line", "caught"), [
    ("see /" + "work/main/x", True), ("'/" + "tmp/dish'", True), ("~/" + "work/x", False), ("a/" + "work/x", False),
])  # fmt: skip
def test_the_pattern_for_machine_paths_catches_what_it_should(line: str, caught: bool) -> None:
    assert bool(MACHINE_PATH.search(line)) is caught


def test_decisions_are_numbered_without_gaps() -> None:
    names = sorted(path.name for path in (ROOT / "docs/decisions").iterdir())
    assert [name for name in names if not re.fullmatch(r"\d{4}-[a-z0-9]+(?:-[a-z0-9]+)*\.md", name)] == []
    assert [int(name[:4]) for name in names] == list(range(1, len(names) + 1))


def test_each_decision_opens_with_its_number() -> None:
    for path in (ROOT / "docs/decisions").glob("*.md"):
        first = path.read_text(encoding="utf-8").splitlines()[0]
        assert first.startswith(f"# {int(path.name[:4])}. "), f"{path.name} opens with {first!r}"
