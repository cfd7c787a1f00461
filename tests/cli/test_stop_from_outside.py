"""`birdcage stop` and `birdcage status` beside a program that has the port, and without one."""

from __future__ import annotations

import json
import re
import threading
import time
from concurrent.futures import Future
from pathlib import Path

from birdcage.base.errors import Held
from birdcage.base.paths import Paths
from birdcage.station import control_client
from birdcage.station.control_client import owners_folder
from birdcage.station.requests import Goto


def announced() -> list[Path]:
    return list(owners_folder(Paths.default()).glob("*"))


def test_a_client_that_asks_again_and_again_moves_nothing_after_stop(start, pty_dish, owner) -> None:
    asked: list[Future[object]] = []
    over = threading.Event()

    def ask() -> None:
        targets = (200.0, 210.0)
        while not over.wait(0.1):
            asked.append(owner.station.submit(Goto(targets[len(asked) % 2], 45.0, "stand-in")))

    client = threading.Thread(target=ask, daemon=True)
    client.start()
    pty_dish.wait_for_motion()
    process = start("stop", "--port", pty_dish.path, "--json")
    out, err = process.communicate(timeout=60)
    stopped, told = time.monotonic(), json.loads(out)
    assert (process.returncode, err) == (0, "")
    assert told["confirmed"] is True
    assert told["by"] == "birdcage stop"
    before = len(asked)
    pty_dish.wait_for(lambda _truth: len(asked) > before + 20)
    over.set()
    client.join(5)
    assert [line for line in pty_dish.moves(stopped) if line != "a"] == []
    assert not pty_dish.device.truth().moving
    assert owner.station.state.held.by == "birdcage stop"
    assert owner.station.state.held.next_holder == "stand-in"
    assert isinstance(asked[before + 10].exception(5), Held)


def test_stop_without_a_port_reaches_every_owner(run, pty_dish, owner) -> None:
    result = run("stop", port="")
    assert result.exit_code == 0, result.stderr
    assert pty_dish.path in result.stdout
    assert "HELD until a person releases it: `birdcage release`." in result.stdout
    assert owner.station.state.held is not None


def test_a_program_of_another_version_keeps_no_other_from_being_stopped(run, pty_dish, owner, older_owner) -> None:
    result = run("stop", port="")
    assert result.exit_code == 1
    words = {line for line in result.stdout.splitlines() if older_owner in line}
    assert "Is it an older birdcage? If the dish moves, stop it there, or cut its power." in words.pop()
    assert f"({pty_dish.path}, process" in result.stdout
    assert owner.station.state.held is not None


def test_who_waits_no_longer_for_a_stop_is_not_told_that_nothing_was_done(run, pty_dish, owner, monkeypatch) -> None:
    asked = control_client.call_owner

    def interrupted(*given):
        asked(*given)
        raise KeyboardInterrupt

    monkeypatch.setattr(control_client, "call_owner", interrupted)
    result = run("stop", port=pty_dish.path)
    assert result.exit_code == 130
    assert re.fullmatch(
        r"Process \d+ was told to stop the dish. The result is unknown: look at the dish.\n", result.stderr
    )
    assert owner.station.state.held is not None


def test_status_comes_from_the_owner(run, as_json, pty_dish, owner) -> None:
    status = as_json(run("status", "--json", port=pty_dish.path))
    assert status["connected"] is True
    assert status["held"] is False
    owner.station.stop("you")
    pty_dish.wait_for(lambda _truth: owner.station.state.held is not None)
    assert as_json(run("status", "--json", port=pty_dish.path))["held_by"] == "you"


def test_the_owner_leaves_nothing_behind(run, pty_dish, owner) -> None:
    assert [path.stat().st_mode & 0o777 for path in announced()] == [0o600]
    run("stop", port=pty_dish.path)
    assert len(announced()) == 1


def test_stop_without_an_owner_stops_a_dish_that_moves(run, as_json, pty_dish) -> None:
    assert run("move", "--az", 200, "--el", 45, "--no-wait", port=pty_dish.path).exit_code == 0
    assert announced() == []
    result = run("stop", "--json", port=pty_dish.path)
    assert result.exit_code == 0, result.stderr
    assert as_json(result)["means"] == "retarget"
    assert not pty_dish.device.truth().moving
    assert abs(pty_dish.device.truth().az_deg - 200) > 20
    assert as_json(result)["held"] is True
    assert run("move", "--az", 100, "--el", 45, port=pty_dish.path).exit_code == 4


def test_stop_of_a_dish_at_rest_says_so_and_moves_nothing(run, as_json, pty_dish) -> None:
    result = run("stop", "--json", port=pty_dish.path)
    assert (result.exit_code, as_json(result)["means"]) == (0, "look")
    assert "Stands still at 0.00°/45.00°" in as_json(result)["sentence"]
    assert [line for line in pty_dish.moves() if line != "a"] == []


def test_a_simulated_dish_of_the_process_itself_is_not_announced(run) -> None:
    assert run("stop").exit_code == 0
    assert announced() == []
