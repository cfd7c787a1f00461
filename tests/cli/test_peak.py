"""`birdcage peak`: the dish finds a satellite by its signal; on a port of its own, and through a station."""

from __future__ import annotations

import math
import re

import pytest
from birdcage.base.geometry import shortest_turn
from birdcage.cli.say import Progress
from birdcage.sim.almanac import geostationary
from birdcage.sim.settings import SimSettings

SETTINGS = SimSettings()
AZ_DEG, EL_DEG = geostationary(-61.5, SETTINGS.lat, SETTINGS.lon)
"""A slot that stands by itself."""


@pytest.fixture(autouse=True)
def _quick_line(monkeypatch):
    monkeypatch.setenv("BIRDCAGE_LINK_DELAY_S", "0.3")


def off_deg(az_deg, el_deg):
    return math.hypot(shortest_turn(AZ_DEG, az_deg) * math.cos(math.radians(EL_DEG)), el_deg - EL_DEG)


def test_it_ends_on_the_satellite_and_says_how_sure_that_is(run):
    result = run("peak", f"{AZ_DEG + 1.5:.2f}", f"{EL_DEG - 1.0:.2f}")
    assert result.exit_code == 0, result.stderr
    found = re.fullmatch(r"Peak at ([\d.]+)°/([\d.]+)° ±(0\.\d\d)°, 1\d\d over the floor\.\n", result.stdout)
    assert found, result.stdout
    assert off_deg(float(found[1]), float(found[2])) < 0.25


def test_through_a_station_the_same_and_control_is_given_back(run, as_json, pty_dish, owner):
    told = as_json(run("peak", f"{AZ_DEG:.2f}", f"{EL_DEG:.2f}", "--width", "6.4", "--json", port=pty_dish.path))
    assert off_deg(told["az_deg"], told["el_deg"]) < 0.25
    assert told["points"] == 25
    truth = pty_dish.device.truth()
    assert off_deg(truth.az_deg, truth.el_deg) < 0.35
    pty_dish.wait_for(lambda _truth: owner.station.state.holder is None)


def test_a_peak_of_a_target_is_kept_for_the_calibration(run, as_json):
    assert run("place", "add", "home", f"{SETTINGS.lat} {SETTINGS.lon}", "--use").exit_code == 0
    result = run("peak", "61.5W", "--calibrate", port="sim:g2?heading=1.2&seed=2")
    assert result.exit_code == 0, result.stderr
    assert "Peak 1 of the calibration: 61.5°W EchoStar 16, good to 0.0" in result.stderr
    (kept,) = as_json(run("calibrate", "list", "--json"))["peaks"]
    assert kept["found"] == "rssi"
    assert shortest_turn(kept["dish_az_deg"], kept["true_az_deg"]) == pytest.approx(1.2, abs=0.3)
    assert kept["dish_el_deg"] == pytest.approx(kept["true_el_deg"], abs=0.2)


def test_without_a_target_there_is_nothing_to_calibrate_by(run):
    result = run("peak", "--calibrate")
    assert result.exit_code == 2
    assert "--calibrate needs a TARGET" in result.stderr


def test_where_nothing_is_heard_it_says_so_with_status_1(run):
    result = run("peak", "60", "60")
    assert (result.exit_code, result.stdout) == (1, "")
    assert "No source stands out of the floor here. The dish is back in the middle of the grid." in result.stderr


def test_a_dish_without_a_tuner_is_not_moved(run):
    result = run("peak", "60", "60", port="sim:hal205", firmware="hal205")
    assert result.exit_code == 1
    assert "has no tuner to read. With --source your receiver is heard. Nothing was sent." in result.stderr


def test_beyond_the_limits_it_is_refused(run):
    result = run("peak", "150", "19")
    assert result.exit_code == 1
    assert "below the floor of 18.00°" in result.stderr


def test_a_terminal_sees_a_bar_that_grows(run, monkeypatch):
    shown = []
    monkeypatch.setattr(Progress, "show", lambda _self, text: shown.append(text))
    assert run("peak", f"{AZ_DEG:.2f}", f"{EL_DEG:.2f}").exit_code == 0
    bars = [text for text in shown if "directions heard" in text]
    assert bars[0].startswith("░" * 20 + " 0 of 25 ")
    assert "█" * 20 + " 25 of 25 directions heard …" in bars
    full = [text.count("█") for text in bars]
    assert full == sorted(full)
    assert all(text.count("█") + text.count("░") == 20 for text in bars)
