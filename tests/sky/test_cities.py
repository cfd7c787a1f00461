"""The list of cities: found as people type them, and never the wrong one of two."""

from __future__ import annotations

import pytest
from birdcage.sky.cities import City, find_city, search_cities


def names(text, limit=10):
    return [city.name for city in search_cities(text, limit)]


@pytest.mark.parametrize(
    ("typed", "name", "country"),
    [
        ("Köln", "Köln", "DE"), ("koln", "Köln", "DE"), ("sao paulo", "São Paulo", "BR"), ("wien", "Vienna", "AT"),
        ("MUNCHEN", "Munich", "DE"), ("københavn", "Copenhagen", "DK"), ("Łódź", "Łódź", "PL"), ("lodz", "Łódź", "PL"),
        ("andorra la vella", "Andorra la Vella", "AD"), ("Wichita, us", "Wichita", "US"),
    ],
)  # fmt: skip
def test_accents_capitals_and_second_names(typed, name, country):
    city = find_city(typed)
    assert (city.name, city.country) == (name, country)


def test_where_it_is():
    city = find_city("rotterdam")
    assert (city.latitude_deg, city.longitude_deg) == (pytest.approx(51.92, abs=0.02), pytest.approx(4.48, abs=0.02))


def test_whole_names_come_first_then_beginnings_then_later_words():
    found = names("york", 50)
    assert found[0] == "York"
    assert found.index("New York City") > found.index("York")
    assert names("toky")[0] == "Tokyo"


def test_several_are_a_question():
    with pytest.raises(ValueError, match=r"Which one\? .*Springfield, US-MO") as wrong:
        find_city("springfield")
    assert "Springfield, US-IL" in str(wrong.value)
    assert find_city("springfield, us-mo").region == "MO"
    with pytest.raises(ValueError, match=r"Birmingham, GB .*Birmingham, US"):
        find_city("birmingham")
    assert find_city("birmingham, gb").latitude_deg > 50


@pytest.mark.parametrize("typed", ["", "  ", ", us", "xyzzy", "paris, xx"])
def test_none(typed):
    assert search_cities(typed) == ()
    with pytest.raises(ValueError, match="No city"):
        find_city(typed)


def test_every_capital_of_a_large_country_and_every_row_is_a_place():
    everywhere = {city for letter in "abcdefghijklmnopqrstuvwxyz" for city in search_cities(letter, 100_000)}
    assert len(everywhere) > 6000
    assert all(isinstance(city, City) and abs(city.latitude_deg) <= 90 for city in everywhere)
    capitals = {"Canberra", "Ottawa", "Brasília", "Bern", "Reykjavík", "Wellington", "Valletta", "Vaduz"}
    assert capitals <= {city.name for city in everywhere}
