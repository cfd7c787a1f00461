"""What the list leaves to the night exists, and the night takes all of it."""

from __future__ import annotations

import ast
from types import SimpleNamespace

import pytest
from night import LIST, leave_to_the_night, listed

from tests.house.pages import ROOT


def functions_in(path):
    tree = ast.parse((ROOT / path).read_text(encoding="utf-8"))
    return {node.name for node in ast.walk(tree) if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef)}


def test_each_line_names_a_test():
    named = dict[str, set[str]]()
    for test in listed():
        path, _, name = test.partition("::")
        named.setdefault(path, set()).add(name.rpartition("::")[2])
    assert {path: names - functions_in(path) for path, names in named.items() if names - functions_in(path)} == {}


def test_no_test_is_named_twice():
    lines = [line.split()[0] for line in LIST.read_text(encoding="utf-8").splitlines() if line and line[0] != "#"]
    assert lines == sorted(set(lines))


@pytest.mark.parametrize(
    ("keep", "left"), [("", [0, 1, 2, 3, 4]), (" 1", [1, 2, 3, 4]), (" 2", [1, 2, 3]), (" 3", [1, 3]), (" 9", [])]
)
def test_the_cases_that_stay_lie_evenly(tmp_path, monkeypatch, keep, left):
    (tmp_path / "list.txt").write_text(f"# why\n\nhere.py::test_it{keep}\n", encoding="utf-8")
    monkeypatch.setattr("night.LIST", tmp_path / "list.txt")
    marks = {f"here.py::test_it[{case}]": [] for case in range(5)} | {"here.py::test_it_too": []}
    leave_to_the_night([SimpleNamespace(nodeid=name, add_marker=some.append) for name, some in marks.items()])
    assert [int(name[-2]) for name, some in marks.items() if some] == left
    assert all(some in ([], [pytest.mark.soak, pytest.mark.night]) for some in marks.values())
