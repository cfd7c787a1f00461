"""Values, files and differences of the settings that machines keep themselves: what is misread is no row."""

from __future__ import annotations

from datetime import UTC, datetime

import pytest
from birdcage.base.errors import CommandRefused, OutOfRange, StoreError
from birdcage.rotator import machines
from birdcage.rotator.own_settings import SettingRow, SettingsTable
from birdcage.rotator.setting_values import given_value
from birdcage.rotator.settings_compare import differences, is_saved, lines_of_no_row, restoring, saved_after
from birdcage.rotator.settings_file import SettingsDump, read_settings_text, settings_text
from hypothesis import given
from hypothesis import strategies as st

PRINTED = (
    "Num  Name",
    "# no head of ours",
    " 27) Circle RPM                         90          90         120",
    "",
    "  x",
)
LINES = st.lists(st.text(st.characters(min_codepoint=32, max_codepoint=126), max_size=80), min_size=1, max_size=20)


def of(firmware):
    return machines.make(firmware).own_settings


@given(LINES, st.booleans())
def test_a_file_gives_back_each_line_that_was_printed(printed, demo):
    text = settings_text("Carryout G2", "g2", datetime(2026, 11, 27, tzinfo=UTC), printed, demo=demo)
    dump = read_settings_text(text.encode(), "it")
    assert (dump.printed, dump.firmware, dump.demo) == (tuple(printed), "g2", demo)


def test_older_backups_and_files_of_other_systems_are_read():
    assert read_settings_text(b"# DEMO\nNum\n 1) x\n", "it").printed == ("Num", " 1) x")
    assert read_settings_text(b"# DEMO\nNum\n", "it").demo
    text = settings_text("Carryout G2", "g2", datetime(2026, 11, 27, tzinfo=UTC), PRINTED, demo=False)
    windows = b"\xef\xbb\xbf" + text.replace("\n", "\r\n").encode()
    assert read_settings_text(windows, "it").printed == PRINTED


@given(st.binary(max_size=200))
def test_any_bytes_are_a_dump_or_refused(data):
    try:
        dump = read_settings_text(data, "it")
    except StoreError:
        return
    assert all(line.isprintable() for line in dump.printed)
    for firmware in ("g2", "hal205", "carryout"):
        of(firmware).parse(dump.printed)


@pytest.mark.parametrize(
    "line",
    [
        "142) Serial                     ODU 4711 A",
        "143] Calibration date             2026-02-12  2026-02-12",
        "144) A name that is far longer than its column           7           7           7",
        " 27) Circle RPM                         90          90",
        " 27) Circle RPM                       TRUE          90         120",
    ],
)
def test_a_line_of_another_form_is_no_row_of_a_g2(line):
    assert of("g2").parse([line]) == {}
    assert lines_of_no_row((line,), {}) == (line,)


def test_a_row_that_is_printed_twice_is_none():
    row = " 27) Circle RPM                         90          90         120"
    assert set(of("g2").parse([row])) == {27}
    assert of("g2").parse([row, row.replace("90", "95")]) == {}


@pytest.mark.parametrize(
    ("line", "row"),
    [
        ("127) Safe Minimum EL               15.00", SettingRow(127, "Safe Minimum EL", "15.00", None, None)),
        ("127  15", SettingRow(127, "", "15", None, None)),
        ("127) Safe Minimum EL  15.00  15.00  15.00", SettingRow(127, "Safe Minimum EL", "15.00", None, None)),
    ],
)
def test_rows_of_a_trav_ler(line, row):
    assert of("hal205").parse([line, " 40) GPS                  1"]) == {127: row}


def test_values_take_the_form_of_the_present_one():
    def given_for(current, text):
        return given_value(SettingRow(1, "x", current, current, current), None, text)

    assert [given_for("FALSE", each) for each in ("on", "TRUE", "1", "yes")] == ["TRUE"] * 4
    assert given_for("65.00", "12") == "12.00"
    assert given_for("0x00000007", "255") == "0x000000FF"
    assert given_for("+0", "7") == "+7"
    assert given_for("12-IN", "10-IN") == "10-IN"


def test_a_row_differs_by_what_counts_now_and_from_the_next_power_cycle():
    one = {1: SettingRow(1, "x", "5", "5", "5"), 2: SettingRow(2, "y", "6", "6", "6")}
    other = {1: SettingRow(1, "x", "7", "5", "5"), 3: SettingRow(3, "z", "8", "8", "8")}
    found = [(each.index, each.first, each.second) for each in differences(one, other)]
    assert found == [(1, "5", "7 in RAM, 5 saved"), (2, "6", None), (3, None, "8")]
    assert not is_saved(one, SettingsTable((), {1: one[1]}))
    assert is_saved({1: one[1]}, SettingsTable((), {1: other[1]}))


ELEVATION = SettingRow(101, "Minimum Elevation Angle", "95.00", "95.00", "18.00")


def restored(rows, table_rows, *, demo=False, dump=None):
    table, own = SettingsTable((), {row.index: row for row in table_rows}), of("g2")
    dump = dump or SettingsDump((), firmware="g2")
    return restoring(dump, {row.index: row for row in rows}, table, "g2", own.known, "a.txt", demo=demo)


def test_a_dump_of_a_simulated_dish_goes_into_a_simulated_one_alone():
    dump = SettingsDump((), firmware="g2", demo=True)
    with pytest.raises(CommandRefused, match=r"a\.txt is of a simulated dish\. Nothing was sent"):
        restored([ELEVATION], [ELEVATION], dump=dump)
    assert restored([ELEVATION], [ELEVATION], dump=dump, demo=True) == {}


def test_a_row_that_need_not_be_written_is_not_judged():
    assert restored([ELEVATION], [ELEVATION]) == {}
    with pytest.raises(OutOfRange, match="beyond its limit"):
        restored([ELEVATION], [SettingRow(101, ELEVATION.name, "18.00", "18.00", "18.00")])


def test_one_value_in_two_forms_is_not_unsaved():
    rows = {1: SettingRow(1, "x", "18.00", "18", "5"), 2: SettingRow(2, "y", "6", "7", "6")}
    table = SettingsTable((), rows)
    assert [row.index for row in table.unsaved] == [2]
    assert table.to_save == {2: "6"}
    assert SettingsTable((), {1: SettingRow(1, "x", "5", None, None)}).to_save == {1: "5"}, "flash is not told"


def test_what_a_save_keeps_after_a_write_is_known_before():
    rows = {each: SettingRow(each, "x", "5", saved, "5") for each, saved in ((1, "5"), (2, "6"), (3, "7"))}
    assert saved_after(SettingsTable((), rows), {1: "8", 2: "6"}) == {1: "8", 3: "5"}
