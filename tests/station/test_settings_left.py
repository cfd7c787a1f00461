"""Where a row stands, by what was noted before it was written and what the dish shows now."""

from __future__ import annotations

import pytest
from birdcage.rotator.own_settings import RowState, SettingRow
from birdcage.station.settings_left import NotedRow, named, state_of

BEFORE = NotedRow(27, "Circle RPM", "120", "120", "90")
UNTOLD = NotedRow(127, "", "15.00", None, "10.00")


@pytest.mark.parametrize(
    ("noted", "current", "saved", "saving", "state"),
    [
        (BEFORE, "120", "120", False, RowState.UNTOUCHED),
        (BEFORE, "90", "120", False, RowState.IN_RAM),
        (BEFORE, "90", "120", True, RowState.IN_RAM),
        (BEFORE, "90", "90", True, RowState.SAVED),
        (BEFORE, "9", "120", False, RowState.OTHER),
        (BEFORE, "120", "90", True, RowState.OTHER),
        (BEFORE, "90", "7", True, RowState.OTHER),
        (UNTOLD, "15.00", None, True, RowState.UNTOUCHED),
        (UNTOLD, "10.00", None, False, RowState.IN_RAM),
        (UNTOLD, "10.00", None, True, RowState.UNTOLD),
        (UNTOLD, "1.00", None, False, RowState.OTHER),
    ],
)
def test_the_state_of_a_row(noted, current, saved, saving, state):
    assert state_of(noted, SettingRow(noted.index, noted.name, current, saved, None), saving=saving) is state


def test_a_row_that_is_not_shown_any_more_is_not_called_untouched():
    assert state_of(BEFORE, None, saving=False) is RowState.OTHER


def test_rows_are_named_as_a_person_would():
    assert [named([1]), named([1, 2]), named([1, 2, 3])] == ["Row 1 is", "Rows 1 and 2 are", "Rows 1, 2 and 3 are"]
