"""`birdcage sweep`: a line for each direction, then the beam."""

from __future__ import annotations

import json
import os
import re

import pytest

from tests.cli.test_peak import AZ_DEG, EL_DEG
from tests.signal.stand_ins import program


@pytest.fixture(autouse=True)
def _quick_line(monkeypatch):
    monkeypatch.setenv("BIRDCAGE_LINK_DELAY_S", "0.3")


def test_each_direction_is_a_line_and_the_last_one_says_where_the_peak_is(run):
    result = run("sweep", "az", f"{AZ_DEG:.2f}", f"{EL_DEG:.2f}", "--span", "14", "--step", "2")
    assert result.exit_code == 0, result.stderr
    *lines, last = result.stdout.splitlines()
    assert len(lines) == 8
    assert all(re.fullmatch(r" *[\d.]+ +[\d.]+ +[\d.]+ ±\d\.\d", line) for line in lines), lines
    peak = re.fullmatch(r"Peak at azimuth ([\d.]+)° ±0\.\d\d°, 1\d\d over the floor of \d+, [\d.]+° wide\.", last)
    assert peak, last
    assert float(peak[1]) == pytest.approx(AZ_DEG, abs=0.4)


def test_as_json_where_nothing_is_heard_the_line_is_told_with_status_1(run):
    result = run("sweep", "el", "10", "50", "--span", "4", "--step", "2", "--json")
    assert result.exit_code == 1
    assert '"line": [[' in result.stdout
    assert "No source stands out of the floor on this line." in result.stderr


@pytest.mark.parametrize("words", [("skew",), ("az", "--span", "0"), ("az", "--step", "0")])
def test_what_is_no_sweep_is_refused(run, words):
    assert run("sweep", *words).exit_code == 2


def test_a_dish_without_a_tuner_is_not_moved(run):
    result = run("sweep", "az", "60", "60", port="sim:hal205", firmware="hal205")
    assert result.exit_code == 1
    assert "has no tuner to read. With --source your receiver is heard. Nothing was sent." in result.stderr


def test_a_program_that_it_hears_by_ends_with_the_command(run, tmp_path):
    note = tmp_path / "pid"
    text = f"import os, time, itertools; open({str(note)!r}, 'w').write(str(os.getpid())); "
    text += "[(print(-41.5), time.sleep(0.05)) for _ in itertools.count()]"
    file = tmp_path / "own.toml"
    file.write_text(f'[signal.meter]\ncommand = """{program(text)}"""\nevery_s = 0.1\n')
    words = ("sweep", "el", "--span", 2, "--step", 1, "--source", "meter")
    result = run("--config", file, *words, port="sim:g2")
    assert result.exit_code == 1, result.stderr
    assert "No source stands out of the floor on this line." in result.stderr
    with pytest.raises(ProcessLookupError):
        os.kill(int(note.read_text()), 0)


def test_a_dish_that_does_not_tell_where_it_points_is_sent_to_the_named_target(run, tmp_path):
    file = tmp_path / "own.toml"
    text = "import time, itertools; [(print(-41.5), time.sleep(0.05)) for _ in itertools.count()]"
    file.write_text(f'[signal.meter]\ncommand = """{program(text)}"""\nevery_s = 0.1\n')
    untold = ("--config", file, "sweep", "el", "--span", "2", "--step", "1", "--source", "meter")
    refused = run(*untold, port="sim:carryout", firmware="carryout")
    assert refused.exit_code == 4
    assert "only once it has moved. Name a TARGET. Nothing was sent." in refused.stderr
    swept = run(*untold, "180", "40", port="sim:carryout", firmware="carryout")
    assert "No source stands out of the floor on this line." in swept.stderr
    assert [line.split()[:2] for line in swept.stdout.splitlines()] == [
        ["180.00", "39.00"], ["180.00", "40.00"], ["180.00", "41.00"],
    ]  # fmt: skip


BY_ITSELF = ("--by", "firmware")


def test_the_firmware_sweeps_and_its_directions_are_lines_too(run):
    result = run("sweep", "az", AZ_DEG, EL_DEG, "--span", 14, "--step", 2, *BY_ITSELF, "--transponders", 2)
    assert result.exit_code == 0, result.stderr
    *lines, last = result.stdout.splitlines()
    assert len(lines) == 8
    assert all(re.fullmatch(r" *[\d.]+ +[\d.]+ +[\d.]+ ±\d\.\d", line) for line in lines), lines
    assert last.endswith("The transponder may have changed.")
    assert float(last.split()[3].rstrip("°")) == pytest.approx(AZ_DEG, abs=0.4)


def test_a_line_that_does_not_fit_on_both_sides_is_refused_in_words(run):
    result = run("sweep", "el", AZ_DEG, EL_DEG, "--span", 16, *BY_ITSELF)
    assert result.exit_code == 1
    assert "must be free on both sides of where it begins" in result.stderr
    assert "Nothing was sent." in result.stderr
    assert not result.stdout


def test_a_dish_that_does_not_sweep_by_itself_says_so(run):
    result = run("sweep", "az", "60", "60", *BY_ITSELF, port="sim:hal205", firmware="hal205")
    assert result.exit_code == 1
    assert "has no sweep of its own. Sweep it by steps. Nothing was sent." in result.stderr


@pytest.mark.parametrize(("words", "why"), [
    (("--transponders", "3"), "--transponders needs --by firmware."),
    ((*BY_ITSELF, "--source", "meter"), "hears by the dish's own tuner, not by meter."),
    ((*BY_ITSELF, "--transponders", "33"), "33 is not in the range"),
])  # fmt: skip
def test_options_that_do_not_go_together_are_refused(run, words, why):
    result = run("sweep", "az", *words)
    assert result.exit_code == 2
    assert why in " ".join(result.stderr.split())


def test_what_was_heard_before_it_was_cut_short_is_told_as_json_too(run, tmp_path):
    text = "import time; [(print(-41.5), time.sleep(0.05)) for _ in range(50)]; time.sleep(60)"
    file = tmp_path / "own.toml"
    file.write_text(f'[signal.meter]\ncommand = """{program(text)}"""\nevery_s = 0.1\n')
    words = ("sweep", "el", "--span", 20, "--step", 1, "--source", "meter", "--json")
    result = run("--config", file, *words, port="sim:g2")
    assert result.exit_code == 1, result.stdout
    assert "The signal is lost." in result.stderr
    told = json.loads(result.stdout)
    assert (told["complete"], told["demo"], told["axis"]) == (False, True, "el")
    assert 1 <= len(told["line"]) < 21
    assert all(mean == -41.5 for _az, _el, mean, _scatter, _count in told["line"])
