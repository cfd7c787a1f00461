"""Every command on a Trav'ler: the third line of `pos`, what it does by itself, and what it is not."""

from __future__ import annotations

import signal

import pytest

FAST = 4.0
"""A dish that is so much quicker than a real one, where how long it takes is not what is looked at."""


@pytest.fixture
def travler(run):
    """Run `birdcage` on a simulated Trav'ler unless told otherwise."""
    return lambda *words, port="sim:hal205", **more: run(*words, port=port, firmware="hal205", **more)


def test_pos_has_a_third_line(travler, pty_travler) -> None:
    result = travler("pos", port=pty_travler.path)
    assert (result.exit_code, result.stdout) == (0, "AZ: 180.0\nEL: 45.0\nSK: 90.0\n"), result.stderr
    assert pty_travler.moves() == []


def test_pos_in_json_has_the_skew(travler, as_json) -> None:
    found = as_json(travler("pos", "--json"))
    assert (found["azimuth_deg"], found["elevation_deg"], found["skew_deg"]) == (180.0, 45.0, 90.0)


def test_move_ends_at_its_target(travler, pty_travler) -> None:
    result = travler("move", "--az", 183, "--el", 44, port=pty_travler.path)
    assert result.exit_code == 0, result.stderr
    truth = pty_travler.device.truth()
    assert (truth.az_deg, truth.el_deg) == (pytest.approx(183, abs=0.1), pytest.approx(44, abs=0.1))
    assert "SK: 90.0" in result.stdout


def test_the_floor_is_its_own(travler, pty_travler) -> None:
    result = travler("move", "--az", 180, "--el", 10, port=pty_travler.path)
    assert result.exit_code == 4
    assert "below the floor of 15.00°" in result.stderr
    assert pty_travler.moves() == []


@pytest.mark.parametrize("words", [("home",), ("home", "--yes"), ("home", "az", "--yes")])
def test_home_is_refused_with_the_reason_and_opens_nothing(travler, pty_travler, words) -> None:
    result = travler(*words, port=pty_travler.path)
    assert result.exit_code == 4
    assert "homes only at power-up. Switch it off and on" in result.stderr
    assert pty_travler.lines() == []


def test_init_ends_the_search_and_says_how_long_that_holds(travler, pty_travler) -> None:
    result = travler("init", port=pty_travler.path)
    assert result.exit_code == 0, result.stderr
    assert "Trav'ler, speaks hal205" in result.stderr
    assert "Its TV search is ended until the next power-up" in result.stderr
    assert "SK 90.00°" in result.stderr
    assert "NVS 20" not in result.stderr
    assert "ngsearch" in pty_travler.lines()


def test_init_tells_json_how_it_is(travler, as_json) -> None:
    found = as_json(travler("init", "--disable-search", "--json"))
    assert found["search"] == "off until power-up"
    assert found["skew_deg"] == 90.0
    assert found["modelled"] is False


def test_no_setting_gives_the_search_back(travler, pty_travler) -> None:
    result = travler("init", "--restore-search", "--yes", port=pty_travler.path)
    assert result.exit_code == 2
    assert "starts at each power-up" in result.stderr
    assert pty_travler.lines() == []


def test_status_tells_search_skew_and_what_stop_can_do(travler, as_json) -> None:
    found = as_json(travler("status", "--json"))
    assert found["firmware"] == "hal205"
    assert found["skew_deg"] == 90.0
    assert {"modelled", "search", "stop_power_s", "stop_means", "rests_in_s", "target_skew_deg"} <= set(found)


def test_stop_says_what_was_done(travler) -> None:
    result = travler("stop")
    assert result.exit_code == 0, result.stderr
    assert "stands still" in result.stdout.lower()


def test_ctrl_c_in_a_move_stops_it_and_exits_130(pty_travler, start) -> None:
    process = start("move", "--az", 300, "--el", 60, "--port", pty_travler.path, "--firmware", "hal205")
    pty_travler.wait_for_motion()
    process.send_signal(signal.SIGINT)
    _, said = process.communicate(timeout=60)
    assert process.returncode == 130, said
    pty_travler.wait_for(lambda truth: not truth.moving)
    truth = pty_travler.device.truth()
    assert (truth.az_deg, truth.el_deg) != (pytest.approx(300, abs=1), pytest.approx(60, abs=1)), "it went on"


@pytest.mark.parametrize("words", [("pos",), ("move", "--az", 10, "--el", 40), ("init",)])
def test_another_dish_than_was_named_is_told_in_a_sentence_and_not_moved(travler, pty_dish, words) -> None:
    result = travler(*words, "--baud", 115200, port=pty_dish.path)
    assert result.exit_code == 2, result.stderr
    assert "a Carryout G2 is --firmware g2" in result.stderr
    assert "Nothing was moved." in result.stderr
    assert pty_dish.moves() == []


@pytest.mark.parametrize("pty_travler", [(FAST, "seed=1&boot=1&boot_home_s=6")], indirect=True)
def test_init_of_a_booting_dish_tells_the_boot_without_prompts_and_waits_until_it_rests(travler, pty_travler) -> None:
    result = travler("init", port=pty_travler.path)
    assert result.exit_code == 0, result.stderr
    assert "No LNB Voltage" in result.stderr
    assert ">" not in result.stderr
    assert "The dish moves by itself: its TV search" not in result.stderr
    assert "Its TV search is ended" in result.stderr
