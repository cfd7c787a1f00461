"""`birdcage autotrack` as a person and a script meet it."""

from __future__ import annotations

import json
from datetime import UTC, datetime, timedelta
from itertools import pairwise

import pytest
from birdcage.sky.demo_orbits import demo_orbits
from birdcage.sky.observer import Observer

TLE = """ISS (ZARYA)
1 25544U 98067A   26325.50000000  .00016717  00000-0  10270-3 0  9000
2 25544  51.6416 247.4627 0006703 130.5360 325.0288 15.72125391    16
SISTER
1 25545U 98067B   26325.50000000  .00016717  00000-0  10270-3 0  9001
2 25545  51.6416 247.4627 0006703 130.5360 327.0288 15.72125391    19
"""
WHERE = ("--lat", 40, "--lon", -105, "--alt", 1650, "--start", "2026-11-21")


@pytest.fixture
def autotrack(run, tmp_path):
    path = tmp_path / "two.tle"
    path.write_text(TLE)

    def autotrack(*words, firmware="hal205", elements=True):
        return run("autotrack", "--dry-run", *(["--elements", path] if elements else []), *WHERE, *words,
                   firmware=firmware)  # fmt: skip

    return autotrack


def test_json_has_every_pass_within_reach_and_what_becomes_of_it(autotrack, as_json, run, tmp_path):
    plan = as_json(autotrack("--json"))
    passes = as_json(run("passes", "--json", "--elements", tmp_path / "two.tle", *WHERE, firmware="hal205"))
    reached = sorted(each["reach"][0]["start"] for each in passes if each["reach"])
    told = [each["reach_start"] for each in plan["passes"]]
    assert len(told) == len(reached) > 1
    for one, other in zip(told, reached, strict=True):  # the two searches begin at other times
        assert abs((datetime.fromisoformat(one) - datetime.fromisoformat(other)).total_seconds()) < 0.01
    assert plan["never_in_reach"] == len(passes) - len(reached) > 0
    kept = [each for each in plan["passes"] if each["kept"]]
    assert 0 < len(kept) < len(plan["passes"])
    for before, after in pairwise(kept):
        assert datetime.fromisoformat(after["reach_start"]) > datetime.fromisoformat(before["reach_end"])
    assert all(each["why"] for each in plan["passes"] if not each["kept"])


def test_the_table_says_why_and_the_timeline_shows_when(autotrack, as_json):
    result = autotrack()
    plan = as_json(autotrack("--json"))
    table, _, drawn = result.stdout.partition("\n\n")
    lines = table.splitlines()[1:]
    assert [line.startswith("follow") for line in lines] == [each["kept"] for each in plan["passes"]]
    assert any("overlaps SISTER (priority 0)" in line or "overlaps ISS (ZARYA) (priority 0)" in line for line in lines)
    axis, one, other, legend = drawn.splitlines()
    assert axis.split()[:2] == ["00:00", "02:00"]
    assert "followed" in legend
    assert {one[0:6], other[0:6]} == {"ISS (Z", "SISTER"}
    first = datetime.fromisoformat(next(each["reach_start"] for each in plan["passes"] if each["kept"]))
    bars = [
        min(line.find(mark) for mark in "█#" if mark in line) for line in (one, other) if "█" in line or "#" in line
    ]
    width = len(one) - 13
    assert min(bars) - 13 == int((first.hour + first.minute / 60 + first.second / 3600) / 24 * width)


def test_settings_and_options_count(autotrack, as_json):
    from birdcage.base.paths import Paths

    assert as_json(autotrack("--json", "--hours", 3))["passes"] == []
    assert "No favourite comes within reach in 3 hours." in autotrack("--hours", 3).stderr
    file = Paths.default().config_file
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text("[autotrack]\nmin_elevation_deg = 89.5\n")
    plan = as_json(autotrack("--json"))
    assert [each for each in plan["passes"] if each["kept"]] == []
    assert all("under 89.5°" in each["why"] or "under 120 s" in each["why"] for each in plan["passes"])


def test_favourites_of_the_catalogue_count_with_their_priorities(autotrack, as_json, run, tmp_path):
    result = autotrack(elements=False)
    assert result.exit_code == 2
    assert "No favourites yet. `birdcage elements favourite NAME" in result.stderr
    assert run("elements", "add", tmp_path / "two.tle").exit_code == 0
    assert run("elements", "favourite", "25544").exit_code == 0
    assert {each["norad_id"] for each in as_json(autotrack("--json", elements=False))["passes"]} == {25544}
    assert run("elements", "favourite", "25545", "--priority", "3").exit_code == 0
    plan = as_json(autotrack("--json", elements=False))["passes"]
    assert all(each["kept"] for each in plan if each["norad_id"] == 25545 and "under" not in (each["why"] or ""))
    assert any("SISTER (priority 3)" in (each["why"] or "") for each in plan if each["norad_id"] == 25544)


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("--engage", "--dry-run"), "move nothing"),
        (("--engage", "--hours", 3), "move nothing"),
        (("--until", "2026-11-22"), "go with --engage"),
        (("--speed", 5), "go with --engage"),
        (("--engage", "--speed", 5, "--port", "/dev/ttyUSB0"), "--speed is for a simulated dish"),
        (("--engage",), "No favourites yet"),
    ],
)
def test_what_does_not_go_together_is_said_and_nothing_is_opened(run, words, said):
    result = run("autotrack", "--lat", 50, "--lon", 10, *words)
    assert (result.exit_code, result.stdout) == (2, "")
    assert said in result.stderr


@pytest.fixture
def favourite():
    """A made-up satellite that passes within minutes, in the catalogue."""
    from birdcage.base.paths import Paths
    from birdcage.sky.catalogue import Catalogue

    orbit = demo_orbits(datetime.now(UTC), Observer(50.0, 10.0))[0]
    with Catalogue(Paths.default().catalogue) as catalogue:
        catalogue.add([orbit])
        catalogue.set_favourite(orbit.norad_id)
    return orbit


def test_a_pass_is_followed_and_kept(run, as_json, favourite, tmp_path):
    # It is highest two minutes from now, and the floor leaves little more of it than that.
    (tmp_path / "high.toml").write_text("[motion]\nmin_elevation_deg = 35\n[autotrack]\nmin_duration_s = 20\n")
    place = ("--lat", 50, "--lon", 10, "--config", tmp_path / "high.toml")
    first = next(each for each in as_json(run("autotrack", *place, "--json"))["passes"] if each["kept"])
    until = datetime.fromisoformat(first["reach_end"]) + timedelta(seconds=5)
    result = run("autotrack", *place, "--engage", "--speed", 20, "--until", until.isoformat(), "--json")
    assert result.exit_code == 0, result.stderr
    told = [json.loads(line) for line in result.stdout.splitlines()]
    assert [each["event"] for each in told].count("schedule") == 1
    phases = [each["phase"] for each in told if each["event"] == "phase"]
    assert phases.index("following") < phases.index("over")
    assert f"next: {favourite.name}" in result.stderr
    logged = as_json(run("log", "--json"))["passes"]
    assert logged[0]["name"] == favourite.name
    assert logged[0]["samples"] > 10
    assert logged[0]["demo"] is True


def test_after_the_time_nothing_is_begun(run, favourite):
    result = run("autotrack", "--lat", 50, "--lon", 10, "--engage", "--until", "2026-01-01")
    assert (result.exit_code, result.stdout) == (0, "")
    assert "following" not in result.stderr
