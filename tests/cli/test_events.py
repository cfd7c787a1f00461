"""`birdcage events` beside a program that has the port, and without one."""

from __future__ import annotations

import json
import os
import signal
import socket
import subprocess
import sys
import time

import pytest
from birdcage.base.paths import Paths
from birdcage.station.control_client import call_owner, find_owners, owners_folder
from birdcage.station.control_messages import ControlCall, TellStatus, as_line, call_to_json
from birdcage.station.control_server import ControlServer
from birdcage.station.events import MoveEnded, MoveStarted, PositionRead
from birdcage.station.json_form import event_from_json
from birdcage.station.requests import Goto, Stop
from birdcage.station.state import LinkPhase

from tests.station.owner_stand_in import OwnerStandIn

DRIVES = """
import sys, threading
from birdcage.base.clock import RealClock
from birdcage.base.config import load
from birdcage.base.paths import Paths
from birdcage.station.build import open_session
from birdcage.station.control_client import owners_folder
from birdcage.station.control_server import ControlServer

session = open_session(
    port=sys.argv[1], firmware="g2", baud=None, settings=load(None), paths=Paths.default(), clock=RealClock(),
    survey=False,
)
ControlServer(session.station, owners_folder(Paths.default()))
session.start()
threading.Event().wait()
"""


@pytest.fixture
def follow(start, pty_dish):
    """Start `birdcage events`, and wait until it follows."""

    def follow(*words):
        process = start("events", "--port", pty_dish.path, *words)
        first = process.stderr.readline()
        assert first.startswith("Following process"), first + process.stderr.read()
        return process

    return follow


def lines_until(process, word):
    lines = []
    while not lines or word not in lines[-1]:
        lines.append(process.stdout.readline())
        assert lines[-1], process.communicate()
    return lines


def ended(process, number=signal.SIGINT):
    if number is not None:
        process.send_signal(number)
    out, err = process.communicate(timeout=30)
    return process.returncode, out, err


def test_what_the_owner_does_is_told_line_by_line(follow, owner) -> None:
    process = follow()
    owner.station.submit(Goto(60.0, 45.0, "anna"))
    lines = lines_until(process, "move arrived")
    assert all(line[8:11] == "Z  " for line in lines)
    assert any("anna moves it to AZ 60.00 EL 45.00" in line for line in lines)
    assert any("° to go" in line for line in lines)
    owner.station.stop("ben")
    lines_until(process, "held by ben")
    assert ended(process)[0] == 130


def test_json_lines_are_events(follow, owner) -> None:
    process = follow("--json", "--watch", "position")
    owner.station.submit(Goto(30.0, 45.0, "anna"))
    events = [event_from_json(json.loads(line)) for line in lines_until(process, '"MoveEnded"')]
    assert {MoveStarted, PositionRead, MoveEnded} <= {type(each) for each in events}
    assert events[-1].position.az_deg == pytest.approx(30.0, abs=0.1)
    (started,) = [each for each in events if isinstance(each, MoveStarted)]
    assert (started.holder, started.motion.to_az_deg) == ("anna", 30.0)
    code, _, err = ended(process)
    assert (code, err) == (130, "")


def test_a_watch_is_served_and_ends_with_the_command(follow, owner, pty_dish) -> None:
    process = follow("--watch", "position")
    assert "position AZ" in lines_until(process, "position AZ")[-1]
    assert any(each.endswith("(outside)") for each in owner.station._watches._watchers)
    ended(process)
    pty_dish.wait_for(lambda _truth: not owner.station._watches._watchers)


def test_the_end_of_the_owner_is_told(follow, owner) -> None:
    process = follow()
    owner.close()
    owner.control_server.close()
    code, out, err = ended(process, None)
    assert (code, err) == (0, "The program that has the port is ending.\n")
    assert "link closed" in out


def test_an_owner_that_is_killed_ends_it(follow, pty_dish) -> None:
    killed = subprocess.Popen([sys.executable, "-c", DRIVES, pty_dish.path])
    pty_dish.wait_for(lambda _truth: find_owners(owners_folder(Paths.default())), 30)
    process = follow()
    os.kill(killed.pid, signal.SIGKILL)
    killed.wait(10)
    code, _, err = ended(process, None)
    assert (code, err) == (3, f"No more events: process {killed.pid} has ended, or hung up.\n")


def test_callers_that_never_read_do_not_slow_the_dish_down(owner) -> None:
    (found,) = find_owners(owners_folder(Paths.default()))
    asked = as_line(call_to_json(found.token, ControlCall(TellStatus(), "you", events=True)))
    silent = [socket.create_connection(("127.0.0.1", found.tcp_port), 5) for _ in range(50)]
    for caller in silent:
        caller.sendall(asked)
    begun = time.monotonic()
    owner.station.submit(Goto(60.0, 45.0, "anna")).result(20)
    assert time.monotonic() - begun < 10.0
    assert call_owner(found, Stop("you"), "you")["confirmed"] is True
    for caller in silent:
        caller.close()


def test_without_a_program_there_is_nothing_to_follow(run, pty_dish) -> None:
    result = run("events", port=pty_dish.path)
    assert (result.exit_code, result.stdout) == (3, "")
    assert result.stderr.startswith(f"No birdcage program has {pty_dish.path}.")
    assert pty_dish.lines() == []


def test_one_of_several_has_to_be_named(run, tmp_path) -> None:
    servers = []
    for name in ("first", "second"):
        (tmp_path / name).touch()
        owner = OwnerStandIn(str(tmp_path / name))
        servers.append(ControlServer(owner, owners_folder(Paths.default())))
        owner.link(LinkPhase.UP)
    result = run("events", port="")
    assert result.exit_code == 2
    assert result.stderr.startswith("2 programs drive a dish: at ")
    for server in servers:
        server.close()
