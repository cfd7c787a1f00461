"""Moments as people type them."""

from datetime import UTC, datetime

import pytest
from birdcage_tui.passes.time_text import moment_of

SHOWN = datetime(2026, 11, 21, 20, 15, tzinfo=UTC)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("21:30", "2026-11-21T21:30:00"),
        (" 20:15 ", "2026-11-21T20:15:00"),
        ("04:10", "2026-11-22T04:10:00"),
        ("4:10:30z", "2026-11-22T04:10:30"),
        ("+1h30", "2026-11-21T21:45:00"),
        ("+90", "2026-11-21T21:45:00"),
        ("-20m", "2026-11-21T19:55:00"),
        ("+ 1d 2h", "2026-11-22T22:15:00"),
        ("2026-11-22 04:10", "2026-11-22T04:10:00"),
        ("2026-11-22T04:10+02:00", "2026-11-22T02:10:00"),
    ],
)
def test_a_typed_moment_is_understood(text, expected):
    assert moment_of(text, SHOWN) == datetime.fromisoformat(expected).replace(tzinfo=UTC)


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("", "Type 21:30"),
        ("noon", "Type 21:30"),
        ("+", "Type 21:30"),
        ("25:00", "^Type a time from 00:00 to 23:59\\.$"),
        ("12:61", "^Type a time from 00:00 to 23:59\\.$"),
        ("2026-11-22", "Which time of that day"),
        ("2026-13-22 04:10", "Type 21:30"),
        ("+99999999999h", "more than a year"),
    ],
)
def test_anything_else_is_answered_with_what_to_type(text, says):
    with pytest.raises(ValueError, match=says):
        moment_of(text, SHOWN)
