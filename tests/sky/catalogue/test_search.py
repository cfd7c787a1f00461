"""What a person finds who types a few letters, and how soon."""

from __future__ import annotations

from datetime import UTC, datetime

import pytest
from birdcage.sky.catalogue import CatalogueEntry, SearchIndex

NOW = datetime(2026, 7, 1, tzinfo=UTC)


@pytest.fixture
def index(sat):
    def entry(name, norad_id, *groups, tags=(), favourite=False, priority=0, designator=""):
        elements = sat(name, norad_id, international_designator=designator)
        return CatalogueEntry(elements, NOW, groups, tags, favourite, priority)

    return SearchIndex(
        [
            entry("NOAA 20 (JPSS-1)", 43013, "weather"),
            entry("NOAA 15", 25338, "weather", "noaa"),
            entry("METEOR-M2 3", 57166, "weather", tags=("LRPT",)),
            entry("ISS (ZARYA)", 25544, "stations", designator="1998-067A"),
            entry("ISS DEB", 999001),
            entry("SWISSCUBE", 35932, "amateur"),
            entry("QO-100 (ES'HAIL 2)", 43700, "geo", favourite=True),
            entry("COSMOS 25544", 77),
            entry("CAPSULE OF NOAA", 78),
            entry("TEVEL-2", 255441),
        ]
    )


def names(index, text, **more):
    return [each.name for each in index.search(text, **more)]


@pytest.mark.parametrize(
    ("typed", "found"),
    [
        ("noaa 15", ["NOAA 15"]),
        ("noaa 1", ["NOAA 15", "NOAA 20 (JPSS-1)"]),
        ("NOAA-20", ["NOAA 20 (JPSS-1)"]),
        ("zarya", ["ISS (ZARYA)"]),
        ("m2", ["METEOR-M2 3"]),
        ("meteorm23", ["METEOR-M2 3"]),
        ("lrpt", ["METEOR-M2 3"]),
        ("1998-067", ["ISS (ZARYA)"]),
        ("00077", ["COSMOS 25544"]),
        ("eshail", ["QO-100 (ES'HAIL 2)"]),
        ("weather jpss", ["NOAA 20 (JPSS-1)"]),
        ("zarya 25544", ["ISS (ZARYA)"]),
        ("nothing like it", []),
    ],
)
def test_one_is_found_by_what_people_type(index, typed, found):
    assert names(index, typed) == found


def test_better_matches_come_first(index):
    assert names(index, "25544") == ["ISS (ZARYA)", "COSMOS 25544", "TEVEL-2"], (
        "number, word of a name, number so begun"
    )
    assert names(index, "iss") == ["ISS (ZARYA)", "ISS DEB", "SWISSCUBE"], (
        "names that begin so before those that hold it"
    )
    assert names(index, "noaa") == ["NOAA 15", "NOAA 20 (JPSS-1)", "CAPSULE OF NOAA"], "the beginning before the middle"
    assert names(index, "weather") == ["METEOR-M2 3", "NOAA 15", "NOAA 20 (JPSS-1)"]


def test_an_empty_text_shows_favourites_first_and_a_limit_counts(index):
    assert names(index, " - ", limit=2) == ["QO-100 (ES'HAIL 2)", "CAPSULE OF NOAA"]
    assert names(index, "iss", limit=1) == ["ISS (ZARYA)"]
    assert names(index, "iss", limit=0) == []
