"""`birdcage rssi`: readings on stdout, what they come to on stderr; on a port of its own and through a station."""

from __future__ import annotations

import json
import re
import statistics
import sys
import threading

import pytest
from birdcage.base.clock import VirtualClock
from birdcage.cli.rssi_run import Summary
from birdcage.signal.source import SignalReading
from birdcage.signal.tuner import TUNER_FACTS
from birdcage.station.requests import Goto

from tests.signal.stand_ins import program

LINE = re.compile(r"\d\d:\d\d:\d\d\.\d\dZ +(\d+\.\d\d|--) +(\d+\.\d\d|--) {2}\d+ counts")


@pytest.fixture(autouse=True)
def _quick_line(monkeypatch):
    monkeypatch.setenv("BIRDCAGE_LINK_DELAY_S", "0.3")


def test_so_many_readings_a_line_each_and_a_summary_beside_them(run):
    result = run("rssi", "--count", 8)
    assert result.exit_code == 0, result.stderr
    lines = result.stdout.splitlines()
    assert len(lines) == 8
    assert all(LINE.fullmatch(line) for line in lines), lines
    assert re.search(r"8 readings, \d+\.\d a second: mean 4\d\d\.\d ±\d\.\d counts, highest \d+ at ", result.stderr)


def test_the_seconds_count_from_the_first_reading(run):
    result = run("rssi", "--seconds", 1, "--json")
    told = [json.loads(line) for line in result.stdout.splitlines()]
    assert 4 <= len(told) <= 14
    first = told[0]
    assert (first["unit"], first["source"], first["demo"], first["port"]) == ("counts", "tuner", True, "sim:g2")
    assert first["utc"].endswith("Z")
    assert first["elevation_deg"] == pytest.approx(45.0, abs=0.1)


def test_through_a_station_the_other_program_reads_and_reads_no_more_afterwards(run, pty_dish, owner):
    owner.station.submit(Goto(20.0, 47.0, "app")).result(30)
    result = run("rssi", "--count", 5, "--json", port=pty_dish.path)
    told = [json.loads(line) for line in result.stdout.splitlines()]
    assert len(told) == 5, result.stderr
    assert told[-1]["azimuth_deg"] == pytest.approx(20.0, abs=0.1)
    assert owner.station.state.holder == "app"
    pty_dish.wait_for(lambda _truth: "monitor" not in owner.station.state.signal_owners.values())
    threading.Event().wait(0.5)
    heard = owner.station.state.readings["rssi"]
    threading.Event().wait(1.0)
    assert owner.station.state.readings["rssi"] is heard


def test_a_dish_without_a_tuner_says_what_to_do(run):
    result = run("rssi", "--count", 1, firmware="hal205", port="sim:hal205")
    assert (result.exit_code, result.stdout) == (1, "")
    assert "has no tuner to read. s on F3 or --source NAME" in result.stderr


def test_without_a_reading_nothing_is_summed_up():
    assert Summary(TUNER_FACTS).words() == ""


def test_mean_and_scatter_are_those_of_all_readings():
    clock, summary = VirtualClock(), Summary(TUNER_FACTS)
    values = [400.0, 401.0, 399.0, 550.0, 398.0]
    for index, value in enumerate(values):
        reading = SignalReading(value, "counts", clock.monotonic() + index, clock.utc(), "tuner")
        summary.take(reading, (10.0 * index, 30.0))
    assert (summary.mean, summary.best_from) == (pytest.approx(statistics.mean(values)), (30.0, 30.0))
    spread = statistics.stdev(values)
    assert (
        summary.words() == f"5 readings, 1.0 a second: mean 429.6 ±{spread:.1f} counts, highest 550 at 30.00 / 30.00."
    )


def test_a_program_of_its_owner_is_heard_by_its_name(run, tmp_path):
    command = program("import time, itertools; [(print(-41.5), time.sleep(0.05)) for _ in itertools.count()]")
    file = tmp_path / "own.toml"
    file.write_text(f'[signal.meter]\ncommand = """{command}"""\nunit = "dBm"\nevery_s = 0.1\n')
    result = run("--config", file, "rssi", "--source", "meter", "--count", 3, port="sim:hal205", firmware="hal205")
    assert result.exit_code == 0, result.stderr
    assert [line.split()[-2:] for line in result.stdout.splitlines()] == [["-41.5", "dBm"]] * 3
    assert "mean -41.50" in result.stderr


def test_a_source_that_there_is_not_is_refused_with_those_that_there_are(run):
    result = run("rssi", "--source", "satdmp", port="sim:g2")
    assert result.exit_code == 2
    assert "There is no source 'satdmp'. There are tuner, rigctl, satdump" in result.stderr


def test_a_program_that_is_not_there_is_said_and_nothing_is_waited_for_without_end(run, tmp_path, monkeypatch):
    file = tmp_path / "own.toml"
    file.write_text('[signal.meter]\ncommand = "no-such-program"\n')
    monkeypatch.setattr("birdcage.cli.rssi_run.FIRST_S", 1.0)
    result = run("--config", file, "rssi", "--source", "meter", "--count", 1, port="sim:hal205", firmware="hal205")
    assert result.exit_code == 3
    assert "There is no program 'no-such-program'" in result.stderr


def test_what_is_recorded_is_listed_and_printed_as_csv(run, as_json):
    result = run("rssi", "--count", 5, "--record")
    assert "Recording 1: 5 readings." in result.stderr
    (told,) = as_json(run("recordings", "--json"))["recordings"]
    assert (told["number"], told["readings"], told["source"], told["demo"]) == (1, 5, "tuner", True)
    assert "5 readings" in run("recordings").stdout
    printed = run("recordings", "--csv", 1).stdout.splitlines()
    assert printed[0].startswith("# DEMO")
    assert len([line for line in printed if not line.startswith("#")]) == 6
    missing = run("recordings", "--csv", 7)
    assert missing.exit_code == 2
    assert "There is no recording 7" in missing.stderr


def test_a_source_that_falls_silent_says_why_once_and_is_waited_for(run, tmp_path):
    mark, script, file = tmp_path / "again", tmp_path / "meter.py", tmp_path / "own.toml"
    script.write_text(f"""
import os, time
if os.path.exists({str(mark)!r}):
    time.sleep(2.9)
print(-41.5, flush=True)
open({str(mark)!r}, "w").close()
print("device busy", flush=True)
raise SystemExit(3)
""")
    file.write_text(f'[signal.meter]\ncommand = "{sys.executable} {script}"\nevery_s = 0.1\n')
    result = run("--config", file, "rssi", "--source", "meter", "--count", 2, port="sim:hal205", firmware="hal205")
    assert result.exit_code == 0, result.stderr
    assert len(result.stdout.splitlines()) == 2
    assert result.stderr.count("has ended with exit status 3: device busy. Still waiting.") == 1, result.stderr


def test_a_recording_that_stops_is_told_at_once_while_the_readings_go_on(run, monkeypatch):
    monkeypatch.setattr("birdcage.signal.recording.MOST_READINGS", 3)
    result = run("rssi", "--seconds", 3, "--record")
    assert result.exit_code == 0, result.stderr
    told, summary, again = result.stderr.splitlines()[-3:]
    assert told == again
    assert re.fullmatch(r"The recording is full with \d+ readings\. They are kept; begin another one\.", told)
    assert " a second: mean " in summary


def test_a_command_of_several_lines_in_the_settings_keeps_them_and_is_shown_in_one(run, tmp_path):
    text = "import time\\nfor each in range(9):\\n    print(-41.5, flush=True)\\n    time.sleep(0.05)"
    file = tmp_path / "own.toml"
    file.write_text(f"[signal.meter]\ncommand = \"{sys.executable} -c '{text}'\"\nevery_s = 0.1\n")
    result = run("--config", file, "rssi", "--source", "meter", "--count", 3, port="sim:hal205", firmware="hal205")
    assert result.exit_code == 0, result.stderr
    shown = run("--config", file, "config", "show").stdout
    assert "import time for each in range(9):     print" in shown
