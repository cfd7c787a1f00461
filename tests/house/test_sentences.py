"""What a program tests is a value, never a sentence: no comparison takes a text that is made for people."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
FOR_PEOPLE = {
    "activity_text", "damage", "detail", "meaning", "position_text", "problem", "remedy", "sentence", "why",
}  # fmt: skip
"""Fields that hold sentences. Whether one is empty may be asked; what it says may not."""
METHODS = {"startswith", "endswith", "find", "index", "count"}
ALLOWED = {
    "driver/src/birdcage/link/trouble.py": "the serial library tells a refused connection by its words alone",
    "tui/src/birdcage_tui/feeds/track_feed.py": "one fixed sentence of the desk is put in the words of the app's keys",
    "tui/src/birdcage_tui/shown/unready.py": "the remedy of a check of elements is a command line, not a sentence",
}


def told(node: ast.expr) -> bool:
    """Return whether an expression is a sentence: such a field, or the text of an error."""
    if isinstance(node, ast.Attribute):
        return node.attr in FOR_PEOPLE
    is_text = isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id == "str"
    return is_text and any(isinstance(arg, ast.Name) and arg.id in ("error", "refused", "silence") for arg in node.args)


def says(node: ast.expr) -> bool:
    """Return whether an expression is words to compare with, and not emptiness."""
    if isinstance(node, ast.Constant):
        return isinstance(node.value, str) and node.value != ""
    if isinstance(node, ast.Tuple | ast.Set | ast.List):
        return any(says(element) for element in node.elts)
    return (
        isinstance(node, ast.Name | ast.Attribute) and (getattr(node, "id", "") or getattr(node, "attr", "")).isupper()
    )


def parsed(source: str) -> Iterator[int]:
    """Yield the lines that look into a sentence."""
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Compare):
            sides = [node.left, *node.comparators]
            if any(map(told, sides)) and any(map(says, sides)):
                yield node.lineno
        elif (
            isinstance(node, ast.Call)
            and isinstance(node.func, ast.Attribute)
            and node.func.attr in METHODS
            and told(node.func.value)
        ):
            yield node.lineno


@pytest.mark.parametrize("line", [
    'fault.meaning == "stalled"', '"timed out" in str(error)',
    'state.activity_text == BUSY', 'held.why.startswith("s")',
])  # fmt: skip
def test_a_look_into_a_sentence_is_found(line):
    assert list(parsed(line)) == [1]


@pytest.mark.parametrize("line", ['if held.why == "": pass', "if state.position_text: pass", "say(str(error))"])
def test_whether_there_is_one_may_be_asked(line):
    assert not list(parsed(line))


def test_no_program_of_ours_looks_into_a_sentence():
    found = {}
    for room in ("driver/src", "tui/src"):
        for path in (ROOT / room).rglob("*.py"):
            name = str(path.relative_to(ROOT))
            if (lines := list(parsed(path.read_text(encoding="utf-8")))) and name not in ALLOWED:
                found[name] = lines
    assert found == {}
