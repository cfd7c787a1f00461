"""Every fault, on every dialect, at every moment that matters: what is seen, done, true, and right again afterwards."""

from __future__ import annotations

from pathlib import Path

import pytest

from .matrix import CELLS, FAULTS, outcome
from .table import HEADER, key, row
from .verdict import verdict

PAGE = (Path(__file__).parents[2] / "docs/faults.md").read_text(encoding="utf-8")
HOW = "docs/faults.md is not what the program does: look at what has changed, then run scripts/fault_table.py"


@pytest.mark.parametrize(("fault", "dialect", "when"), CELLS, ids=lambda each: getattr(each, "name", each))
def test_a_fault(fault, dialect, when):
    seen = outcome(fault, dialect, when)
    assert verdict(fault, dialect, when, seen) == ()
    assert row(fault, dialect, when, seen) in PAGE.splitlines(), HOW


def test_the_page_has_a_row_for_each_cell_and_no_other():
    assert PAGE.startswith(HEADER), HOW
    rows = PAGE.removeprefix(HEADER).splitlines()
    assert len(rows) == len(CELLS), HOW
    assert all(each.startswith(key(*cell)) for each, cell in zip(rows, CELLS, strict=True)), HOW


def test_names_tell_faults_apart():
    assert len({fault.name for fault in FAULTS}) == len({fault.title for fault in FAULTS}) == len(FAULTS)
