"""What HAL consoles print, and what must never pass for an angle."""

from __future__ import annotations

import pytest
from birdcage.base.errors import NoReply, PositionUnknown
from birdcage.protocol.hal.answers import parse_position, parse_setting
from birdcage.rotator.values import Position


@pytest.mark.parametrize(
    ("lines", "position"),
    [
        (["AZ =   8.34", "EL =  34.33", "SK =   0.00", "WRAP = 455.00"], Position(8.34, 34.33, 0.0)),
        (["AZ = 180.00 EL = 45.00 SK = 90.00"], Position(180.0, 45.0, 90.0)),
        (["AZ =  -0.50", "EL = +15.00"], Position(-0.5, 15.0, None)),
        (["AZ = 455.00 EL = 45.0"], Position(455.0, 45.0, None)),
    ],
)
def test_positions(lines, position):
    assert parse_position(lines) == position


@pytest.mark.parametrize(
    "lines",
    [
        [],
        ["AZ =   8.34"],
        ["AZ =   834", "EL =  34.33"],
        ["AZ =   8.34", "EL =  3433.00"],
        ["AZ =8.34", "EL =  34.33"],
        ["AZ =   8.34.1", "EL =  34.33"],
        ["AZ =   nan", "EL =  34.33"],
        ["AZ =   8.34", "EL =  34.33", "SK =   9999.00"],
        ("AZ = 175.2", "5", "EL =  47.10", "SK =  90.00"),
        ("AZ = 175.25 EL =  4 7.10",),
        ("AZ = 175.25", "EL =  47.1 *0"),
    ],
)
def test_what_is_no_angle_is_never_a_position(lines):
    with pytest.raises(NoReply) as caught:
        parse_position(lines)
    assert caught.value.reason == "garbage"


@pytest.mark.parametrize("number", ["2147483647", "2147483647.00", "21474836.47", "-2147483648"])
def test_an_axis_that_does_not_know_where_it_is(number):
    with pytest.raises(PositionUnknown) as caught:
        parse_position([f"AZ =   {number}", "EL =  34.33"])
    assert caught.value.reason == "unhomed"


@pytest.mark.parametrize(
    ("lines", "value"),
    [
        (["127) Safe Minimum EL                  15.00"], "15.00"),
        (["127) Safe Minimum EL      0       15       15"], "0"),
        (["e 127 = 12"], "12"),
        (["127 = 12.5"], "12.5"),
        (["15"], "15"),
        (["Safe Minimum EL: 15.00"], "15.00"),
        (["no such index"], None),
        ([], None),
    ],
)
def test_settings_are_read_in_any_layout(lines, value):
    assert parse_setting(127, lines) == value
