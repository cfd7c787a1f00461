"""`birdcage passes` as a person and a script meet it."""

from __future__ import annotations

import csv
import io
import json
from datetime import UTC, datetime

import pytest
from birdcage.sky.observer import Observer
from birdcage.sky.passes.search import search
from birdcage.sky.propagate import Fleet

TLE = """ISS (ZARYA)
1 25544U 98067A   26325.50000000  .00016717  00000-0  10270-3 0  9000
2 25544  51.6416 247.4627 0006703 130.5360 325.0288 15.72125391    16
"""
START = datetime(2026, 11, 21, tzinfo=UTC)
PLACE = ("--lat", 40, "--lon", -105, "--alt", 1650)


@pytest.fixture
def iss(tmp_path):
    path = tmp_path / "iss.tle"
    path.write_text(TLE)
    return path


@pytest.fixture
def passes(run, iss):
    """Run `birdcage passes` on the ISS for two days, at a place, unless told otherwise."""

    def passes(*words, place=PLACE, firmware="g2", elements=iss):
        common = ["--elements", elements] if elements else []
        return run("passes", *common, *place, "--start", "2026-11-21", "--hours", 48, *words, firmware=firmware)

    return passes


def test_json_holds_every_pass_with_its_reach(passes, as_json, iss):
    from birdcage.sky.formats import read_path

    found = as_json(passes("--json"))
    expected = list(search(Fleet(read_path(iss).elements), Observer(40.0, -105.0, 1650.0), START, 48.0))
    assert len(found) == len(expected) > 8
    for one, wanted in zip(found, expected, strict=True):
        assert (one["name"], one["norad_id"]) == ("ISS (ZARYA)", 25544)
        assert abs((datetime.fromisoformat(one["aos"]) - wanted.aos).total_seconds()) < 0.002
        assert one["max_elevation_deg"] == pytest.approx(wanted.max_elevation_deg, abs=1e-4)
        reached = [
            (datetime.fromisoformat(each["start"]), datetime.fromisoformat(each["end"])) for each in one["reach"]
        ]
        assert all(wanted.aos < start < end < wanted.los for start, end in reached)
        assert bool(reached) == (wanted.max_elevation_deg > 18.0)  # the G2's floor


def test_the_dish_makes_the_reach(passes, as_json):
    def total(firmware):
        return sum(one["reach_s"] for one in as_json(passes("--json", firmware=firmware)))

    nothing = total("")
    assert 0.0 < total("g2") < total("hal205") < nothing
    assert nothing == pytest.approx(sum(one["duration_s"] for one in as_json(passes("--json", firmware=""))), abs=0.1)


def test_it_says_what_the_reach_is_taken_from(passes):
    assert "The Carryout G2: reach is taken from 18° to 65° of elevation, cable -423° to +23°" in passes().stderr
    assert "No dish is named" in passes(firmware="").stderr


def test_the_table_has_a_line_a_pass(passes, as_json):
    lines = passes().stdout.splitlines()
    assert lines[0].split()[:4] == ["AOS", "(UTC)", "LOS", "NAME"]
    found = as_json(passes("--json"))
    assert len(lines) == len(found) + 1
    best = max(found, key=lambda one: one["max_elevation_deg"])
    line = lines[1 + found.index(best)]
    assert best["aos"][11:19] in line
    assert f"{best['max_elevation_deg']:.1f}°" in line
    assert "floor" in line
    assert all(len(each) < 140 for each in lines)


def test_settings_narrow_the_reach_and_place_the_observer(passes, as_json):
    from birdcage.base.paths import Paths

    before = as_json(passes("--json"))
    file = Paths.default().config_file
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(
        "[place]\nlatitude_deg = 40.0\nlongitude_deg = -105.0\nheight_m = 1650.0\nhorizon = [[0, 30], [180, 30]]\n"
        "[motion]\nmin_elevation_deg = 25.0\n"
    )
    after = as_json(passes("--json", place=()))
    assert [one["aos"] for one in after] == [one["aos"] for one in before]
    assert sum(one["reach_s"] for one in after) < sum(one["reach_s"] for one in before)
    assert {reason for one in after for reason in one["not_reached_because"]} >= {"floor", "horizon"}


def test_sorting_limiting_and_a_higher_horizon(passes, as_json):
    by_height = as_json(passes("--json", "--sort", "max", "--limit", 3))
    heights = [one["max_elevation_deg"] for one in by_height]
    assert len(heights) == 3
    assert heights == sorted(heights, reverse=True)
    by_reach = [one["reach_s"] for one in as_json(passes("--json", "--sort", "reach"))]
    assert by_reach == sorted(by_reach, reverse=True)
    high = as_json(passes("--json", "--min-elevation", 30))
    assert {one["max_elevation_deg"] > 30 for one in high} == {True}
    assert high[0]["duration_s"] < 400


def test_a_name_or_number_chooses_and_a_wrong_one_is_said(passes, as_json):
    assert as_json(passes("--json", "--name", "zarya")) == as_json(passes("--json", "--name", "25544")) != []
    result = passes("--name", "sputnik")
    assert (result.exit_code, result.stdout) == (2, "")
    assert "No target is called 'sputnik'" in result.stderr


def test_one_satellite_is_named_as_everywhere(passes, as_json):
    whole = as_json(passes("--json", "--name", "25544"))
    assert as_json(passes("--json", "iss")) == as_json(passes("--json", "ISS (ZARYA)")) == whole
    for words, told in (
        (("ao-91",), "AO-91 (43017) is not among your 1"),
        (("moon",), "Moon makes no passes: `birdcage where moon`"),
        (("isss",), "Did you mean ISS?"),
        (("iss", "--name", "x"), "not both"),
    ):
        refused = passes(*words)
        assert refused.exit_code == 2
        assert told in " ".join(refused.stderr.split())


def test_a_frequency_adds_the_doppler(passes, as_json):
    one = as_json(passes("--json", "--freq", 145.8, "--limit", 1))[0]
    assert one["aos_doppler_hz"] > 2000 > -2000 > one["los_doppler_hz"]
    assert "kHz" in passes("--freq", 145.8, "--limit", 1).stdout


def test_csv_and_calendar_are_written(passes, tmp_path):
    table, calendar = tmp_path / "passes.csv", tmp_path / "passes.ics"
    result = passes("--csv", table, "--ics", calendar)
    assert (result.exit_code, result.stdout) == (0, "")
    assert len(list(csv.DictReader(io.StringIO(table.read_text())))) == calendar.read_bytes().count(b"BEGIN:VEVENT") > 8
    assert passes("--csv", "-").stdout.startswith("name,norad_id,aos,")
    refused = passes("--csv", tmp_path)
    assert refused.exit_code == 2
    assert "cannot be written" in refused.stderr


def test_damaged_lines_are_told_and_the_good_ones_count(passes, tmp_path, as_json):
    mixed = tmp_path / "mixed.tle"
    mixed.write_text(TLE.replace("51.6416", "51.6417") + TLE)
    result = passes("--json", elements=mixed)
    assert len(json.loads(result.stdout)) > 8
    assert f"{mixed}:3" in result.stderr
    mixed.write_text("nothing of the kind\n")
    assert passes(elements=mixed).exit_code == 2


def test_without_elements_those_that_ship_are_used_and_said_to_be_old(passes):
    result = passes(elements=None)
    assert result.exit_code == 0
    assert "frozen elements" in result.stderr
    assert "Do not point a dish by them" in result.stderr


def test_the_catalogue_is_used_where_there_is_one(passes, as_json, iss, run):
    assert run("elements", "add", iss).exit_code == 0
    assert run("elements", "favourite", "25544").exit_code == 0
    found = as_json(passes("--json", elements=None))
    assert {one["name"] for one in found} == {"ISS (ZARYA)"}
    assert all(one["favourite"] for one in found)


@pytest.mark.parametrize(("words", "said"), [
    ((), "No place is set"), (("--lat", 40), "go together"), (("--lat", 91, "--lon", 0), "91"),
])  # fmt: skip
def test_no_place_is_an_error_of_the_command_line(passes, words, said):
    result = passes(place=words)
    assert result.exit_code == 2
    assert said in result.stderr


@pytest.mark.parametrize("words", [("--hours", 0), ("--start", "noon"), ("--elements", "/nowhere"), ("--sort", "name")])
def test_what_cannot_be_is_a_usage_error(run, words):
    assert run("passes", *PLACE, *words).exit_code == 2


def test_a_time_with_a_zone_is_taken_as_such(passes, as_json):
    there = as_json(passes("--json", "--start", "2026-11-20T17:00:00-07:00"))
    assert there == as_json(passes("--json", "--start", "2026-11-21T00:00:00Z"))


def test_a_satellite_that_comes_ten_seconds_later_rises_ten_seconds_later(run, passes, as_json, iss):
    run("elements", "add", iss)
    before = as_json(passes("--json", elements=None))
    run("elements", "offset", 25544, 10)
    late = as_json(passes("--json", elements=None))
    assert len(late) == len(before) > 8
    for one, other in zip(late, before, strict=True):
        apart = datetime.fromisoformat(one["aos"]) - datetime.fromisoformat(other["aos"])
        assert apart.total_seconds() == pytest.approx(10.0, abs=2.5), "but for what the Earth turns meanwhile"


def test_a_narrow_terminal_gets_fewer_columns_and_is_told_which(passes, monkeypatch):
    monkeypatch.setattr("birdcage.cli.table.room", lambda: 80)
    result = passes()
    lines = result.stdout.splitlines()
    assert max(map(len, lines)) <= 80
    assert lines[0].split() == ["AOS", "(UTC)", "LOS", "NAME", "MAX", "AZIMUTHS", "REACH", "ERROR"]
    assert "No room for FROM, BEST, NOT WHERE, SUN, AGE: a wider terminal" in result.stderr


def test_a_table_ends_after_forty_and_says_how_many_there_are(run, as_json):
    words = ("passes", *PLACE, "--start", "2018-01-21", "--hours", 48)
    everything = as_json(run(*words, "--json"))
    stay = [one["name"] for one in everything if one["already_up"] and one["still_up"]]
    result = run(*words)
    assert len(result.stdout.splitlines()) == 1 + 40
    assert f"{len(everything) - len(stay) - 40} more are not listed" in result.stderr
    assert f"Left out, as always up: {len(stay)}." in result.stderr
    assert stay
    assert not any(name in result.stdout for name in stay)
    assert len(run(*words, "--limit", 50).stdout.splitlines()) == 1 + 50
    named = run(*words, "--name", stay[0]).stdout
    row = next(line for line in named.splitlines() if stay[0] in line)
    assert row.startswith("always up")
    assert "48:00:00" not in row
    told = next(one for one in everything if one["name"] == stay[0])
    assert (told["always_up"], told["duration_s"]) == (True, None)
    assert told["reach_s"] != 48 * 3600.0
    assert not any(
        one["always_up"] for one in as_json(run("passes", *PLACE, "--start", "2018-01-21", "--hours", 2, "--json"))
    )


def test_a_file_that_was_written_is_named(passes, tmp_path):
    assert f"1 pass written to {tmp_path / 'one.ics'}" in passes("--ics", tmp_path / "one.ics", "--limit", 1).stderr
    assert (tmp_path / "one.ics").read_bytes().startswith(b"BEGIN:VCALENDAR")
