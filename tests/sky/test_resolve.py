"""Names that amateurs type, and what each means: one table for every field and command."""

from __future__ import annotations

from dataclasses import replace
from datetime import UTC, datetime

import pytest
from birdcage.sky.catalogue import CatalogueEntry, SearchIndex
from birdcage.sky.downlinks import Downlink
from birdcage.sky.downlinks_read import shipped
from birdcage.sky.elements import ElementSet
from birdcage.sky.observer import Observer
from birdcage.sky.targets import Resolver
from birdcage.sky.targets.sight import below_words, next_rise

NOW = datetime(2026, 11, 21, 15, 0, tzinfo=UTC)
HERE, TOPEKA = Observer(52.0, 4.4, 10.0), Observer(39.1, -95.7)


def orbit(name, norad_id, mean_motion=15.5, inclination_deg=51.6):
    return ElementSet(name, norad_id, NOW, inclination_deg, 10.0, 0.001, 20.0, 30.0, mean_motion)


LIST = (
    orbit("ISS (ZARYA)", 25544), orbit("ISS (NAUKA)", 49044), orbit("METEOR-M2 3", 57166), orbit("METEOR-M2 4", 59051),
    orbit("RADFXSAT (FOX-1B)", 43017), orbit("FUNCUBE-1 (AO-73)", 39444), orbit("NOAA 19", 33591),
    orbit("NOAA 20 (JPSS-1)", 43013), orbit("SUNSAT", 25636), orbit("PROCYON", 40322),
    orbit("ES'HAIL 2", 43700, 1.0027, 0.01),
)  # fmt: skip


def resolver(*more, without=()):
    entries = (each for each in (*LIST, *more) if each.norad_id not in without)
    return Resolver(SearchIndex(CatalogueEntry(each, NOW) for each in entries))


@pytest.mark.parametrize(
    ("typed", "name"),
    [
        ("iss", "ISS (ZARYA)"),
        ("ISS", "ISS (ZARYA)"),
        ("zarya", "ISS (ZARYA)"),
        ("nauka", "ISS (NAUKA)"),
        ("25544", "ISS (ZARYA)"),
        ("025544", "ISS (ZARYA)"),
        ("AO-91", "RADFXSAT (FOX-1B)"),
        ("ao91", "RADFXSAT (FOX-1B)"),
        ("fox 1b", "RADFXSAT (FOX-1B)"),
        ("ao-73", "FUNCUBE-1 (AO-73)"),
        ("METEOR-M N2-3", "METEOR-M2 3"),
        ("meteor m2-4", "METEOR-M2 4"),
        ("noaa 19", "NOAA 19"),
        ("noaa20", "NOAA 20 (JPSS-1)"),
        ("QO-100", "25.9°E QO-100"),
        ("oscar 100", "25.9°E QO-100"),
        ("goes east", "75.2°W GOES 19"),
        ("28.2E", "28.2°E Astra 28"),
        ("E28.2", "28.2°E Astra 28"),
        ("28.2 east", "28.2°E Astra 28"),
        ("East 28.2", "28.2°E Astra 28"),
        ("28,2° E", "28.2°E Astra 28"),
        ("110W", "110°W EchoStar 10"),
        ("w110", "110°W EchoStar 10"),
        ("W 110", "110°W EchoStar 10"),
        ("dish 119", "119°W EchoStar 14"),
        ("DISH119W", "119°W EchoStar 14"),
        ("dish 61", "61.5°W EchoStar 16"),
        ("directv 101", "101°W DIRECTV 101"),
        ("bell 91", "91°W Nimiq 6"),
        ("polaris", "Polaris"),
        ("north star", "Polaris"),
        ("cas a", "Cas A"),
        ("CasA", "Cas A"),
        ("Cassiopeia A", "Cas A"),
        ("crab", "Tau A"),
        ("sgr a*", "Sgr A*"),
        ("sun", "Sun"),
        ("Moon", "Moon"),
        ("jupiter", "Jupiter"),
        ("180,45", "az 180.00° el 45.00°"),
        ("180,5 45", "az 180.50° el 45.00°"),
        ("180/45", "az 180.00° el 45.00°"),
        ("az=180 el=45", "az 180.00° el 45.00°"),
        ("az 180 el -3", "az 180.00° el -3.00°"),
        ("S 40", "az 180.00° el 40.00°"),
        ("ra=5h34m,dec=+22d", "RA 83.5000° Dec +22.0000°"),
    ],
)
def test_what_is_meant(typed, name):
    found = resolver().resolve(typed)
    assert found.problem == ""
    assert (found.target.name, found.exact, found.reason) == (name, True, None)


@pytest.mark.parametrize(
    ("typed", "reason", "told"),
    [
        ("meteor", "ambiguous", "METEOR-M2 3 (57166), METEOR-M2 4 (59051)"),
        ("procyon", "ambiguous", "PROCYON (40322), Procyon"),
        ("E 40", "angle", "E 40 may be a direction or a place on the arc: type az 90 el 40, or 40E."),
        ("ao-7", "absent", "AO-7 (7530) is not among your 11 satellites. `birdcage elements update`"),
        ("noaa 18", "absent", "NOAA 18 has been silent since 2025-06-06 (source: NOAA, scijinks.gov). It is not among"),
        ("25545", "absent", "Number 25545 is not among your 11 satellites"),
        ("119", "absent", "For a place on the arc type 119E or 119W, for a direction 119 45."),
        ("iridium 33", "absent", "iridium 33 is not among your 11"),
        ("polairs", "unknown", "No target is called 'polairs'. Did you mean Polaris?"),
        ("moom", "unknown", "Did you mean Moon?"),
        ("metoer-m2 4", "unknown", "METEOR-M2 4"),
        ("fox 1bb", "unknown", "FOX-1B"),
        ("xyzzy", "unknown", "Type a satellite's name or number"),
        ("dish 100", "angle", "No slot of DISH is known at 100. Known: 129W, 119W, 110W, 72.7W, 61.5W."),
        ("+5 -2", "angle", "counts from where the dish points"),
        ("az=180", "angle", "Type both"),
        ("180 95", "angle", "elevation is -90 to 90"),
        ("200E", "angle", "200E is not a longitude"),
        ("", "unknown", "No target was named"),
    ],
)
def test_why_nothing_is_meant_and_what_to_do(typed, reason, told):
    found = resolver().resolve(typed)
    assert found.found is None
    assert found.reason == reason
    assert told in found.problem, found.problem


def test_another_satellite_is_never_taken_for_one_that_is_absent():
    found = resolver(without=(25544,)).resolve("iss")
    assert (found.found, found.reason) == (None, "absent")
    assert "ISS (25544) is not among your 10" in found.problem
    assert [each.text for each in found.candidates] == ["49044"]


def test_a_silent_one_is_taken_by_its_whole_name_only_and_says_so():
    found = resolver().resolve("NOAA 19")
    assert found.note == "NOAA 19 has been silent since 2025-08-13 (source: NOAA, scijinks.gov)."
    assert found.silent_since == "2025-08-13"
    part = resolver(without=(43013,)).resolve("noaa")
    assert (part.found, part.reason) == (None, "silent")
    assert part.problem.startswith("Only NOAA 19 has 'noaa' in its name. NOAA 19 has been silent since 2025-08-13")
    assert part.problem.endswith("Type 33591 to choose it all the same.")


def test_of_several_the_silent_ones_come_last_and_say_so():
    found = resolver().resolve("noaa")
    assert found.reason == "ambiguous"
    assert "NOAA 20 (JPSS-1) (43013), NOAA 19 (33591, silent since 2025-08-13)" in found.problem


def test_what_the_user_says_of_a_satellite_counts():
    own = (
        Downlink("NOAA 19", 137e6, 137e6, "", None, True, "heard it", "2026", norad_id=33591, own=True),
        Downlink("MY BIRD", 437e6, 437e6, "", None, True, "mine", "2026", norad_id=59051, names=("PIGEON",), own=True),
    )
    mine = Resolver(SearchIndex(CatalogueEntry(each, NOW) for each in LIST), (*own, *shipped()))
    assert mine.resolve("noaa 19").note == ""
    assert mine.resolve("pigeon").target.name == "METEOR-M2 4"


def test_a_place_that_was_given_up_says_so():
    assert resolver().resolve("129W").note == "Nothing is known to send from 129°W any more."


@pytest.mark.parametrize(
    ("typed", "place", "told"),
    [
        ("dish 119", HERE, "119°W EchoStar 14 is 27.5° below the horizon and never rises here."),
        ("dish 119", TOPEKA, ""),
        ("sun", HERE, ""),
        ("moon", HERE, ""),
        ("az 180 el -3", HERE, ""),
        ("canopus", HERE, "below the horizon and does not rise here within 24 hours."),
        ("sun", replace(HERE, longitude_deg=-175.0), "below the horizon. It rises at 19:"),
    ],
)
def test_what_is_below_the_horizon_says_when_it_rises(typed, place, told):
    words = below_words(resolver().resolve(typed).target, place, NOW)
    assert told in words
    assert bool(told) == bool(words)


@pytest.mark.parametrize("typed", ["iss", "sun", "moon", "sirius", "jupiter"])
def test_the_next_rise_is_where_it_crosses_the_horizon(typed):
    target = resolver().resolve(typed).target
    when = NOW.replace(hour=20) if typed == "sun" else NOW
    while target.look(HERE, when).el_deg > 0.0:
        when = when.replace(hour=(when.hour + 1) % 24)
    rise = next_rise(target, HERE, when)
    assert rise > when
    assert abs(target.look(HERE, rise).el_deg) < 0.25
