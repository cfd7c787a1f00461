"""`birdcage levels`: two known levels are kept, shown, refused in words, and `rssi` tells decibels by them."""

from __future__ import annotations

import json
import re

import pytest


@pytest.fixture(autouse=True)
def _quick_line(monkeypatch):
    monkeypatch.setenv("BIRDCAGE_LINK_DELAY_S", "0.3")


def test_they_are_kept_shown_and_removed(run):
    assert "No levels are known." in run("levels").stderr
    kept = run("levels", "set", "401=0", "451=12.5dB")
    assert (kept.exit_code, kept.stderr) == (0, "")
    line = "tuner, feed stock-ku: 401 counts = 0 dB, 451 counts = 12.5 dB (0.250 dB a count)\n"
    assert (kept.stdout, run("levels").stdout) == (line, line)
    told = json.loads(run("levels", "--json").stdout)
    assert told == [{"source": "tuner", "feed": "stock-ku", "db_per_step": 0.25,
                     "levels": [{"value": 401.0, "db": 0.0}, {"value": 451.0, "db": 12.5}]}]  # fmt: skip
    assert "Removed: 401 counts = 0 dB" in run("levels", "remove").stderr
    again = run("levels", "remove")
    assert (again.exit_code, "No levels are known of the tuner" in again.stderr) == (2, True)


@pytest.mark.parametrize(("words", "said"), [
    (("401=0", "401=3"), "Both levels are 401."), (("401", "451=3"), "'401' is no level. Type 401=0"),
    (("401=6", "451=3"), "The stronger level, 451, must have more than 6 dB. It has 3."),
])  # fmt: skip
def test_wrong_levels_are_refused_and_nothing_is_kept(run, words, said):
    result = run("levels", "set", *words)
    assert result.exit_code == 2
    assert said in result.stderr
    assert run("levels").stdout == ""


def test_rssi_tells_decibels_and_marks_what_lies_beyond(run):
    assert run("levels", "set", "1=-10", "2=-9.5").exit_code == 0
    result = run("rssi", "--count", 3)
    lines = [re.search(r" (\d+) counts {2}(-?\d+\.\d) dB( \?)?$", line) for line in result.stdout.splitlines()]
    assert len(lines) == 3
    for found in lines:
        counts, db, beyond = int(found[1]), float(found[2]), found[3]
        assert db == pytest.approx(-10.5 + counts / 2.0, abs=0.3)
        assert beyond is not None
    assert "3 readings are beyond these levels (?)." in result.stderr
    told = json.loads(run("rssi", "--count", 1, "--json").stdout)
    assert told["db"] == pytest.approx(-10.5 + told["value"] / 2.0, abs=0.01)
    assert told["db_extrapolated"] is True
    run("levels", "set", "0=0", "2000=100")
    assert " ?" not in run("rssi", "--count", 2).stdout


def test_without_levels_no_decibels_are_told(run):
    told = json.loads(run("rssi", "--count", 1, "--json").stdout)
    assert (told["db"], told["db_extrapolated"]) == (None, None)
