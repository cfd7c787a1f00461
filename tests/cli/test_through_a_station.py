"""Commands beside a station that has the port: they go through it, in the same words and with the same exit codes."""

from __future__ import annotations

import json
import signal
import threading
import time
from concurrent.futures import Future

import pytest
from birdcage.base.clock import RealClock
from birdcage.base.paths import Paths
from birdcage.cli.attached_command import AttachedCommand
from birdcage.cli.exits import EndedBySignal
from birdcage.station.control_client import find_owner, owners_folder
from birdcage.station.requests import AcquireLease, EndMotion, Goto
from birdcage.station.state import LinkPhase, LinkState, StationState
from pty_dish import PtyDish


def until(seen, within_s=30.0) -> None:
    end = time.monotonic() + within_s
    while not seen():
        assert time.monotonic() < end, "not seen in time"
        threading.Event().wait(0.02)


def test_pos_asks_the_station_and_is_fresh(run, as_json, pty_dish, owner) -> None:
    owner.station.submit(Goto(20.0, 47.0, "app")).result(30)
    told = as_json(run("pos", "--json", port=pty_dish.path))
    assert (told["azimuth_deg"], told["elevation_deg"]) == (pytest.approx(20.0, abs=0.1), pytest.approx(47.0, abs=0.1))
    assert told["port"] == pty_dish.path
    assert run("pos", port=pty_dish.path).stdout.startswith("AZ: ")


def test_a_move_arrives_through_the_station_and_gives_control_back(run, as_json, pty_dish, owner) -> None:
    told = as_json(run("move", "--az", 15, "--el", 46, "--json", port=pty_dish.path))
    assert told["azimuth_deg"] == pytest.approx(15.0, abs=0.1)
    until(lambda: owner.station.state.holder is None)
    assert pty_dish.device.truth().az_deg == pytest.approx(15.0, abs=0.2)


def test_what_is_refused_is_refused_in_the_same_words(run, pty_dish, owner) -> None:
    through = run("move", "--az", 15, "--el", 80, port=pty_dish.path)
    assert through.exit_code == 4
    owner.session_closed = owner.close()
    owner.control_server.close()
    alone = run("move", "--az", 15, "--el", 80, port=pty_dish.path)
    assert (alone.exit_code, alone.stderr) == (through.exit_code, through.stderr)


def test_a_dish_that_somebody_else_has_is_not_moved(run, pty_dish, owner) -> None:
    owner.station.submit(AcquireLease("you")).result(5)
    result = run("move", "--az", 15, "--el", 46, port=pty_dish.path)
    assert result.exit_code == 1
    assert "has control. Take control, or wait until it is free." in result.stderr
    assert pty_dish.moves() == []
    assert owner.station.state.holder == "you"


def test_a_held_dish_is_not_moved(run, pty_dish, owner) -> None:
    owner.station.stop("you")
    pty_dish.wait_for(lambda _truth: owner.station.state.held is not None)
    result = run("move", "--az", 15, "--el", 46, port=pty_dish.path)
    assert result.exit_code == 4
    assert "HELD by" in result.stderr
    assert run("release", port=pty_dish.path).exit_code == 0
    assert run("move", "--az", 15, "--el", 46, port=pty_dish.path).exit_code == 0


def moving(start, pty_dish, owner, *more):
    process = start("move", "--az", "200", "--el", "45", "--port", pty_dish.path, *more)
    until(lambda: owner.station.state.motion is not None)
    return process


def test_ctrl_c_is_stop_for_all(start, pty_dish, owner) -> None:
    process = moving(start, pty_dish, owner)
    process.send_signal(signal.SIGINT)
    _out, err = process.communicate(timeout=30)
    assert process.returncode == 130, err
    assert owner.station.state.held.by == "Ctrl+C"
    assert not pty_dish.device.truth().moving
    assert "`birdcage release` lets it move again." in err


class SilentStation:
    """Answers nothing; a signal comes right behind what is asked."""

    def __init__(self) -> None:
        self.clock, self.state = RealClock(), StationState(port="x", link=LinkState(LinkPhase.UP, 0.0))
        self.asked, self.stops, self.then = [], [], lambda: None

    def subscribe(self, listener) -> None:
        """Tell nothing."""

    def submit(self, request) -> Future:
        self.asked.append(type(request))
        if len(self.asked) == 1:
            self.then()
        return Future()

    def stop(self, by) -> None:
        self.stops.append(by)


@pytest.mark.parametrize(
    ("request_", "stops"), [(Goto(15.0, 46.0, "birdcage move"), ["Ctrl+C"]), (AcquireLease("birdcage move"), [])]
)
def test_ctrl_c_is_stop_before_the_motion_asked_for_is_heard_of(request_, stops) -> None:
    station = SilentStation()
    command = AttachedCommand(station, "birdcage move", moves=True)
    station.then = lambda: command.on_signal(signal.SIGINT)
    with pytest.raises(EndedBySignal):
        command.ask(request_, 5.0)
    assert station.stops == stops
    assert station.asked[1:] == ([] if stops else [EndMotion])


def test_a_command_that_is_ended_ends_its_motion_and_holds_nothing(start, pty_dish, owner) -> None:
    process = moving(start, pty_dish, owner)
    process.send_signal(signal.SIGTERM)
    _out, err = process.communicate(timeout=30)
    assert process.returncode == 143, err
    until(lambda: owner.station.state.motion is None and owner.station.state.holder is None)
    pty_dish.wait_for(lambda truth: not truth.moving)
    assert abs(pty_dish.device.truth().az_deg - 200.0) > 10.0
    assert owner.station.state.held is None


@pytest.mark.parametrize("end", ["SIGHUP", "SIGKILL"])
def test_a_terminal_that_is_gone_lets_the_motion_arrive(start, pty_dish, owner, end) -> None:
    process = moving(start, pty_dish, owner)
    process.send_signal(getattr(signal, end))
    process.communicate(timeout=30)
    until(lambda: owner.station.state.holder is None)
    assert pty_dish.device.truth().az_deg == pytest.approx(200.0, abs=0.2)
    assert owner.station.state.held is None


def test_without_waiting_it_moves_on_after_the_command(run, pty_dish, owner) -> None:
    result = run("move", "--az", 60, "--el", 45, "--no-wait", port=pty_dish.path)
    assert result.exit_code == 0, result.stderr
    assert "On its way to AZ 60.00° EL 45.00°." in result.stderr
    until(lambda: owner.station.state.holder is None)
    assert pty_dish.device.truth().az_deg == pytest.approx(60.0, abs=0.2)


def test_a_move_that_takes_too_long_is_ended(run, pty_dish, owner) -> None:
    result = run("move", "--az", 300, "--el", 45, "--timeout", 1, port=pty_dish.path)
    assert result.exit_code == 1
    assert "Not done within 1 s." in result.stderr
    until(lambda: owner.station.state.motion is None)
    assert owner.station.state.held is None


def test_an_older_program_has_the_port_to_itself(run, older_owner) -> None:
    result = run("pos", port=older_owner)
    assert result.exit_code == 3


def announced(dish) -> bool:
    return find_owner(owners_folder(Paths.default()), dish.path) is not None


@pytest.fixture
def station(start, pty_dish):
    process = start("station", "run", "--port", pty_dish.path, "--firmware", "g2", "--skip-init")
    until(lambda: announced(pty_dish))
    return process


def test_a_station_without_a_face_serves_every_command(run, as_json, pty_dish, station) -> None:
    assert as_json(run("status", "--json", port=pty_dish.path))["connected"] is True
    assert run("move", "--az", 12, "--el", 46, port=pty_dish.path).exit_code == 0
    assert as_json(run("pos", "--json", port=pty_dish.path))["azimuth_deg"] == pytest.approx(12.0, abs=0.1)
    assert run("stop", port=pty_dish.path).exit_code == 0
    assert run("move", "--az", 20, "--el", 46, port=pty_dish.path).exit_code == 4
    assert run("release", port=pty_dish.path).exit_code == 0
    station.send_signal(signal.SIGTERM)
    _out, err = station.communicate(timeout=30)
    assert station.returncode == 143
    assert f"Driving the dish at {pty_dish.path}." in err
    assert not announced(pty_dish)


@pytest.mark.parametrize("end", [signal.SIGTERM, signal.SIGHUP, signal.SIGINT])
def test_a_station_that_ends_stops_the_dish_first(run, pty_dish, station, end) -> None:
    assert run("move", "--az", 200, "--el", 45, "--no-wait", port=pty_dish.path).exit_code == 0
    pty_dish.wait_for_motion()
    station.send_signal(end)
    station.communicate(timeout=30)
    assert station.returncode == 128 + end
    pty_dish.wait_for(lambda truth: not truth.moving)
    assert abs(pty_dish.device.truth().az_deg - 200.0) > 10.0


def test_a_station_that_was_killed_leaves_the_port_to_the_next(run, as_json, start, pty_dish, station) -> None:
    station.kill()
    station.wait(30)
    assert as_json(run("pos", "--json", port=pty_dish.path))["elevation_deg"] == pytest.approx(45.0, abs=0.1)
    again = start("station", "run", "--port", pty_dish.path, "--firmware", "g2", "--skip-init", "--json")
    until(lambda: announced(pty_dish))
    assert run("move", "--az", 5, "--el", 46, port=pty_dish.path).exit_code == 0
    again.send_signal(signal.SIGTERM)
    out, _err = again.communicate(timeout=30)
    kinds = {json.loads(line)["type"] for line in out.splitlines()}
    assert {"LinkChanged", "MoveStarted", "MoveEnded", "LeaseChanged"} <= kinds


def test_homing_goes_through_the_station(run, start) -> None:
    dish = PtyDish("seed=1", "g2", 8.0)
    try:
        station = start("station", "run", "--port", dish.path, "--firmware", "g2", "--skip-init")
        until(lambda: announced(dish))
        result = run("home", "az", "--yes", port=dish.path)
        assert result.exit_code == 0, result.stderr
        assert "Homing the azimuth." in result.stderr
        assert [line for line in dish.moves() if line.startswith("h ")] == ["h 0"]
        station.send_signal(signal.SIGTERM)
        station.communicate(timeout=30)
    finally:
        dish.close()
