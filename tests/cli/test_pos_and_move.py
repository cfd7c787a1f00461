"""`pos` and `move` as a person and a script meet them."""

from __future__ import annotations

import re
from datetime import UTC, datetime

import pytest
from birdcage.cli.say import position_lines
from birdcage.station.state import Pointing


@pytest.mark.parametrize(("az", "el", "sk", "shown"), [
    (180.0, 45.0, None, "AZ: 180.0\nEL: 45.0"), (0.004, 45.126, None, "AZ: 0.0\nEL: 45.13"),
    (359.999, -0.001, None, "AZ: 0.0\nEL: 0.0"), (8.12, 34.7, -0.001, "AZ: 8.12\nEL: 34.7\nSK: 0.0"),
])  # fmt: skip
def test_a_position_looks_as_documented(az, el, sk, shown) -> None:
    assert position_lines(Pointing(az, el, az, el, 0.0, datetime(2026, 3, 20, tzinfo=UTC), None, sk)) == shown


def test_pos_prints_two_lines_and_asks_until_two_answers_agree(run, pty_dish) -> None:
    result = run("pos", port=pty_dish.path)
    assert (result.exit_code, result.stdout, result.stderr) == (0, "AZ: 0.0\nEL: 45.0\n", "")
    assert pty_dish.lines().count("a") == 2


def test_pos_in_json_says_that_the_dish_is_simulated(run, as_json) -> None:
    assert as_json(run("pos", "--json")) == {
        "azimuth_deg": 0.0, "elevation_deg": 45.0, "skew_deg": None, "modelled": False, "uncertainty_deg": None,
        "port": "sim:g2", "demo": True,
    }  # fmt: skip


@pytest.mark.parametrize("pty_dish", ["az=-270&el=30", "az=-180&el=45"], indirect=True, ids=["90/30", "180/45"])
def test_move_ends_at_its_target(run, as_json, pty_dish) -> None:
    result = run("move", "--az", 180, "--el", 45, "--json", port=pty_dish.path)
    assert result.exit_code == 0, result.stderr
    truth = pty_dish.device.truth()
    assert not truth.moving
    assert truth.az_deg == pytest.approx(180, abs=0.06)
    assert truth.el_deg == pytest.approx(45, abs=0.06)
    assert as_json(result)["azimuth_deg"] == pytest.approx(truth.az_deg, abs=0.01)


WAITS = "second_move=block&second_other=block&az=-180&el=45"


@pytest.mark.parametrize("pty_dish", [WAITS], indirect=True, ids=["waits"])
def test_a_dish_that_waits_for_its_motor_is_not_called_deadlocked_and_stays_where_it_was_sent(run, pty_dish, tmp_path):
    """Reference 2.6: the elevation is taken, and answered, when the azimuth has stopped."""
    at_home = {"BIRDCAGE_HOME": str(tmp_path)}
    result = run("move", "--az", 0, "--el", 30, port=pty_dish.path, env=at_home)
    assert result.exit_code == 0, result.stderr
    assert "deadlock" not in result.stderr
    assert [line.split()[:2] for line in pty_dish.moves()] == [["a", "0"], ["a", "1"]], "and no target of STOP's"
    truth = pty_dish.device.truth()
    assert not truth.moving
    assert truth.el_deg == pytest.approx(30, abs=0.06)
    (remembered,) = tmp_path.glob("state/dishes/*/facts.json")
    assert "block" in remembered.read_text()


@pytest.mark.parametrize("pty_dish", ["move_reply=none&az=-180&el=45"], indirect=True, ids=["answers nothing"])
def test_a_move_that_is_answered_with_nothing_arrives(run, pty_dish):
    result = run("move", "--az", 170, "--el", 40, port=pty_dish.path)
    assert result.exit_code == 0, result.stderr


@pytest.mark.parametrize(("target", "said"), [
    ((10, 80), "15.00° above the limit of 65.00°"), ((10, 5), "13.00° below the floor of 18.00°"),
])  # fmt: skip
def test_a_limit_is_named_and_nothing_is_sent(run, pty_dish, target, said) -> None:
    result = run("move", "--az", target[0], "--el", target[1], port=pty_dish.path)
    assert result.exit_code == 4
    assert result.stdout == ""
    assert said in result.stderr
    assert pty_dish.moves() == []


def test_clamp_goes_to_the_limit(run) -> None:
    result = run("move", "--az", 5, "--el", 80, "--clamp")
    assert result.exit_code == 0, result.stderr
    assert float(re.search(r"EL: (\S+)", result.stdout)[1]) == pytest.approx(65, abs=0.06)


@pytest.mark.parametrize("words", [("--az", "nan", "--el", 45), ("--az", 10, "--el", "inf"), ("--az", 10)])
def test_no_number_is_a_usage_error(run, words) -> None:
    assert run("move", *words).exit_code == 2


def test_leapfrog_aims_beyond_and_its_opposite_is_accepted(run, pty_dish) -> None:
    assert run("move", "--az", 10, "--el", 45, "--no-leapfrog", port=pty_dish.path).exit_code == 0
    assert "a 0 10.00" in pty_dish.moves()
    result = run("move", "--az", 20, "--el", 45, "--leapfrog", port=pty_dish.path)
    assert result.exit_code == 0, result.stderr
    assert "a 0 21.00" in pty_dish.moves()
    assert "Leap-frog: aiming at AZ 21.00°" in result.stderr


def test_no_wait_leaves_the_dish_moving(run, pty_dish) -> None:
    result = run("move", "--az", 200, "--el", 45, "--no-wait", port=pty_dish.path)
    assert (result.exit_code, result.stdout) == (0, "")
    assert "STOP should take 0.3 s. `birdcage stop` calls STOP." in result.stderr
    assert pty_dish.device.truth().moving
    pty_dish.wait_for(lambda truth: not truth.moving)
    assert pty_dish.device.truth().az_deg == pytest.approx(200, abs=0.06)


def test_a_dish_that_gets_stuck_is_not_reported_as_there(run, pty_dish) -> None:
    pty_dish.device.stall(0)
    result = run("move", "--az", 30, "--el", 45, port=pty_dish.path)
    assert result.exit_code == 1
    assert result.stdout == ""
    assert "from its target" in result.stderr or "STALLED" in result.stderr


def test_a_move_that_takes_too_long_is_stopped(run, pty_dish) -> None:
    result = run("move", "--az", 200, "--el", 45, "--timeout", 1, port=pty_dish.path)
    assert result.exit_code == 1
    assert "Not done within 1 s." in result.stderr
    assert "The dish was last seen at" in result.stderr.splitlines()[-1]
    assert not pty_dish.device.truth().moving
    assert pty_dish.device.truth().az_deg != pytest.approx(200, abs=5)


def test_a_dish_that_is_not_homed_has_no_position(run) -> None:
    for words in (("pos",), ("move", "--az", 10, "--el", 40)):
        result = run(*words, port="sim:g2?unhomed=1")
        assert (result.exit_code, result.stdout) == (4, "")
        assert "not homed" in result.stderr
