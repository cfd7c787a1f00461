"""`birdcage log` as a person and a script meet it."""

from __future__ import annotations

import csv
from dataclasses import replace

import pytest
from birdcage.base.paths import Paths
from birdcage.pursuit.pass_listener import PassFile, PassRemark
from birdcage.pursuit.pass_log import PassLog
from birdcage.station.pursuit_state import Phase

from tests.pursuit import pass_events
from tests.pursuit.pass_events import at, plan


@pytest.fixture
def three_passes():
    """A good pass, one of a simulated dish that was 1.5° off for a moment, and one that was cut off."""
    paths = Paths.default()
    log = PassLog(paths.journal, paths.passes, site=lambda: "Home")
    story = pass_events.Story(log)
    story.phase(0, Phase.FOLLOWING)
    for second in range(100):
        story.look(float(second), 0.02)
    story.phase(400, Phase.PARKING, latency_s=0.06)
    story.demo = True
    story.pursuit = replace(story.pursuit, number=2, plan=plan("METEOR-M2 4", 59051, start=6000.0))
    story.phase(6000, Phase.FOLLOWING)
    story.rssi(6049.5, 512.0)
    for second in range(100):
        story.look(6000.0 + second, 1.5 if second == 50 else 0.02, 4.0 if second == 50 else 0.01)
    log.remark(PassRemark("METEOR-M2 4", at(6050), "tca: recording"))
    story.phase(6400, Phase.OVER, "Ended by operator.")
    story.demo = False
    story.pursuit = replace(story.pursuit, number=3, plan=plan("ISS (ZARYA)", start=12000.0))
    story.phase(12000, Phase.FOLLOWING)
    assert log.flush()
    yield paths
    log.close(2.0)


def test_an_empty_log_says_so_and_makes_no_file(run, as_json):
    result = run("log")
    assert (result.exit_code, result.stdout, result.stderr.strip()) == (0, "", "No passes logged yet.")
    assert as_json(run("log", "--json"))["passes"] == []
    assert not Paths.default().journal.exists()


def test_the_table_has_a_line_a_pass_and_a_total(run, three_passes):
    result = run("log")
    head, first, second, third = result.stdout.splitlines()
    assert head.split()[:2] == ["NO", "BEGAN"]
    told = "1 2026-11-21 12:00:00 ISS (ZARYA) 61.5° 1:39 0.020° 0.020° 100.0 % fast The pass is over."
    assert " ".join(first.split()) == told
    rms = (0.02**2 * 0.99 + 1.5**2 * 0.01) ** 0.5
    assert f"DEMO METEOR-M2 4  61.5°      1:39  {rms:.3f}°  1.500°   99.0 %  fast  Ended by operator." in second
    assert third.split()[-8:] == ["fast", "Under", "way,", "or", "cut", "off", "in", "mid-pass."]
    assert third.split()[6:10] == ["-", "-", "-", "-"]
    assert "3 passes, 3:18 followed: RMS 0.108°, at most 1.500°, within 0.5 dB 99.5 % of the time." in result.stderr
    assert "DEMO was a simulated dish" in result.stderr


def test_json_has_the_same(run, as_json, three_passes):
    told = as_json(run("log", "--json"))
    first, second, third = told["passes"]
    assert (first["number"], first["name"], first["norad_id"], first["demo"]) == (1, "ISS (ZARYA)", 25544, False)
    assert (first["reach_start"], first["ended"]) == ("2026-11-21T12:00:00.000Z", "2026-11-21T12:06:40.000Z")
    assert (first["rms_deg"], first["within_half_db_share"], first["latency_s"]) == (0.02, 1.0, 0.06)
    assert (second["demo"], second["max_error_deg"]) == (True, 1.5)
    assert (third["ended"], third["outcome"], third["rms_deg"], third["samples"]) == (None, None, None, 0)
    assert (told["total"]["passes"], told["total"]["within_half_db_share"]) == (3, 0.995)


def test_choosing(run, as_json, three_passes):
    def numbers(*words):
        return [each["number"] for each in as_json(run("log", "--json", *words))["passes"]]

    assert numbers("--last", 2) == [2, 3]
    assert numbers("--since", "2026-11-21T13:00") == [2, 3]
    assert numbers("--name", "meteor") == numbers("--name", "59051") == [2]
    assert "No logged pass matches" in run("log", "--name", "sputnik").stderr


def test_one_pass_with_its_worst_moments_and_what_hooks_said(run, as_json, three_passes):
    text = run("log", "show", 2).stdout
    assert text.startswith("DEMO: a simulated dish")
    assert "METEOR-M2 4 (59051)" in text
    assert "at most 1.500°" in text
    worst = text.split("worst moments\n")[1].splitlines()
    told = "13:40:50 1.500° 4.0 dB 100.00° 40.00° 100.10° 40.00° 101.50° 40.00° 512 counts"
    assert " ".join(worst[1].split()) == told
    assert "13:40:50  tca: recording" in text
    told = as_json(run("log", "show", 2, "--json"))
    assert (len(told["all_samples"]), told["worst"][0]["error_deg"]) == (100, 1.5)
    assert told["remarks"] == [{"utc": "2026-11-21T13:40:50.000Z", "text": "tca: recording"}]


def test_one_pass_prints_what_was_heard_against_elevation_and_what_hooks_made(run, as_json, tmp_path):
    paths = Paths.default()
    log = PassLog(paths.journal, paths.passes)
    story = pass_events.Story(log)
    story.phase(0, Phase.FOLLOWING)
    for second in range(120):
        el_deg = 20.0 + 0.5 * min(second, 119 - second)
        story.rssi(second, 300.0 + 4.0 * el_deg)
        if second % 10 == 0:
            story.snr(second, el_deg / 5.0)
        story.at_elevation(float(second), el_deg)
    (tmp_path / "iq.raw").write_bytes(b"x" * 2_500_000)
    for path in (tmp_path / "iq.raw", tmp_path / "gone.raw"):
        log.made(PassFile("ISS (ZARYA)", at(100), str(path)))
    story.phase(400, Phase.OVER, "The pass is over.")
    assert log.flush()
    text = run("log", "show", 1).stdout
    level = text.split("level against elevation, counts; ")[1].split("\n\n")[0].splitlines()
    assert level[0].startswith("bars from 384 to 494;"), level[0]
    assert level[1].split() == ["EL", "RISING", "±", "N", "SETTING", "±", "N"]
    assert " ".join(level[2].split()[:3]) == "45 to 50°"
    rows = {line.split()[0]: line for line in level[2:]}
    assert rows["20"].split()[3:6] == ["389", "6.1", "10"], rows["20"]
    assert rows["45"].count("█") > 3 * rows["20"].count("█")
    assert max(map(len, text.splitlines())) <= 80 or str(tmp_path) in text
    assert "SNR against elevation, dB" in text
    made = text.split("files that hooks made\n")[1].splitlines()
    assert made[1].split() == ["2.5", "MB", "1", str(tmp_path / "iq.raw")]
    assert made[2].split(maxsplit=2) == ["gone", "-", f"{tmp_path / 'gone.raw'} (never seen)"]
    told = as_json(run("log", "show", 1, "--json"))
    bins = {(each["way"], each["low_deg"]): each for each in told["level_by_elevation"]}
    assert bins["rising", 20.0]["n"] == 10
    assert bins["setting", 20.0]["mean"] == pytest.approx(389.0, abs=1.0)
    assert {each["unit"] for each in told["snr_by_elevation"]} == {"dB"}
    assert [(each["exists"], each["size_bytes"]) for each in told["files"]] == [(True, 2_500_000), (False, None)]
    log.close(2.0)


def test_a_pass_without_readings_or_files_has_a_dash(run, as_json, three_passes):
    text = run("log", "show", 1).stdout
    assert "heard          -\nfiles          -\n" in text
    told = as_json(run("log", "show", 1, "--json"))
    assert (told["level_by_elevation"], told["snr_by_elevation"], told["files"]) == ([], [], [])


def test_csv_is_the_file_again(run, three_passes):
    text = run("log", "--csv", 2).stdout
    (file,) = three_passes.passes.glob("*METEOR*")
    assert text == file.read_text()
    rows = list(csv.DictReader(line for line in text.splitlines() if not line.startswith("#")))
    assert (len(rows), rows[50]["error_deg"], rows[50]["signal"], rows[50]["unit"]) == (100, "1.5", "512.0", "counts")


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("show", "9"), "No such pass in the log: 9"),
        (("show", "x"), "log show NUMBER"),
        (("shown",), "log show NUMBER"),
        (("--csv", "9"), "No such pass in the log: 9"),
        (("show", "9" * 30), "No such pass in the log:"),
    ],
)
def test_what_is_not_there_is_said(run, three_passes, words, said):
    result = run("log", *words)
    assert (result.exit_code, result.stdout) == (2, "")
    assert said in result.stderr


def test_a_damaged_journal_is_said(run, three_passes):
    other = Paths.default()
    other.journal.with_name("x").write_text("")
    for file in other.journal.parent.glob("journal.sqlite*"):
        file.unlink()
    other.journal.write_bytes(b"no database at all" * 100)
    result = run("log")
    assert result.exit_code != 0
    assert "journal.sqlite is damaged" in result.stderr
