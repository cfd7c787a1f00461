"""`birdcage sky`: what is up, highest first."""

from __future__ import annotations

import pytest
from birdcage.base.paths import Paths
from birdcage.sky.catalogue import Catalogue
from birdcage.sky.demo_orbits import demo_orbits
from birdcage.sky.observer import Observer

HERE = ("--lat", 40.0, "--lon", -100.0)
AT = ("--at", "2026-11-21T18:00:00Z")


@pytest.fixture(autouse=True)
def at_home(tmp_path, monkeypatch):
    monkeypatch.setenv("BIRDCAGE_HOME", str(tmp_path))
    return tmp_path


@pytest.fixture
def sky(run):
    def sky(*words, firmware="", **more):
        return run("sky", *HERE, *AT, *words, firmware=firmware, **more)

    return sky


@pytest.fixture
def filled(at_home):
    from datetime import UTC, datetime

    elements = demo_orbits(datetime(2026, 11, 21, 18, tzinfo=UTC), Observer(40.0, -100.0))
    with Catalogue(Paths.in_folder(at_home).catalogue) as catalogue:
        catalogue.add(elements)
    return elements


def test_satellites_slots_and_bodies_highest_first(sky, as_json, filled):
    rows = as_json(sky("--json", firmware="g2"))
    elevations = [row["elevation_deg"] for row in rows]
    assert elevations == sorted(elevations, reverse=True)
    assert min(elevations) >= 0.0
    assert {row["kind"] for row in rows} == {"satellite", "slot", "body"}
    assert "119°W EchoStar 14" in {row["name"] for row in rows}
    assert "25.9°E QO-100" not in {row["name"] for row in rows}
    sun = next(row for row in rows if row["name"] == "Sun")
    assert 1.0 < sun["rise_db"] < 2.5
    satellite = next(row for row in rows if row["kind"] == "satellite")
    assert (satellite["source"], satellite["age_s"]) == ("demo", 0)


def test_each_row_is_what_where_says(sky, run, as_json, filled):
    for row in as_json(sky("--json"))[::9]:
        target = str(row["norad_id"]) if row["kind"] == "satellite" else row["name"].split()[0].replace("°", "")
        told = as_json(run("where", target, *HERE, *AT, "--json", firmware=""))
        for key in ("azimuth_deg", "elevation_deg", "range_km", "in_reach", "rise_db", "epoch"):
            assert told[key] == pytest.approx(row[key], abs=2e-4), (target, key)


def test_a_satellite_that_comes_later_stands_where_where_has_it(sky, run, as_json, filled, at_home):
    low = min((each for each in filled if each.mean_motion_rev_day > 10.0), key=lambda each: each.norad_id)
    before = as_json(sky("--json", "--min-elevation", -90))
    with Catalogue(Paths.in_folder(at_home).catalogue) as catalogue:
        catalogue.set_time_offset(low.norad_id, 60.0)
    after = as_json(sky("--json", "--min-elevation", -90))
    told = as_json(run("where", low.norad_id, *HERE, *AT, "--json", firmware=""))

    def row(rows):
        return next(row for row in rows if row["norad_id"] == low.norad_id)

    assert row(after)["range_km"] == pytest.approx(told["range_km"], abs=0.01)
    assert abs(row(after)["range_km"] - row(before)["range_km"]) > 10.0


def test_a_higher_limit_leaves_out_what_is_lower(sky, as_json, filled):
    high = as_json(sky("--json", "--min-elevation", 30))
    assert high
    assert all(row["elevation_deg"] >= 30.0 for row in high)
    assert len(high) < len(as_json(sky("--json")))
    everything = as_json(sky("--json", "--min-elevation", -90))
    assert {"25.9°E QO-100", "Sun", "Neptune"} <= {row["name"] for row in everything}


def test_the_table_and_its_limit(sky, as_json, filled):
    result = sky("--limit", 3)
    head, *lines = result.stdout.splitlines()
    assert head.split() == ["EL", "AZ", "NAME", "RANGE", "KM", "NOTES"]
    assert len(lines) == 3
    assert f"{len(as_json(sky('--json'))) - 3} more are lower" in result.stderr
    assert max(map(len, result.stdout.splitlines())) <= 80
    assert len(as_json(sky("--json", "--limit", 2))) == 2


def test_nothing_up_is_said(sky):
    result = sky("--min-elevation", 89.99)
    assert result.stdout == ""
    assert "Nothing is above 89.99°" in result.stderr


def test_frozen_elements_are_marked_and_warned_of(sky, as_json):
    result = sky("--min-elevation", -90, "--limit", 200)
    assert "FROZEN, of 2018-01-" in result.stdout
    assert "frozen elements" in result.stderr
    assert "2018-01-" in result.stderr
    assert any(row["source"] == "frozen" for row in as_json(sky("--json", "--min-elevation", -90)))


def test_what_is_out_of_reach_says_why(sky, as_json, filled):
    rows = as_json(sky("--json", firmware="g2"))
    low = [row for row in rows if row["elevation_deg"] < 18.0]
    assert low
    assert {row["in_the_way"] for row in low} == {"below the floor of 18°"}
    assert any(row["in_reach"] for row in rows)
    assert {row["in_reach"] for row in as_json(sky("--json"))} == {None}


def test_after_the_ephemeris_the_rest_is_still_listed(run, as_json, filled):
    result = run("sky", *HERE, "--at", "2060-01-01", "--json", firmware="")
    assert "2020-01-02 to 2053-10-08" in result.stderr
    assert {row["kind"] for row in as_json(result)} >= {"slot"}


def test_without_a_place_it_says_how_to_set_one(run):
    result = run("sky", firmware="")
    assert result.exit_code == 2
    assert "--lat and --lon" in result.stderr
