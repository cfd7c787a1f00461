"""`init`, `home` and `status`."""

from __future__ import annotations

from pathlib import Path

import pytest


@pytest.fixture(autouse=True)
def _quick_line(monkeypatch) -> None:
    """Let a line count as quiet sooner: settings are read after twice this delay."""
    monkeypatch.setenv("BIRDCAGE_LINK_DELAY_S", "0.3")


KEYS = {
    "connected", "firmware", "port", "azimuth_deg", "elevation_deg", "age_s", "homed", "activity", "held", "search",
    "turn_of_cable", "stop_power_s", "demo",
}  # fmt: skip


def test_status_has_what_was_promised(run, as_json) -> None:
    result = run("status", "--json")
    status = as_json(result)
    assert result.exit_code == 0, result.stderr
    assert set(status) >= KEYS
    assert {key: status[key] for key in ("connected", "firmware", "port", "homed", "held", "search", "demo")} == {
        "connected": True, "firmware": "g2", "port": "sim:g2", "homed": True, "held": False, "search": "off",
        "demo": True,
    }  # fmt: skip
    assert (status["azimuth_deg"], status["elevation_deg"]) == (0.0, 45.0)
    assert 0 <= status["age_s"] < 5
    assert status["turn_of_cable"] is status["stop_power_s"] is None


def test_a_quick_status_does_not_guess(run, as_json) -> None:
    status = as_json(run("status", "--quick", "--json", port="sim:g2?unhomed=1"))
    assert status["homed"] is False
    assert status["azimuth_deg"] is status["elevation_deg"] is status["age_s"] is status["search"] is None


def test_status_for_people_shows_dashes(run) -> None:
    lines = dict(line.split(None, 1) for line in run("status", "--quick").stdout.splitlines())
    assert lines["connected"] == "yes"
    assert lines["search"].strip() == "-"


def test_home_needs_a_yes_and_names_the_consequence(run, pty_dish) -> None:
    result = run("home", port=pty_dish.path)
    assert result.exit_code == 2
    assert "Only cutting the power stops it" in result.stderr
    assert pty_dish.lines() == []


@pytest.mark.soak
def test_home_finds_both_references(run) -> None:
    result = run("home", "--yes", port="sim:g2?unhomed=1&az_speed=300&el_speed=300")
    assert result.exit_code == 0, result.stderr
    assert result.stdout.startswith("AZ: ")
    assert "Homing the azimuth. Homing has no STOP. In an emergency, switch off its 12 V." in result.stderr
    assert "Homing the elevation" in result.stderr


def test_home_of_one_axis_moves_only_that(run, pty_dish) -> None:
    assert run("home", "el", "--yes", port=pty_dish.path).exit_code == 0
    assert [line for line in pty_dish.lines() if line.startswith("h")] == ["h 1"]


@pytest.mark.parametrize("pty_dish", ["unhomed=1"], indirect=True)
def test_home_of_one_axis_is_not_enough_for_a_dish_that_has_homed_neither(run, pty_dish) -> None:
    result = run("home", "el", "--yes", port=pty_dish.path)
    assert (result.exit_code, result.stdout) == (4, "")
    assert "Home the other axis too" in result.stderr


def test_init_of_a_dish_that_is_up_is_quick_and_moves_nothing(run, as_json, pty_dish) -> None:
    result = run("init", "--json", port=pty_dish.path)
    assert result.exit_code == 0, result.stderr
    assert as_json(result)["search"] == "off"
    assert "Its TV search is off (NVS 20 is TRUE)" in result.stderr
    assert [line for line in pty_dish.moves() if line != "a"] == []


def test_init_follows_the_boot_and_its_time(run) -> None:
    result = run("init", port="sim:g2?boot=1")
    assert result.exit_code == 0, result.stderr
    assert " s  Boot Complete" in result.stderr
    assert "The dish is not homed" in result.stderr
    assert "Ready." not in result.stderr, "it does not know where it points"


def test_init_never_waits_without_end(run, pty_dish) -> None:
    pty_dish.device.power_off()
    result = run("init", "--timeout", 2, port=pty_dish.path)
    assert result.exit_code == 3
    assert "power" in result.stderr


def test_the_search_is_switched_off_and_back_with_a_backup(run, pty_dish) -> None:
    refused = run("init", "--restore-search", port=pty_dish.path)
    assert refused.exit_code == 2
    assert "it moves by itself" in refused.stderr
    for switch, value in (("--restore-search", "0"), ("--disable-search", "1")):
        result = run("init", switch, "--yes", port=pty_dish.path)
        assert result.exit_code == 0, result.stderr
        assert "Now switch the dish off and on." in result.stderr
        assert f"e 20 {value}" in pty_dish.lines()
        kept = next(line for line in result.stderr.splitlines() if "Backup of" in line)
        table = Path(kept.partition("settings: ")[2].rstrip(".")).read_text()
        assert "Disable Tracker" in table
    lines = pty_dish.lines()
    assert lines.index("d") < lines.index("e 20 0")


def test_explains_what_a_dish_with_its_search_on_will_do(run) -> None:
    result = run("init", port="sim:g2?nvs20=0")
    assert "NVS 20 is FALSE: at power-up this dish homes, then searches" in result.stderr
    assert "--disable-search" in result.stderr


def test_status_tells_the_wear_of_each_axis(run, as_json) -> None:
    assert run("move", "--az", "30", "--el", "45").exit_code == 0
    wear = as_json(run("status", "--quick", "--json"))["wear"]
    assert wear["azimuth"]["moves"] == 1
    assert wear["azimuth"]["degrees"] == pytest.approx(30.0, abs=0.2)
    shown = dict(line.split(None, 1) for line in run("status", "--quick").stdout.splitlines())["wear"]
    assert shown.startswith("azimuth 30°, moves 1, reversals 0")
