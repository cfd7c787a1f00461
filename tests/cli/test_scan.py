"""`birdcage scan`: a map over the wire, its files, and what is said."""

from __future__ import annotations

import json
import re

import pytest
from birdcage.sim.settings import SimSettings


@pytest.fixture(autouse=True)
def _quick_line(monkeypatch):
    monkeypatch.setenv("BIRDCAGE_LINK_DELAY_S", "0.3")


SKY = SimSettings()
SMALL = ("scan", "--az", "178:180", "--el", "40:41", "--step", "1")


def test_a_map_is_made_kept_and_written_into_a_folder(run, tmp_path):
    result = run(*SMALL, "--out", tmp_path / "out")
    assert result.exit_code == 0, result.stderr
    assert "6 directions, about a minute." in result.stderr
    assert "The map is complete: 6 directions." in result.stderr
    assert "Map 1: 6 of 6 directions are kept." in result.stderr
    files = sorted((tmp_path / "out").iterdir())
    assert {each.suffix for each in files} == {".csv", ".fits", ".png", ".txt"}
    assert sorted(result.stdout.split()) == sorted(str(each) for each in files)
    listed = run("maps")
    assert re.search(r"1 .*az 178:180 el 40:41 +1° +6 of 6 +tuner .* DEMO", listed.stdout)


def test_the_estimate_alone_moves_nothing_and_keeps_nothing(run):
    result = run("scan", "--az", "110:240", "--el", "18:58", "--step", "1", "--estimate")
    assert result.exit_code == 0, result.stderr
    assert "5371 directions, about 58 min." in result.stderr
    assert "No map was made yet." in run("maps").stderr


def test_what_was_cut_short_is_resumed_and_no_other(run):
    result = run("scan", "--resume")
    assert result.exit_code == 2
    assert "No map is unfinished. `birdcage maps` lists them." in result.stderr


def test_two_maps_one_after_the_other_lie_side_by_side(run):
    result = run(*SMALL, "--repeat", "2", "--json")
    assert result.exit_code == 0, result.stderr
    assert json.loads(result.stdout)["heard"] == 6
    maps = json.loads(run("maps", "--json").stdout)
    assert [each["heard"] for each in maps] == [6, 6]


@pytest.fixture
def placed(run, tmp_path):
    file = tmp_path / "birdcage.toml"
    file.write_text(f"[place]\nlatitude_deg = {SKY.lat}\nlongitude_deg = {SKY.lon}\n")
    return lambda *words, **how: run("--config", file, *words, **how)


def test_around_a_star_the_map_stays_with_it(placed, tmp_path):
    around = ("scan", "--around", "polaris", "--az", "-1:1", "--el", "0:0", "--step", "1")
    result = placed(*around, "--out", tmp_path / "out")
    assert result.exit_code == 0, result.stderr
    assert "The map is complete: 3 directions." in result.stderr
    (table,) = (tmp_path / "out").glob("*.csv")
    rows = [line.split(",") for line in table.read_text().splitlines() if line and not line.startswith("#")]
    names = {name: index for index, name in enumerate(rows[0])}
    for row in rows[1:]:
        assert float(row[names["aim_el_deg"]]) == pytest.approx(SKY.lat, abs=1.0)
        assert float(row[names["el_deg"]]) == pytest.approx(float(row[names["aim_el_deg"]]), abs=0.1)


def test_a_reference_that_moves_is_refused(placed):
    result = placed(*SMALL, "--reference", "ra 38 dec 60")
    assert result.exit_code == 2
    assert "moves on the sky: as a reference it tells no drift. Name a satellite slot." in result.stderr


def test_a_slot_is_a_reference(placed):
    result = placed(*SMALL, "--reference", "119W", "--estimate")
    assert result.exit_code == 0, result.stderr
    plain = placed(*SMALL, "--estimate")
    assert "6 directions, about a minute" in plain.stderr


@pytest.mark.parametrize(("words", "said"), [
    (("scan",), "Which part of the sky?"), (("scan", "--az", "160", "--el", "20:30"), "is no range of degrees"),
    (("scan", "--az", "160:170", "--el", "70:80"), "is out of reach. This dish reaches 18 to 65"),
    ((*SMALL, "--start", "noon"), "is not a time. Type 23:00"),
    (("scan", "--resume", "7"), "No unfinished map has the number 7"),
    ((*SMALL, "--resume"), "--resume goes on with a map as it was begun. Leave --az out."),
    (("scan", "--resume", "--until", "soon"), "No map is unfinished."),
])  # fmt: skip
def test_what_makes_no_map_is_refused_with_what_to_do(run, words, said):
    result = run(*words)
    assert result.exit_code == 2, result.stderr
    assert said in result.stderr


def test_a_dish_without_a_tuner_is_not_moved(run):
    result = run(*SMALL, port="sim:hal205", firmware="hal205")
    assert result.exit_code == 1
    assert "has no tuner to read. With --source your receiver is heard. Nothing was sent." in result.stderr


def test_drift_is_told_by_the_reference_crosses(placed):
    made = placed(*SMALL, "--reference", "119W")
    assert made.exit_code == 0, made.stderr
    told = placed("maps", "drift", "1")
    assert told.exit_code == 0, told.stderr
    head, *rows = told.stdout.splitlines()
    assert head.split() == ["time", "gain", "right", "up", "±"]
    assert len(rows) == 2
    assert rows[0].split()[2:5] == ["1.000", "+0.00°", "+0.00°"]
    gain, right = float(rows[1].split()[2]), float(rows[1].split()[3].rstrip("°"))
    assert gain == pytest.approx(1.0, abs=0.1)
    assert abs(right) < 0.3
    assert "lost steps" not in told.stdout
    assert json.loads(placed("maps", "drift", "1", "--json").stdout)[1]["gain"] == pytest.approx(gain, abs=1e-3)


def test_a_map_without_a_reference_says_so(run):
    run(*SMALL)
    assert "Map 1 has no reference cross." in run("maps", "drift", "1").stderr
    assert "There is no map 7." in run("maps", "drift", "7").stderr
