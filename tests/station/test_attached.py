"""A station of another program: the same requests, events, state and lease as one's own."""

from __future__ import annotations

import subprocess
import sys
import threading
import time

import pytest
from birdcage.base.errors import (
    CommandRefused,
    ConfirmationNeeded,
    Held,
    LeaseDenied,
    LinkError,
    MotionRefused,
    NoReply,
    Stopped,
)
from birdcage.base.paths import Paths
from birdcage.base.reason import Reason
from birdcage.station.attached import AttachedStation
from birdcage.station.events import LinkChanged, MoveEnded, MoveStarted, PositionRead, StopConfirmed
from birdcage.station.holding import find_held
from birdcage.station.requests import (
    AcknowledgeFault,
    AcquireLease,
    ApplySettings,
    Goto,
    Jog,
    ListCommands,
    Pursue,
    Raw,
    Read,
    Release,
    ReleaseLease,
    Set,
    Watch,
)
from birdcage.station.state import LinkPhase, Pointing
from pty_dish import PtyDish

OWNER = """
import sys, threading
from birdcage.base.clock import RealClock
from birdcage.base.config import load
from birdcage.base.paths import Paths
from birdcage.station.build import open_session
from birdcage.station.control_client import owners_folder
from birdcage.station.control_server import ControlServer
paths = Paths.default()
session = open_session(port=sys.argv[1], firmware=sys.argv[2], baud=None, settings=load(None), paths=paths,
                       clock=RealClock(), survey=False)
server = ControlServer(session.station, owners_folder(paths))
session.start()
print("started", flush=True)
sys.stdin.read()
session.close()
server.close()
"""
WITHIN_S = 15.0


def until(seen, within_s=WITHIN_S) -> None:
    end = time.monotonic() + within_s
    while not seen():
        assert time.monotonic() < end, "not seen in time"
        threading.Event().wait(0.01)


class Owner:
    """A program that has the port, in a process of its own."""

    def __init__(self, port: str, firmware: str = "g2") -> None:
        self.process = subprocess.Popen(
            [sys.executable, "-c", OWNER, port, firmware], stdin=subprocess.PIPE, stdout=subprocess.PIPE
        )
        assert self.process.stdout.readline() == b"started\n"

    def kill(self) -> None:
        self.process.kill()
        self.process.wait(WITHIN_S)

    def close(self) -> None:
        if self.process.poll() is None:
            self.process.stdin.close()
            try:
                self.process.wait(10)
            except subprocess.TimeoutExpired:
                self.kill()
        self.process.stdout.close()


@pytest.fixture
def dish(request):
    dish = PtyDish(getattr(request, "param", "seed=1"))
    yield dish
    dish.close()


@pytest.fixture
def owner(dish):
    owner = Owner(dish.path)
    yield owner
    owner.close()


@pytest.fixture
def attach(dish):
    made = []

    def attach(name="anna", **more) -> AttachedStation:
        station = AttachedStation(Paths.default(), dish.path, name=name, **more)
        made.append(station)
        station.heard = []
        station.subscribe(station.heard.append)
        return station

    yield attach
    for station in made:
        station.close()


@pytest.fixture
def anna(owner, attach):
    anna = attach()
    assert anna.wait_attached(WITHIN_S)
    until(lambda: anna.state.position is not None)
    return anna


def test_it_has_the_state_of_the_other_program(anna, dish) -> None:
    assert anna.state.link.state is LinkPhase.UP
    assert anna.state.dish.firmware == "g2"
    assert anna.state.port == dish.path
    assert anna.state.position.dish_el_deg == pytest.approx(45.0, abs=0.1)
    assert abs(anna.clock.monotonic() - time.monotonic()) < 0.01


def test_a_listener_that_fails_hears_no_more_and_the_rest_goes_on(anna, dish) -> None:
    failed = []

    def fail(event) -> None:
        failed.append(event)
        raise ZeroDivisionError

    anna.subscribe(fail)
    assert anna.submit(Goto(10.0, 47.0, "you")).result(WITHIN_S).az_deg == pytest.approx(10.0, abs=0.1)
    assert len(failed) == 1
    assert any(isinstance(event, MoveEnded) for event in anna.heard)


def test_a_go_to_arrives_with_its_events_and_states(anna, dish) -> None:
    heard = []
    anna.subscribe(lambda event: heard.append((event, anna.state)))
    future = anna.submit(Goto(10.0, 47.0, "you"))
    arrived = future.result(WITHIN_S)
    assert isinstance(arrived, Pointing)
    assert (arrived.az_deg, arrived.el_deg) == (pytest.approx(10.0, abs=0.1), pytest.approx(47.0, abs=0.1))
    assert anna.state.holder == "you"
    assert [line for line in dish.moves() if line != "a"] != []
    started = next(state for event, state in heard if isinstance(event, MoveStarted))
    assert started.motion.to_az_deg == 10.0
    ended = next(state for event, state in heard if isinstance(event, MoveEnded))
    assert ended.motion is None
    for event, state in heard:
        if isinstance(event, PositionRead):
            assert state.position.at >= event.position.at


def test_errors_come_back_as_what_they_were(anna) -> None:
    with pytest.raises(MotionRefused) as refused:
        anna.submit(Goto(10.0, 80.0, "you")).result(WITHIN_S)
    assert refused.value.reason is Reason.EL_LIMIT
    assert "80.00" in str(refused.value)
    with pytest.raises(CommandRefused) as unsupported:
        anna.submit(Read(("nonsense",))).result(WITHIN_S)
    assert "nonsense" in str(unsupported.value)
    assert anna.is_attached


@pytest.mark.parametrize("request_", [Pursue(None, "you"), ApplySettings(None, "you")])
def test_what_stays_inside_says_so(anna, request_) -> None:
    with pytest.raises(CommandRefused) as refused:
        anna.submit(request_).result(WITHIN_S)
    assert refused.value.reason is Reason.UNSUPPORTED
    assert "Nothing was sent." in str(refused.value)


def test_two_faces_are_two_holders(anna, attach) -> None:
    bert = attach("bert")
    assert bert.wait_attached(WITHIN_S)
    anna.submit(AcquireLease("you")).result(WITHIN_S)
    until(lambda: bert.state.holder == "anna")
    assert anna.state.holder == "you"
    with pytest.raises(LeaseDenied, match="anna has control"):
        bert.submit(Jog(1.0, 0.0, "you")).result(WITHIN_S)
    bert.submit(AcquireLease("you", take_over=True)).result(WITHIN_S)
    until(lambda: anna.state.holder == "bert")
    assert bert.state.holder == "you"
    bert.submit(ReleaseLease("you")).result(WITHIN_S)
    until(lambda: anna.state.holder is None)


def test_faces_of_one_name_get_a_number(anna, attach) -> None:
    second = attach("anna")
    assert second.wait_attached(WITHIN_S)
    anna.submit(AcquireLease("you")).result(WITHIN_S)
    until(lambda: second.state.holder == "anna")
    second.submit(AcquireLease("you", take_over=True)).result(WITHIN_S)
    until(lambda: anna.state.holder == "anna 2")


def test_results_of_every_kind_come_back(anna) -> None:
    assert anna.submit(AcquireLease("console")).result(WITHIN_S) is None
    raw = anna.submit(Raw("?")).result(WITHIN_S)
    assert (raw.line, len(raw.lines) > 5) == ("?", True)
    with pytest.raises(ConfirmationNeeded, match="`mot` was not sent"):
        anna.submit(Raw("mot")).result(WITHIN_S)
    commands = anna.submit(ListCommands()).result(WITHIN_S)
    assert "a" in {command.name for command in commands}
    anna.submit(ReleaseLease("console")).result(WITHIN_S)
    readings = anna.submit(Read(("rssi",))).result(WITHIN_S)
    assert readings["rssi"].value > 0
    assert anna.submit(Watch("page", frozenset({"position"}), 5.0)).result(WITHIN_S) is None
    with pytest.raises(CommandRefused):
        anna.submit(Set("rssi", 1.0, "you")).result(WITHIN_S)


def test_stop_holds_for_all_and_says_who(anna, attach, dish) -> None:
    bert = attach("bert")
    assert bert.wait_attached(WITHIN_S)
    move = anna.submit(Goto(200.0, 45.0, "you"))
    dish.wait_for_motion()
    bert.stop("you")
    with pytest.raises(Stopped):
        move.result(WITHIN_S)
    until(lambda: any(isinstance(each, StopConfirmed) for each in bert.heard))
    assert bert.state.held.by == "you"
    until(lambda: anna.state.held is not None)
    assert anna.state.held.by == "bert"
    with pytest.raises(Held, match="HELD by bert"):
        anna.submit(Goto(10.0, 45.0, "you")).result(WITHIN_S)
    assert anna.submit(Release("you")).result(WITHIN_S) is None
    until(lambda: bert.state.held is None)
    assert not dish.device.truth().moving


def test_without_a_program_nothing_is_known_and_stop_says_so(attach, dish) -> None:
    face = attach()
    until(lambda: face.state.link.state is LinkPhase.LOST)
    assert "No birdcage program drives" in face.state.link.detail
    with pytest.raises(LinkError, match="Nothing was sent"):
        face.submit(Goto(10.0, 45.0, "you")).result(WITHIN_S)
    face.stop("you")
    assert face.state.last_stop.confirmed is False
    assert "No birdcage program drives" in face.state.last_stop.sentence
    assert [each.report.by for each in face.heard if isinstance(each, StopConfirmed)] == ["you"]
    until(lambda: find_held(Paths.default(), dish.path) is not None)
    after = Owner(dish.path)  # the program that comes after finds it held
    try:
        until(lambda: face.is_attached and face.state.held is not None)
        with pytest.raises(Held):
            face.submit(Goto(10.0, 45.0, "you")).result(WITHIN_S)
    finally:
        after.close()
    assert dish.moves() == []


@pytest.mark.parametrize("dish", ["seed=1&az_speed=12"], indirect=True)  # still on its way as the next one opens it
def test_a_face_survives_the_death_of_the_station_in_mid_move(owner, anna, dish) -> None:
    move = anna.submit(Goto(200.0, 45.0, "you"))
    dish.wait_for_motion()
    until(lambda: anna.state.motion is not None)
    owner.kill()
    with pytest.raises(NoReply, match="unknown whether this was done") as lost:
        move.result(WITHIN_S)
    assert lost.value.reason is Reason.LOST
    until(lambda: anna.state.link.state is LinkPhase.LOST)
    assert anna.state.position_lost is Reason.LINK
    assert anna.state.motion is None
    after = Owner(dish.path)
    try:
        until(lambda: anna.is_attached and anna.state.position is not None and anna.state.position_lost is None)
        assert [each.link.state for each in anna.heard if isinstance(each, LinkChanged)].count(LinkPhase.LOST) >= 1
        until(lambda: anna.state.fault is not None)  # the dish moves, and this program has not asked for that
        dish.wait_for(lambda truth: not truth.moving)
        for request in (AcknowledgeFault("you"), Release("you")):
            anna.submit(request).result(WITHIN_S)
        arrived = anna.submit(Jog(1.0, 0.0, "you")).result(WITHIN_S)
        assert arrived.az_deg == pytest.approx(dish.device.truth().az_deg % 360.0, abs=0.1)
    finally:
        after.close()


FACE = """
import sys, threading
from birdcage.base.paths import Paths
from birdcage.station.attached import AttachedStation
from birdcage.station.requests import Goto
face = AttachedStation(Paths.default(), sys.argv[1], name="carl")
assert face.wait_attached(30)
face.submit(Goto(float(sys.argv[2]), 45.0, "you"))
print("asked", flush=True)
threading.Event().wait()
"""


def test_the_motion_of_a_face_that_is_killed_ends_and_its_lease_is_given_back(anna, dish) -> None:
    face = subprocess.Popen([sys.executable, "-c", FACE, dish.path, "60"], stdout=subprocess.PIPE)
    try:
        assert face.stdout.readline() == b"asked\n"
        until(lambda: anna.state.holder == "carl" and anna.state.motion is not None)
    finally:
        face.kill()
        face.wait(WITHIN_S)
        face.stdout.close()
    until(lambda: anna.state.holder is None)
    assert anna.state.motion is None
    assert anna.state.position.az_deg == pytest.approx(60.0, abs=0.1)
    ended = [each.end.value for each in anna.heard if isinstance(each, MoveEnded)]
    assert ended == ["arrived"]
