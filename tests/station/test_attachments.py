"""What becomes of the names, the watches and the control of attached programs, and of what a face shows of them."""

from __future__ import annotations

import threading
from concurrent.futures import Future
from dataclasses import replace
from types import MappingProxyType

import pytest
from birdcage.base.errors import LinkError, NoReply
from birdcage.base.paths import Paths
from birdcage.base.reason import Reason
from birdcage.station import attached_caller
from birdcage.station.attached import AttachedStation
from birdcage.station.event_stream import LONGEST_QUEUE
from birdcage.station.events import LeaseChanged
from birdcage.station.requests import AcquireLease, Goto, ReleaseLease, Unwatch, Watch
from birdcage.station.state import Activity, LinkPhase

from .attached_bench import is_alone, tell, until


def test_a_watch_goes_by_a_name_of_its_own_and_ends_with_its_caller(owner, attach) -> None:
    anna, bert = attach("anna"), attach("bert")
    for caller in (anna, bert):
        caller.ask(1, Watch("page", frozenset({"rssi"}), 2.0))
        caller.until(id=1)
    assert {each.watcher for each in owner.asked} == {"page (anna)", "page (bert)"}
    anna.close()
    until(lambda: Unwatch("page (anna)") in owner.asked)
    assert Unwatch("page (bert)") not in owner.asked


def take(owner, holder: str | None, **fields) -> None:
    """The lease goes to somebody, and the station says so."""
    before = owner.state.holder
    owner.board.change(holder=holder, **fields)
    owner.board.tell(LeaseChanged(*owner.board.stamp(), holder, before))


def test_control_of_a_program_that_is_gone_comes_back_when_its_motion_is_over(owner, attach) -> None:
    anna = attach("anna")
    anna.ask(1, AcquireLease("anna"))
    anna.until(id=1)
    take(owner, "anna", activity=Activity.SLEWING)
    anna.close()
    until(lambda: "anna" not in owner.server._attachments._holders)
    tell(owner, "still under way")
    assert ReleaseLease("anna") not in owner.asked
    owner.board.change(activity=Activity.IDLE)
    tell(owner, "at rest")
    assert owner.asked[-1] == ReleaseLease("anna")
    until(lambda: is_alone(owner))


def test_a_request_under_way_keeps_control_too(owner, attach) -> None:
    waiting = Future()
    owner.submit = lambda request: owner.asked.append(request) or (waiting if isinstance(request, Goto) else Future())
    anna = attach("anna")
    anna.ask(1, Goto(10.0, 45.0, "anna"))
    until(lambda: owner.asked)
    anna.close()
    until(lambda: "anna" not in owner.server._attachments._holders)
    take(owner, "anna")
    assert ReleaseLease("anna") not in owner.asked
    waiting.set_result(None)
    assert owner.asked[-1] == ReleaseLease("anna")


def test_one_that_comes_back_keeps_its_control(owner, attach) -> None:
    anna = attach("anna")
    take(owner, "anna", activity=Activity.SLEWING)
    anna.close()
    until(lambda: "anna" not in owner.server._attachments._holders)
    again = attach("anna")
    assert again.welcome["result"]["name"] == "anna"
    owner.board.change(activity=Activity.IDLE)
    tell(owner, "at rest")
    assert ReleaseLease("anna") not in owner.asked


def test_control_that_somebody_else_has_by_then_stays_there(owner, attach) -> None:
    anna = attach("anna")
    take(owner, "anna", activity=Activity.SLEWING)
    anna.close()
    until(lambda: "anna" not in owner.server._attachments._holders)
    take(owner, "bert", activity=Activity.IDLE)
    assert not [each for each in owner.asked if isinstance(each, ReleaseLease)]
    until(lambda: is_alone(owner))


def test_the_person_at_the_station_is_not_the_one_at_the_face(owner) -> None:
    face = AttachedStation(Paths.default(), owner.state.port, name="anna")
    try:
        assert face.wait_attached(10.0)
        take(owner, "you")
        until(lambda: face.state.holder is not None)
        assert face.state.holder != "you"
        assert "(" in face.state.holder
        take(owner, "anna")
        until(lambda: face.state.holder == "you")
    finally:
        face.close()


def test_times_go_by_the_clock_of_the_station(owner) -> None:
    face = AttachedStation(Paths.default(), owner.state.port, name="anna")
    try:
        assert face.wait_attached(10.0)
        # The station's clock is a virtual one, far from ours.
        assert face.clock.monotonic() == pytest.approx(owner.clock.monotonic(), abs=2.0)
    finally:
        face.close()


def test_a_program_that_speaks_another_form_is_said_to_be_that(owner, monkeypatch) -> None:
    owner.board.change(link=replace(owner.state.link, detail="x"), signal_owners=MappingProxyType({"tuner": 5}))
    told = {"v": 1, "type": "StateTold", "state": {"hat": 1}}
    monkeypatch.setattr(attached_caller, "state_to_json", lambda _state, _before: told)
    face = AttachedStation(Paths.default(), owner.state.port, name="anna")
    try:
        until(lambda: face.state.link.state is LinkPhase.LOST)
        assert "speaks another form. Use the same birdcage in both." in face.state.link.detail
        assert face.state.link.reason is Reason.LOST
    finally:
        face.close()


def test_a_slow_face_attaches_again_and_has_the_whole_state(owner) -> None:
    face = AttachedStation(Paths.default(), owner.state.port, name="slow")
    try:
        assert face.wait_attached(10.0)
        stuck, go_on = threading.Event(), threading.Event()
        ended = face.subscribe(lambda _event: (stuck.set(), go_on.wait(20.0)))
        tell(owner, "first")
        assert stuck.wait(10.0)
        for number in range(8 * LONGEST_QUEUE):
            tell(owner, f"{number} " + "x" * 3000)
        owner.board.change(homed=True)
        ended()
        go_on.set()
        until(lambda: face.is_attached and face.state.homed is True)
        assert face.state.link.state is LinkPhase.UP
    finally:
        face.close()


def test_a_stop_that_was_not_answered_is_said_to_be_unknown(owner) -> None:
    def die(_by: str) -> None:
        owner.server._callers[-1].hang_up()

    face = AttachedStation(Paths.default(), owner.state.port, name="anna")
    try:
        assert face.wait_attached(10.0)
        owner.stop = die
        face.stop("you")
        until(lambda: face.state.last_stop is not None)
        assert face.state.last_stop.confirmed is False
        assert "It is unknown whether STOP was sent. If the dish moves, cut its power." in face.state.last_stop.sentence
    finally:
        face.close()


def test_requests_that_were_not_answered_fail_and_say_what_is_not_known(owner) -> None:
    owner.submit = lambda _request: Future()
    face = AttachedStation(Paths.default(), owner.state.port, name="anna")
    try:
        assert face.wait_attached(10.0)
        asked = [face.submit(Goto(float(az), 45.0, "you")) for az in range(5)]
        owner.server.close()
        for each in asked:
            with pytest.raises(NoReply, match="It is unknown whether this was done"):
                each.result(10.0)
        until(lambda: face.state.link.state is LinkPhase.LOST)
        assert (face.state.position_lost, face.state.holder) == (Reason.LINK, None)
        with pytest.raises(LinkError, match="Nothing was sent"):
            face.submit(Goto(1.0, 45.0, "you")).result(10.0)
    finally:
        face.close()


def test_what_was_asked_for_last_is_heard_though_the_face_leaves_at_once(owner) -> None:
    for number in range(20):
        face = AttachedStation(Paths.default(), owner.state.port, name="anna")
        assert face.wait_attached(10.0)
        for _ in range(50):
            owner.board.change(target_miss_deg=float(number))
        face.submit(ReleaseLease(f"{number}"))
        face.close()
        until(lambda: ReleaseLease(f"{number}") in owner.asked)  # noqa: B023
