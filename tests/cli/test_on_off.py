"""`birdcage on-off`, `drift` and `step-track`: what they print, and what they refuse."""

from __future__ import annotations

import re

import pytest

from tests.cli.test_peak import AZ_DEG, EL_DEG


@pytest.fixture(autouse=True)
def _quick_line(monkeypatch):
    monkeypatch.setenv("BIRDCAGE_LINK_DELAY_S", "0.3")


def test_a_satellite_stands_over_the_sky_above_it(run):
    result = run("on-off", f"{AZ_DEG:.2f}", f"{EL_DEG:.2f}", "--axis", "el", "--away", "14", "--cycles", "2")
    assert result.exit_code == 0, result.stderr
    told = re.fullmatch(
        r"\+(\d+\.\d) ±\d+\.\d counts on the source against the sky 14\.0° beside it \([\d.]+ and [\d.]+\)\.\n",
        result.stdout,
    )
    assert told, result.stdout
    assert float(told[1]) > 80.0


def test_as_json_with_the_unit_and_that_it_is_simulated(run, as_json):
    told = as_json(run("on-off", "60", "50", "--cycles", "2", "--away", "10", "--json"))
    assert told["unit"] == "counts"
    assert told["demo"] is True
    assert abs(told["difference"]) < 5.0


@pytest.mark.parametrize("words", [
    ("on-off", "60", "50", "--cycles", "1"), ("on-off", "--away", "0"), ("drift",), ("drift", "180", "40"),
    ("step-track", "--hours", "0"), ("step-track", "--every", "1"),
])  # fmt: skip
def test_what_makes_no_sense_is_refused(run, words):
    result = run(*words)
    assert result.exit_code == 2, result.stdout


def test_what_stands_still_does_not_drift(run):
    result = run("drift", "180", "40")
    assert "stands still on the sky: it can't drift through the beam." in result.stderr


def test_step_track_prints_its_peaks_and_ends_with_its_time(run):
    words = ("step-track", f"{AZ_DEG + 1.0:.2f}", f"{EL_DEG:.2f}", "--hours", "0.01", "--name", "slot")
    result = run(*words)
    assert result.exit_code == 0, result.stderr
    peak = re.search(r"Peak 1 at ([\d.]+)°/([\d.]+)° ±0\.\d\d°", result.stdout)
    assert peak, result.stdout
    assert float(peak[1]) == pytest.approx(AZ_DEG, abs=0.4)
    assert "The time is over. The dish stays on the satellite." in result.stderr
