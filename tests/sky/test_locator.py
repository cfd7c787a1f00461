"""Maidenhead locators, against the examples that the handbook and every logbook has."""

from __future__ import annotations

import pytest
from birdcage.sky.locator import decode, encode
from hypothesis import given
from hypothesis import strategies as st


@pytest.mark.parametrize(
    ("locator", "latitude_deg", "longitude_deg"),
    [
        ("JO21", 51.5, 5.0),
        ("JN58td", 48.0 + 3.5 / 24, 11.0 + 7.5 / 12),  # Munich: 48.146 N, 11.608 E
        ("FN31pr", 41.0 + 17.5 / 24, -74.0 + 15.5 / 12),  # W1AW, Newington: 41.714 N, 72.728 W
        ("GF15vc", -35.0 + 2.5 / 24, -58.0 + 21.5 / 12),  # Montevideo: 34.91 S, 56.21 W
        ("JO21JV83", 51.875 + 3.5 / 240, 4.75 + 8.5 / 120),
        (" aa00 ", -89.5, -179.0),
        ("RR99XX99", 90.0 - 1 / 480, 180.0 - 1 / 240),
    ],
)
def test_the_middle_of_a_locator(locator, latitude_deg, longitude_deg):
    assert decode(locator)[:2] == (pytest.approx(latitude_deg, abs=1e-9), pytest.approx(longitude_deg, abs=1e-9))


def test_tells_how_far_off_it_may_be():
    assert [decode(text)[2] for text in ("JO21", "JO21jv", "JO21jv83")] == [
        pytest.approx(0.5), pytest.approx(1 / 48), pytest.approx(1 / 480),
    ]  # fmt: skip


@pytest.mark.parametrize("text", ["", "JO", "JO2", "JO21j", "JO21jv8", "SA00", "JO21yv", "2JO1", "JO21jv83aa"])
def test_refuses_what_is_none(text):
    with pytest.raises(ValueError, match="is not a Maidenhead locator"):
        decode(text)


@given(latitude_deg=st.floats(-90.0, 90.0), longitude_deg=st.floats(-180.0, 179.999))
def test_a_place_lies_in_its_locator(latitude_deg, longitude_deg):
    middle = decode(encode(latitude_deg, longitude_deg))
    assert abs(middle[0] - latitude_deg) <= 1 / 48 + 1e-9
    assert abs(middle[1] - longitude_deg) <= 1 / 24 + 1e-9


def test_is_written_as_people_write_it():
    assert encode(41.714, -72.728) == "FN31pr"
    assert encode(90.0, 180.0) == "AR09ax"
