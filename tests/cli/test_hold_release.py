"""HELD across programs: `birdcage hold` and `release`, beside a program that has the port and without one."""

from __future__ import annotations

import signal
from dataclasses import replace

import pytest
from birdcage.base.paths import Paths
from birdcage.station.holding import find_held, list_held
from birdcage.station.requests import Goto

from .conftest import PtyDish


@pytest.fixture(autouse=True)
def _anna(monkeypatch):
    monkeypatch.setenv("LOGNAME", "anna")


def moved(pty_dish):
    return [line for line in pty_dish.moves() if line != "a"]


def test_a_dish_that_nobody_drives_is_held_and_released(run, as_json, pty_dish):
    held = run("hold", port=pty_dish.path)
    assert held.exit_code == 0, held.stderr
    assert "HELD by anna (birdcage hold) since " in held.stdout
    assert "Nothing was sent" in held.stdout
    for words in (("move", "--az", 200, "--el", 45), ("home", "--yes")):
        refused = run(*words, port=pty_dish.path)
        assert refused.exit_code == 4
        assert "HELD by anna (birdcage hold) since " in refused.stderr
        assert "`birdcage release`" in refused.stderr
    assert moved(pty_dish) == []
    status = as_json(run("status", "--quick", "--json", port=pty_dish.path))
    assert (status["held"], status["held_by"]) == (True, "anna (birdcage hold)")
    released = run("release", port=pty_dish.path)
    assert released.exit_code == 0, released.stderr
    assert released.stdout.startswith("HELD by anna (birdcage hold) since ")
    assert "Released." in released.stdout
    assert run("move", "--az", 10, "--el", 45, port=pty_dish.path).exit_code == 0
    assert "the dish is not held" in run("release", port=pty_dish.path).stdout


def test_the_one_dish_that_is_held_needs_no_name(run, pty_dish, tmp_path):
    assert run("hold", port=pty_dish.path).exit_code == 0
    assert pty_dish.path in str(run("release", "--json", port="").stdout)
    assert run("hold", port=pty_dish.path).exit_code == 0
    other = tmp_path / "ttyUSB7"
    other.touch()
    assert run("hold", port=str(other)).exit_code == 0
    several = run("release", port="")
    assert several.exit_code == 2
    assert "2 dishes are held" in several.stderr
    assert str(other) in several.stderr


@pytest.mark.parametrize("noted", [True, False])
def test_of_several_dishes_that_are_driven_none_is_released_by_guess(run, pty_dish, owner, older_owner, noted):
    owner.station.stop("you")
    pty_dish.wait_for(lambda _truth: owner.station.state.held is not None and list_held(Paths.default()))
    (held,) = list_held(Paths.default())
    if noted:  # an older birdcage has not written which port that was
        held.file.write(replace(held.note, port=""))
    else:
        held.file.remove()
    several = run("release", port="")
    assert several.exit_code == 2
    assert "2 dishes are driven" in several.stderr
    assert older_owner in several.stderr
    assert "Nothing was released." in several.stderr
    assert owner.station.state.held is not None


def test_a_port_that_is_not_there_is_not_held_by_guess(run):
    result = run("hold", port="/dev/ttyUSB99")
    assert result.exit_code == 1
    assert "is not there" in result.stderr


def test_hold_beside_a_program_of_another_version_holds_for_all_that_start(run, older_owner):
    result = run("hold", port=older_owner)
    assert (result.exit_code, result.stdout) == (1, "")
    assert "Is it an older birdcage?" in result.stderr
    assert "Every birdcage program that starts now finds it HELD." in result.stderr
    assert find_held(Paths.default(), older_owner) is not None


def test_an_owner_stops_holds_and_releases(run, as_json, pty_dish, owner):
    owner.station.submit(Goto(200.0, 45.0, "you"))
    pty_dish.wait_for_motion()
    held = as_json(run("hold", "--json", port=pty_dish.path))
    assert (held["confirmed"], held["held"]) == (True, True)
    assert not pty_dish.device.truth().moving
    assert owner.station.state.held.by == "anna (birdcage hold)"
    owner.station.submit(Goto(200.0, 45.0, "Gpredict")).exception(5)
    released = run("release", port=pty_dish.path)
    assert released.exit_code == 0, released.stderr
    assert "HELD by anna (birdcage hold) since " in released.stdout
    assert "Gpredict waits to move it." in released.stdout
    assert owner.station.state.held is None
    assert "the dish is not held" in run("release", port=pty_dish.path).stdout


def test_it_is_held_after_its_program_was_killed(run, start, pty_dish):
    process = start("move", "--port", pty_dish.path, "--firmware", "g2", "--az", 200, "--el", 45)
    pty_dish.wait_for_motion()
    assert run("stop", port=pty_dish.path).exit_code == 0
    process.kill()
    process.wait(5)
    refused = run("move", "--az", 200, "--el", 45, port=pty_dish.path)
    assert refused.exit_code == 4
    assert "HELD by anna (birdcage stop) since " in refused.stderr


def test_a_stop_that_did_not_get_through_holds_the_dish_all_the_same(run, pty_dish, monkeypatch):
    monkeypatch.setattr("birdcage.cli.commands.stop.PATIENCE_S", 0.5)
    lane = pty_dish.device.wire.to_host
    lane.silent = True
    stopped = run("stop", port=pty_dish.path)
    assert stopped.exit_code == 3, stopped.stderr
    assert "HELD all the same: `birdcage release`" in stopped.stderr
    lane.silent = False
    assert run("move", "--az", 100, "--el", 45, port=pty_dish.path).exit_code == 4
    assert moved(pty_dish) == []


@pytest.mark.parametrize(("number", "code"), [(signal.SIGINT, 4), (signal.SIGTERM, 0)])
def test_ctrl_c_on_a_dish_that_moves_holds_it_and_the_end_of_a_program_does_not(run, start, pty_dish, number, code):
    process = start("move", "--port", pty_dish.path, "--firmware", "g2", "--az", 200, "--el", 45)
    pty_dish.wait_for_motion()
    process.send_signal(number)
    _out, err = process.communicate(timeout=60)
    assert process.returncode == 128 + number
    assert ("`birdcage release` lets it move again" in err) is (code == 4)
    position = pty_dish.device.truth()
    result = run("move", "--az", f"{position.az_deg:.2f}", "--el", 44, port=pty_dish.path)
    assert result.exit_code == code, result.stderr


def test_another_simulator_at_the_same_pseudo_terminal_starts_free(run):
    first = PtyDish()
    assert run("hold", port=first.path).exit_code == 0
    assert run("move", "--az", 10, "--el", 45, port=first.path).exit_code == 4
    first.close()
    others = [PtyDish()]
    try:
        while others[-1].path != first.path and len(others) < 50:  # another test may have taken the name
            others.append(PtyDish())
        result = run("move", "--az", 10, "--el", 45, port=first.path)
        assert result.exit_code == 0, result.stderr
    finally:
        for dish in others:
            dish.close()
