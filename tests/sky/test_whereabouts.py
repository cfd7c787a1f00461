"""What people type for a place."""

from __future__ import annotations

import pytest
from birdcage.sky.whereabouts import parse_place


@pytest.mark.parametrize(
    ("typed", "expected"),
    [
        ("51.9 4.8", (51.9, 4.8, 0.0)), ("51.9, 4.8, 12", (51.9, 4.8, 12.0)), ("-33.5 151.25", (-33.5, 151.25, 0.0)),
        ("33.5S 151.25E", (-33.5, 151.25, 0.0)), ("51.9°N, 4.8° W", (51.9, -4.8, 0.0)), ("51.9/4.8", (51.9, 4.8, 0.0)),
        ("33.5 s, 151.25 e, 640", (-33.5, 151.25, 640.0)), ("JO21jv", (51.895833, 4.791667, 0.0)),
        ("Rotterdam", (51.92, 4.48, 0.0)),
    ],
)  # fmt: skip
def test_a_place(typed, expected):
    found = parse_place(typed)
    assert (found.latitude_deg, found.longitude_deg, found.height_m) == pytest.approx(expected, abs=0.01)


@pytest.mark.parametrize(
    ("typed", "says"),
    [
        ("", "Type latitude"), ("51.9", "is not a latitude and longitude"), ("1 2 3 4", "is not a latitude"),
        ("4.8E 51.9N", "latitude comes first"), ("95 4", "no place on Earth"), ("JO21", "2° wide"), ("5x 3", "is no"),
        ("ZZ99", "not a Maidenhead locator"),
        ("springfield", "Which one"), ("nowhere at all", "No city"),
    ],
)  # fmt: skip
def test_what_is_none(typed, says):
    with pytest.raises(ValueError, match=says):
        parse_place(typed)
