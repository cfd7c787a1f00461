"""Maps on the command line: listed, written into files, averaged and subtracted."""

from __future__ import annotations

import pytest
from birdcage.base.paths import Paths
from birdcage.skymap.map_file import MapWriter, NewMap
from birdcage.skymap.plan import MapFrame, MapPlan

from tests.skymap.made import made_map

PLAN = MapPlan(160.0, 164.0, 25.0, 27.0, 1.0)
ABOUT = {"dish": "Carryout G2", "latitude_deg": 52.01234, "longitude_deg": 4.35678}


def keep(key, level, *, heard=None, plan=PLAN, settings=None, demo=True, about=ABOUT):
    writer = MapWriter(Paths.default().signal_recordings, NewMap(key, plan, "tuner", "counts", False, demo, about))
    for each in made_map(plan, lambda az, el: level + az, heard=heard).samples:
        writer.add(each, settings or {"transponder": "1"})
    writer.close()
    assert not writer.problem


@pytest.fixture
def maps():
    keep("one", 400.0)
    keep("two", 410.0, heard=7)
    keep("sun", 500.0, plan=MapPlan(-2.0, 2.0, -2.0, 2.0, 1.0, frame=MapFrame.TARGET), demo=False,
         about={"target": "Sun"}, settings={"transponder": "7"})  # fmt: skip


def test_the_list_has_number_begin_region_what_was_heard_and_demo(run, as_json, maps):
    lines = run("maps").stdout.splitlines()
    assert [" ".join(line.split()) for line in lines[1:]] == [
        "3 2026-03-20 06:00:00Z around Sun ±2° 1° 25 of 25 tuner 498 to 502 counts",
        "2 2026-03-20 06:00:00Z az 160:164 el 25:27 1° 7 of 15 tuner 570 to 574 counts DEMO",
        "1 2026-03-20 06:00:00Z az 160:164 el 25:27 1° 15 of 15 tuner 560 to 564 counts DEMO",
    ]
    told = as_json(run("maps", "--json"))
    assert [(each["number"], each["heard"], each["of"], each["demo"]) for each in told] == [
        (3, 25, 25, False), (2, 7, 15, True), (1, 15, 15, True),
    ]  # fmt: skip
    assert told[2]["begun"] == "2026-03-20T06:00:00.000Z"
    assert (told[1]["ended"], told[2]["low"], told[2]["x_high_deg"]) == (None, 560.0, 164.0)


def test_a_region_beside_its_target_is_told_as_it_is(run):
    plan = MapPlan(-2.0, 4.0, -1.0, 3.0, 1.0, frame=MapFrame.TARGET)
    keep("sun", 500.0, plan=plan, about={"target": "Sun"})
    assert " around Sun x -2:4 y -1:3 " in run("maps").stdout


def test_a_map_without_its_drift_is_written_beside_the_map_itself(run, maps, tmp_path):
    assert run("export", 1, "--out", tmp_path).exit_code == 0
    before = {each.name: each.read_bytes() for each in tmp_path.iterdir()}
    said = run("export", 1, 2, "--mean", "--out", tmp_path)
    assert said.exit_code == 0, said.stderr
    assert "No raw text: its files are named by time alone" in said.stderr
    assert {name: (tmp_path / name).read_bytes() for name in before} == before


@pytest.mark.parametrize("typed", ["nan:220", "160:inf", "-inf:inf", "160"])
def test_a_range_has_two_angles(typed):
    import click
    from birdcage.cli.range_type import RangeType

    with pytest.raises(click.BadParameter, match="is no range of degrees"):
        RangeType().convert(typed, None, None)


def test_maps_are_written_where_and_as_what_is_asked_for(run, as_json, maps, tmp_path):
    said = run("export", 1, 2, "--out", tmp_path / "new", "--as", "CSV,text")
    assert said.exit_code == 1  # both maps began at the same time, so their raw text has the same name
    assert "exists and holds something else" in said.stderr
    said = run("export", 1, "--out", tmp_path / "other", "--as", "csv, text")
    assert said.exit_code == 0, said.stderr
    assert [line.rpartition("/")[2] for line in said.stdout.splitlines()] == [
        "map-1-20260320-060000.csv", "2026_03_20_06_00_00.txt", "raw-data-20260320-060000.txt",
        "scan-settings-20260320-060000.txt",
    ]  # fmt: skip
    told = as_json(run("export", 2, "--out", tmp_path, "--as", "csv", "--json"))
    assert told == {"files": [f"{tmp_path}/map-2-20260320-060000.csv"], "notes": []}


def test_raw_text_of_another_program_is_a_map_too(run, maps, tmp_path):
    file = tmp_path / "2024_05_01_12_00_00.txt"
    file.write_text("110.0 18.0 400\n110.0 19.0 409\n111.0 18.0 405\n111.0 19.0 -1\n111.0 20.0 4")
    said = run("export", file, "--out", tmp_path, "--as", "csv")
    assert said.exit_code == 0, said.stderr
    assert f"{file.name}: The last line has no end, so it is left out." in said.stderr
    text = (tmp_path / "map-2024_05_01_12_00_00.csv").read_text()
    assert "directions heard: 3 of 4" in text
    assert "DEMO" not in text


def test_means_and_differences(run, maps, tmp_path):
    assert run("export", 1, 2, "--mean", "--out", tmp_path, "--as", "csv").exit_code == 0
    mean = (tmp_path / "map-1-2-mean-20260320-060000.csv").read_text()
    assert "# mean_of: [1, 2]" in mean
    assert run("export", 2, "--minus", 1, "--out", tmp_path, "--as", "csv").exit_code == 0
    rows = [
        line for line in (tmp_path / "map-2-minus-1-20260320-060000.csv").read_text().splitlines() if line[0] != "#"
    ]
    assert len(rows) == 1 + 7
    assert {row.split(",")[rows[0].split(",").index("value")] for row in rows[1:]} == {"10.0"}
    refused = run("export", 1, 3, "--mean", "--out", tmp_path)
    assert refused.exit_code == 1
    assert "The frame differs: azel on Map 1, target on Map 3." in refused.stderr
    keep("retuned", 400.0, settings={"transponder": "5"})
    refused = run("export", 1, "--minus", 4, "--out", tmp_path)
    assert "The receiver's `transponder` differs: 1 on Map 1, 5 on Map 4." in refused.stderr


def test_with_the_place_blurred_it_is_not_in_the_files(run, maps, tmp_path):
    assert run("export", 1, "--blur-place", "--out", tmp_path / "out").exit_code == 0
    files = list((tmp_path / "out").iterdir())
    assert any(each.name == "map-1-20260320-060000-blurred.csv" for each in files)
    assert not [each.name for each in files if b"52.01" in each.read_bytes()]


@pytest.mark.parametrize(
    ("words", "code", "why"),
    [
        (("nosuch",), 2, "There is no map and no file “nosuch”. `birdcage maps` lists the maps."),
        ((7,), 1, "There is no map 7. `birdcage maps` lists them."),
        ((10**30,), 2, "There is no map and no file"),
        ((1, "--as", "jpeg"), 2, "“jpeg” is no kind of file. There are csv,"),
        ((1, "--mean"), 1, "A mean needs two maps or more."),
        ((3, "--as", "text"), 1, "No raw text: it has no form for a map around a target."),
    ],
)
def test_what_cannot_be_written_is_said_with_the_way_out(run, maps, tmp_path, words, code, why):
    said = run("export", *words, "--out", tmp_path)
    assert said.exit_code == code
    assert why in " ".join(said.stderr.split())
    assert list(tmp_path.glob("map-*")) == []
