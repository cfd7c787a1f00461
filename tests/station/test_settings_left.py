"""Where a row stands, by what was noted before it was written and what the dish shows now."""

from __future__ import annotations

from dataclasses import replace
from datetime import UTC, datetime

import pytest
from birdcage.rotator.own_settings import RowState, SettingRow, SettingsTable
from birdcage.station.settings_left import NotedRow, NotedWrite, is_settled, left_by, named, state_of

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


def noted(*rows, saving=True):
    return NotedWrite("hal205", datetime(2026, 11, 27, 21, 40, tzinfo=UTC), "you", "backup.txt", rows, saving)


def shown(*values):
    rows = {index: SettingRow(index, "", current, saved, None) for index, current, saved in values}
    return SettingsTable((), rows)


def test_a_save_that_was_interrupted_is_not_forgotten_by_the_next_write():
    after = noted(UNTOLD).with_rows((NotedRow(127, "", "10.00", None, "12.00"),))
    left = left_by(after, shown((127, "12.00", None)))
    assert [(row.before, row.wanted, row.state) for row in left.rows] == [("15.00", "12.00", RowState.UNTOLD)]
    assert "does not tell what flash holds" in " ".join(left.sentences)


def test_a_row_that_was_written_back_after_such_a_save_may_differ_in_flash():
    back = noted(UNTOLD).with_rows((NotedRow(127, "", "10.00", None, "15.00"),))
    assert [row.state for row in left_by(back, shown((127, "15.00", None))).rows] == [RowState.UNTOLD]
    again = back.with_rows((NotedRow(127, "", "15.00", None, "12.00"),))  # cut short before the dish took it
    assert [row.state for row in left_by(again, shown((127, "15.00", None))).rows] == [RowState.UNTOLD]
    unsaved = noted(UNTOLD, saving=False).with_rows((NotedRow(127, "", "10.00", None, "15.00"),))
    assert [row.state for row in left_by(unsaved, shown((127, "15.00", None))).rows] == [RowState.UNTOUCHED]


def test_a_write_that_never_came_does_not_settle_such_a_save():
    after = noted().with_rows((NotedRow(127, "", "10.00", None, "12.00"),))
    left = left_by(after, shown((127, "10.00", None)))
    assert [row.state for row in left.rows] == [RowState.UNTOLD]
    assert left.sentences[0].startswith("Row 127 is not known to be saved. A save was interrupted")
    assert not is_settled(left, saving=after.saving)


def test_a_save_without_a_noted_row_that_was_interrupted_is_told_until_another():
    left = left_by(noted(), shown((127, "10.00", None)))
    assert not is_settled(left, saving=True)
    assert "A save was interrupted" in left.sentences[0]
    assert left.sentences[-1] == "Backup: backup.txt"
    assert is_settled(left_by(noted(saving=False), shown()), saving=False)


@pytest.mark.parametrize(("current", "saved"), [("120", "90"), ("90", "7")])
def test_a_row_of_another_state_is_told_as_it_was_and_as_it_was_to_be(current, saved):
    (said,) = left_by(replace(noted(BEFORE), backup=None), shown((27, current, saved))).sentences
    assert said == (
        f"Row 27 holds {current} in RAM. It was 120 and was to be 90. Flash holds {saved}, and held 120. "
        "`birdcage nvs restore` puts the backup back."
    )
