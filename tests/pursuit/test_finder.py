"""What a person finds who types."""

from __future__ import annotations

from dataclasses import replace
from datetime import UTC, datetime

import pytest
from birdcage.pursuit.finder import Finder
from birdcage.sky.catalogue import Catalogue
from birdcage.sky.demo_orbits import demo_orbits
from birdcage.sky.observer import Observer

NOW = datetime(2026, 11, 21, 12, tzinfo=UTC)
ORBITS = demo_orbits(NOW, Observer(50.0, 10.0))


@pytest.fixture
def path(tmp_path):
    path = tmp_path / "catalogue.sqlite"
    with Catalogue(path) as catalogue:
        catalogue.add(ORBITS)
        catalogue.set_favourite(ORBITS[3].norad_id)
        catalogue.set_favourite(ORBITS[1].norad_id)
        catalogue.set_priority(ORBITS[1].norad_id, 5)
    return path


@pytest.fixture
def finder(path):
    finder = Finder(path)
    finder.refresh()
    return finder


def names(found):
    return [each.name for each in found]


def test_with_nothing_typed_there_are_favourites_first_and_then_bodies(finder):
    found, _ = finder.search("", NOW)
    assert names(found)[:4] == [ORBITS[1].name, ORBITS[3].name, "Sun", "Moon"]
    assert [each.favourite for each in found[:3]] == [True, True, False]


@pytest.mark.parametrize(("typed", "first", "kind"), [
    ("leo 2", "DEMO LEO 2 station", "satellite"), (str(ORBITS[5].norad_id), ORBITS[5].name, "satellite"),
    ("mo", "Moon", "body"), ("28.2e", "28.2°E", "slot"), ("az 180 el 45", "az 180.00° el 45.00°", "fixed"),
    ("ra=5h34m,dec=+22d", "RA 83.5000° Dec +22.0000°", "star"), ("qo-100", "25.9°E", "slot"),
])  # fmt: skip
def test_what_is_typed_is_found_and_can_be_chosen(finder, typed, first, kind):
    found = finder.search(typed, NOW)[0][0]
    assert found.name.startswith(first)
    assert found.kind == kind
    assert finder.resolve(found.text).target.kind == kind


def test_every_row_can_be_chosen(finder):
    for typed in ("", "leo", "m", "ast", "demo geo", "e"):
        for found in finder.search(typed, NOW)[0]:
            assert finder.resolve(found.text).target.kind == found.kind, found


def test_nothing_is_nothing(finder):
    found, said = finder.search("no such thing", NOW)
    assert found == ()
    assert said.startswith("No target is called")
    assert finder.resolve("no such thing").problem == said


def test_it_reads_anew_only_after_a_change(finder, path):
    assert not finder.refresh()
    with Catalogue(path) as catalogue:
        catalogue.set_favourite(ORBITS[7].norad_id)
    assert finder.refresh()
    assert ORBITS[7].name in names(finder.favourites)
    assert not finder.refresh()


def test_an_empty_catalogue_gives_what_ships_and_makes_no_file(tmp_path):
    finder = Finder(tmp_path / "none.sqlite")
    finder.refresh()
    assert finder.search("iss", NOW)[0][0].detail.endswith("frozen elements")
    assert not (tmp_path / "none.sqlite").exists()


def test_other_names_are_found_and_what_is_silent_or_absent_says_so(path):
    with Catalogue(path) as catalogue:
        catalogue.add([named("NOAA 19", 33591), named("NOAA 20 (JPSS-1)", 43013), named("RADFXSAT (FOX-1B)", 43017),
                       named("FUNCUBE-1 (AO-73)", 39444)])  # fmt: skip
    finder = Finder(path)
    finder.refresh()
    assert names(finder.search("ao-91", NOW)[0])[0] == "RADFXSAT (FOX-1B)"
    found, _ = finder.search("noaa", NOW)
    assert names(found)[:2] == ["NOAA 20 (JPSS-1)", "NOAA 19"], "what is silent comes last"
    assert found[1].detail == "silent since 2025-08 · 33591"
    found, said = finder.search("ao-7", NOW)
    assert "AO-7 (7530) is not among your" in said, "and AO-73 is not taken for it"
    assert "`birdcage elements update`" in said
    assert "silent since 2025-06-06" in finder.search("noaa 18", NOW)[1]


def test_a_slot_that_never_rises_says_so_where_the_place_is_known(finder):
    assert finder.search("dish 119", NOW, Observer(52.0, 4.4))[0][0].detail == "never rises here"
    assert finder.search("dish 119", NOW, Observer(39.1, -95.7))[0][0].detail == "geostationary"


def named(name, norad_id):
    return replace(ORBITS[0], name=name, norad_id=norad_id)
