"""What the age of elements costs, wherever elements are listed."""

from __future__ import annotations

import csv
import io
from datetime import UTC, datetime, timedelta

import pytest
from birdcage.base.paths import Paths
from birdcage.sky.catalogue import Catalogue
from birdcage.sky.elements import ElementSet

NOW = datetime.now(UTC)
STATION = ElementSet("ISS (ZARYA)", 25544, NOW - timedelta(days=2), 51.6, 0, 0.0005, 0, 0, 15.4995)
METOP = ElementSet("METOP-B", 38771, NOW - timedelta(hours=6), 98.7, 0, 0.0001, 0, 0, 14.215)


@pytest.fixture(autouse=True)
def at_home(tmp_path, monkeypatch):
    monkeypatch.setenv("BIRDCAGE_HOME", str(tmp_path))
    with Catalogue(Paths.in_folder(tmp_path).catalogue) as catalogue:
        catalogue.add([STATION, METOP])
    return tmp_path


@pytest.fixture
def passes(run):
    def passes(*words):
        return run("passes", "--lat", 52.0, "--lon", 5.0, "--hours", 24.0, *words, port=None, firmware="")

    return passes


def test_check_tells_the_error_of_each_with_a_glyph(run, as_json):
    result = run("elements", "check", port=None, firmware="")
    told = {line.split()[1]: line for line in result.stdout.splitlines()}
    assert " 48 h " in told["ISS"] or " 2 d " in told["ISS"]
    assert "○ 0.8" in told["ISS"], "the median pointing error of a set that is two days old"
    assert "●" in told["METOP-B"]
    station, metop = as_json(run("elements", "check", "--json", port=None, firmware=""))["satellites"]
    assert station["elements_grade"] == "doubtful"
    assert station["along_track_error_km"] == pytest.approx(6.0, abs=0.1)
    assert (station["error_measured"], metop["error_measured"]) == (True, False)


def test_passes_tell_it_at_their_own_distance(passes, as_json):
    rows = [each for each in as_json(passes("--name", "iss", "--json")) if each["max_elevation_deg"] < 80]
    low, high = (find(rows, key=lambda each: each["max_elevation_deg"]) for find in (min, max))
    assert low["tca_range_km"] > high["tca_range_km"]
    assert low["pointing_error_deg"] < high["pointing_error_deg"]
    header, *lines = passes("--name", "iss").stdout.splitlines()
    assert header.split()[-1] == "ERROR"
    assert all("°" in line.split()[-1] and line.split()[-2] in "●◐○✗" for line in lines)


def test_it_is_in_the_csv_too(passes):
    (first, *_rest) = csv.DictReader(io.StringIO(passes("--name", "metop", "--csv", "-").stdout))
    assert first["elements_grade"] in ("fresh", "usable")
    assert float(first["pointing_error_p90_deg"]) > float(first["pointing_error_deg"])


def test_where_tells_it_for_a_satellite_and_not_for_a_body(run, as_json):
    here = ("--lat", 52.0, "--lon", 5.0)
    told = as_json(run("where", "25544", *here, "--json", port=None, firmware=""))
    assert told["along_track_error_km"] == pytest.approx(6.0, abs=0.1)
    assert "elements_grade" not in as_json(run("where", "moon", *here, "--json", port=None, firmware=""))
    lines = run("where", "25544", *here, port=None, firmware="").stdout.splitlines()
    (line,) = (line for line in lines if line.startswith("error "))
    assert "2 d old" in line or "48 h old" in line
    assert "±" in line
    assert "(90 %: " in line
