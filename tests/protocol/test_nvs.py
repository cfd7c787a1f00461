"""The settings memory: values as what they are, and a write that is believed only when the dish shows it."""

from __future__ import annotations

import pytest
from birdcage.base.errors import CommandRefused, NoReply
from birdcage.protocol.nvs import NvsEdit, parse_edit, parse_nvs
from birdcage.rotator.setting_values import same_value, typed

HEAD = (
    "Num  Name                         Current      Saved      Default\n"
    "---- --------------------------  ----------  ----------  ----------\n"
)


@pytest.mark.parametrize(
    ("text", "value"),
    [("TRUE", True), ("FALSE", False), ("0x00000007", 7), ("200", 200), ("+0", 0), ("-3", -3), ("65.00", 65.0),
     ("12-IN", "12-IN"), ("1.2.3", "1.2.3")],
)  # fmt: skip
def test_a_value_is_what_it_is(text, value):
    found = typed(text)
    assert (found, type(found)) == (value, type(value))


@pytest.mark.parametrize(("printed", "given"), [("TRUE", "1"), ("FALSE", "0"), ("TRUE", "true"), ("18.00", "18"),
                                                ("0x00000007", "7"), ("+0", "0"), ("420", "420")])  # fmt: skip
def test_the_same_value_in_two_texts(printed, given):
    assert same_value(printed, given)
    assert not same_value(printed, "3")


def test_rows_of_every_kind():
    rows = parse_nvs(
        (HEAD + "  0) Log ID's                    0x00000007  0x00000007  0x00000007\n"
         " 26) Conical Test Drift                  +0          +0          +0\n"
         "101) Minimum Elevation Angle          18.00       15.00       18.00\n").splitlines()
    )  # fmt: skip
    assert sorted(rows) == [0, 26, 101]
    assert rows[0].name == "Log ID's"
    assert (rows[101].value, rows[101].saved_value, rows[101].default_value) == (18.0, 15.0, 18.0)


def test_the_line_of_an_edit():
    assert parse_edit([" 20) Disable Tracker Proc?           FALSE .       TRUE"]) == NvsEdit(
        20, "Disable Tracker Proc?", "FALSE", "TRUE"
    )
    assert parse_edit([" 20) Disable Tracker Proc?            FALSE       FALSE       FALSE"]) is None


def written(play, edit, saved, shown):
    g2, port = play(
        f"TRK>nvs\nNVS>e 101 15\n101) Minimum Elevation Angle          18.00 .      {edit}\n"
        + (f"NVS>s\n{saved}\n" if saved else "")
        + (f"NVS>d 101\n{HEAD}101) Minimum Elevation Angle          15.00       {shown}       18.00\n" if shown else "")
        + "NVS>\n"
    )
    return lambda: g2.nvs.write_and_save(101, "15"), port


def test_a_write_is_shown_before_it_is_believed(play):
    write, _port = written(play, "15.00", "Flash doneSuccess", "15.00")
    assert write().saved_value == 15.0


@pytest.mark.parametrize(
    ("edit", "saved", "shown"),
    [("1.00", "", ""), ("15.00", "Flash failure", ""), ("15.00", "Flash doneSuccess", "18.00")],
)
def test_a_write_that_went_wrong_is_refused_and_a_wrong_value_never_saved(play, edit, saved, shown):
    write, port = written(play, edit, saved, shown)
    with pytest.raises(CommandRefused) as raised:
        write()
    assert raised.value.reason == "bad_parameter"
    assert (b"\rs\r" in port.written) is bool(saved)


def test_another_row_is_never_saved(play):
    g2, port = play("TRK>nvs\nNVS>e 101 15\n 10) Deadband                         0.00 .      15.00\nNVS>\n")
    with pytest.raises(CommandRefused, match=r"row 10 to 15\.00"):
        g2.nvs.write_and_save(101, "15")
    assert port.written == b"\rnvs\re 101 15\r"


def test_a_hole_is_no_row(play):
    g2, _port = play(f"TRK>nvs\nNVS>d 5\n{HEAD}NVS>\n")
    with pytest.raises(NoReply) as raised:
        g2.nvs.read(5)
    assert raised.value.reason == "no_row"


def test_a_write_in_ram_is_read_back_and_a_value_that_is_not_there_is_refused(play):
    g2, port = play(
        "TRK>nvs\nNVS>e 101 15\n101) Minimum Elevation Angle          18.00 .      15.00\n"
        f"NVS>d 101\n{HEAD}101) Minimum Elevation Angle          18.00       18.00       18.00\nNVS>\n"
    )
    with pytest.raises(CommandRefused, match=r"the dish shows 18\.00 there"):
        g2.nvs.write(101, "15")
    assert b"\rs\r" not in port.written
