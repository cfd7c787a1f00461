"""Signals and faults in the middle of a motion: STOP first, then the port closes, and a last line says where."""

from __future__ import annotations

import re
import signal
import threading
import time

import pytest
from birdcage.cli.commands.move import MoveShown
from birdcage.station.mover import Mover
from pty_terminal import PtyTerminal

LAST = re.compile(r"The dish was last seen at AZ (\S+)° EL (\S+)°, \d\d:\d\d:\d\dZ\.")


@pytest.mark.parametrize("name", ["SIGINT", "SIGTERM", "SIGHUP", "SIGQUIT"])
def test_a_signal_stops_the_dish_first(start, pty_dish, name) -> None:
    number = getattr(signal, name)
    process = start("move", "--port", pty_dish.path, "--firmware", "g2", "--az", 200, "--el", 45)
    pty_dish.wait_for(lambda truth: truth.cable_deg < -20)
    called = time.monotonic()
    process.send_signal(number)
    out, err = process.communicate(timeout=60)
    took_s = time.monotonic() - called
    truth = pty_dish.device.truth()
    assert process.returncode == 128 + number
    assert not truth.moving
    assert truth.az_deg > 220
    first = next(line for line in pty_dish.moves(called) if line != "a")
    assert first.startswith("a 0 ")
    assert took_s < 3
    assert out == ""
    last = LAST.search(err.splitlines()[-1])
    assert last
    assert float(last[1]) == pytest.approx(truth.az_deg, abs=0.1)


def test_a_signal_just_as_the_motion_begins(start, pty_dish) -> None:
    process = start("move", "--port", pty_dish.path, "--firmware", "g2", "--az", 200, "--el", 45)
    pty_dish.wait_for(lambda _truth: "a 0 200.00" in pty_dish.lines())
    process.send_signal(signal.SIGTERM)
    _out, err = process.communicate(timeout=60)
    assert not pty_dish.device.truth().moving
    assert "Stands still at" in err


def test_a_signal_that_comes_twice_ends_it_all_the_same(start, pty_dish) -> None:
    process = start("move", "--port", pty_dish.path, "--firmware", "g2", "--az", 200, "--el", 45)
    pty_dish.wait_for_motion()
    process.send_signal(signal.SIGINT)
    process.send_signal(signal.SIGINT)
    _out, err = process.communicate(timeout=60)
    assert process.returncode == 130
    assert "Traceback" not in err
    assert not pty_dish.device.truth().moving


def test_a_fault_of_ours_stops_the_dish_too(run, pty_dish, monkeypatch) -> None:
    def fail(self, event):
        if pty_dish.device.truth().moving:
            raise RuntimeError("a fault for the test")

    monkeypatch.setattr(MoveShown, "__call__", fail)
    result = run("move", "--az", 200, "--el", 45, port=pty_dish.path)
    assert result.exit_code == 70
    assert "a fault for the test" in result.stderr
    assert LAST.search(result.stderr.splitlines()[-1])
    assert not pty_dish.device.truth().moving
    assert pty_dish.device.truth().az_deg != pytest.approx(200, abs=20)


def test_a_fault_on_the_thread_of_the_station_stops_the_dish_too(run, pty_dish, monkeypatch) -> None:
    original = Mover.tick

    def fail(self):
        original(self)
        if pty_dish.device.truth().moving:
            raise RuntimeError("a fault for the test")

    monkeypatch.setattr(Mover, "tick", fail)
    result = run("move", "--az", 200, "--el", 45, port=pty_dish.path)
    assert result.exit_code == 70
    assert "a fault for the test" in result.stderr
    pty_dish.wait_for(lambda truth: not truth.moving, 1.0)
    assert pty_dish.device.truth().az_deg != pytest.approx(200, abs=20)


def test_a_signal_while_only_looking_sends_no_stop(start, pty_dish) -> None:
    pty_dish.device.power_off()
    process = start("init", "--port", pty_dish.path, "--firmware", "g2")
    pty_dish.wait_for(lambda _truth: pty_dish.is_open_in(process.pid))
    process.send_signal(signal.SIGINT)
    _out, err = process.communicate(timeout=60)
    assert process.returncode == 130
    assert "Traceback" not in err
    assert pty_dish.moves() == []


def test_a_lost_cable_in_mid_move_is_a_link_error(run, pty_dish, monkeypatch) -> None:
    def pull(self, event):
        if pty_dish.device.truth().moving:
            pty_dish.unplug()

    monkeypatch.setattr(MoveShown, "__call__", pull)
    result = run("move", "--az", 200, "--el", 45, port=pty_dish.path)
    assert result.exit_code == 3
    assert "Traceback" not in result.stderr


def test_a_lost_cable_in_mid_sweep_is_a_link_error(run, pty_dish):
    def pull():
        pty_dish.wait_for(lambda truth: truth.moving)
        pty_dish.unplug()

    hand = threading.Thread(target=pull)
    hand.start()
    result = run("sweep", "az", "90", "45", port=pty_dish.path)
    hand.join()
    assert result.exit_code == 3, result.stderr
    assert "Traceback" not in result.stderr


@pytest.fixture
def terminal():
    """Start `birdcage` in a terminal of its own."""
    started = []

    def terminal(*words, **more):
        started.append(PtyTerminal("birdcage", *words, **more))
        return started[-1]

    yield terminal
    for each in started:
        each.close()


def test_a_terminal_that_takes_nothing_any_more_keeps_no_command_alive(terminal, pty_dish) -> None:
    process = terminal("move", "--port", pty_dish.path, "--firmware", "g2", "--az", 200, "--el", 45)
    pty_dish.wait_for(lambda truth: truth.cable_deg < -5)
    process.wait_for(b"to go")
    process.block()
    lines = len(pty_dish.moves())
    process.signal(signal.SIGTERM)
    assert process.status() == 143
    assert pty_dish.moves()[lines].startswith("a 0 ")
    assert not pty_dish.is_held_open()


def test_a_closed_terminal_stops_the_dish(terminal, pty_dish) -> None:
    process = terminal("move", "--port", pty_dish.path, "--firmware", "g2", "--az", 200, "--el", 45)
    pty_dish.wait_for(lambda truth: truth.cable_deg < -5)
    process.hang_up()
    assert process.status() == 129
    assert not pty_dish.device.truth().moving


@pytest.mark.parametrize("module", ["birdcage.cli.app", "click", "birdcage.cli.commands.move"])
def test_ctrl_c_while_it_is_loaded_is_no_traceback(terminal, at_import, module) -> None:
    process = terminal("move", "--help", env=at_import(module, "os.kill(os.getpid(), signal.SIGINT)"))
    assert process.status() == 130
    assert process.output == b""


@pytest.mark.parametrize("words", [("serve", "--selftest"), ("serve", "--json"), ("station", "run", "--json")])
def test_whoever_reads_it_may_leave(start, words):
    process = start(*words, "--port", "sim:g2", "--firmware", "g2", *(["--listen-port", 0] if "serve" in words else []))
    assert process.stdout.readline()
    process.stdout.close()
    process.stdout = None
    _out, err = process.communicate(timeout=30)
    assert process.returncode == 128 + signal.SIGPIPE
    assert "Traceback" not in err
    assert "BrokenPipe" not in err


def test_a_list_that_is_read_in_part_ends_without_a_word(start):
    process = start("ports", "--json")
    process.stdout.close()
    process.stdout = None
    _out, err = process.communicate(timeout=30)
    assert (process.returncode, err) == (128 + signal.SIGPIPE, "")
