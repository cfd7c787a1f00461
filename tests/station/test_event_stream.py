"""Events for callers in other processes: in order, to the last line, and never at the station's expense."""

from __future__ import annotations

import json
import socket
import threading
import time

import pytest
from birdcage.station import event_stream
from birdcage.station.control_client import OwnerGone, call_owner, find_owner, follow_owner
from birdcage.station.control_messages import ControlCall, TellStatus, as_line, call_to_json
from birdcage.station.control_server import ControlServer
from birdcage.station.event_stream import LONGEST_QUEUE
from birdcage.station.events import MoveProgress, TranscriptLine
from birdcage.station.json_form import event_from_json
from birdcage.station.requests import Stop, Unwatch, Watch
from birdcage.station.state import LinkPhase

from .owner_stand_in import OwnerStandIn


@pytest.fixture
def owner(tmp_path):
    port = tmp_path / "port"
    port.touch()
    owner = OwnerStandIn(str(port))
    owner.server = ControlServer(owner, tmp_path / "owners")
    owner.link(LinkPhase.UP)
    owner.found = find_owner(tmp_path / "owners", str(port))
    yield owner
    owner.server.close()


def hearing(owner):
    """Who is told of events."""
    return [listener for listener, _kinds in owner.board._listeners]


def until(seen, within_s=10.0) -> None:
    end = time.monotonic() + within_s
    while not seen():
        assert time.monotonic() < end, "not seen in time"
        threading.Event().wait(0.01)


def listening(owner, *, watch: Watch | None = None) -> socket.socket:
    """Ask for events, and return once the answer has come."""
    caller = socket.create_connection(("127.0.0.1", owner.found.tcp_port), 5)
    caller.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
    caller.sendall(as_line(call_to_json(owner.found.token, ControlCall(watch or TellStatus(), "you", events=True))))
    answer = b""
    while not answer.endswith(b"\n"):
        answer += caller.recv(1)
    assert json.loads(answer)["ok"] is True
    return caller


def tell(owner, text: str) -> TranscriptLine:
    line = TranscriptLine(*owner.board.stamp(), "<", text)
    owner.board.tell(line)
    return line


def lines_of(caller: socket.socket) -> list[dict[str, object]]:
    with caller, caller.makefile("rb") as lines:
        return [json.loads(line) for line in lines if line.endswith(b"\n")]


def test_events_follow_the_answer_in_order_to_a_last_line(owner) -> None:
    caller = listening(owner)
    told = [tell(owner, f"line {number}") for number in range(20)]
    owner.server.close()
    *events, last = lines_of(caller)
    assert [event_from_json(each) for each in events] == told
    assert (last["type"], last["why"]) == ("EventsEnded", "closing")


def test_nothing_between_question_and_answer_is_lost(owner, monkeypatch) -> None:
    """The state in the answer and the events after it leave no gap."""
    told = []
    monkeypatch.setattr(owner, "submit", lambda asked: told.append(tell(owner, "meanwhile")) or done(asked))
    done = OwnerStandIn.submit.__get__(owner)
    caller = listening(owner, watch=Watch("you", frozenset({"rssi"})))
    owner.server.close()
    assert [event_from_json(each) for each in lines_of(caller)[:1]] == told[:1]


def test_who_reads_too_slowly_is_told_and_dropped_and_the_station_does_not_wait(owner) -> None:
    caller = listening(owner)
    begun = time.monotonic()
    for number in range(20 * LONGEST_QUEUE):
        tell(owner, f"{number} " + "x" * 500)
    assert time.monotonic() - begun < 5.0
    *events, last = lines_of(caller)
    assert len(events) < 20 * LONGEST_QUEUE
    assert [each["text"].split()[0] for each in events] == [str(number) for number in range(len(events))]
    assert (last["type"], last["why"]) == ("EventsEnded", "slow")
    until(lambda: hearing(owner) == [owner.server._hear])


def test_who_never_reads_is_dropped(owner, monkeypatch) -> None:
    monkeypatch.setattr(event_stream, "LAST_LINE_S", 0.2)
    with listening(owner):
        for _ in range(20 * LONGEST_QUEUE):
            tell(owner, "x" * 500)
        until(lambda: hearing(owner) == [owner.server._hear])
        assert call_owner(owner.found, Stop("you"), "you")["confirmed"] is True


def test_a_caller_that_hangs_up_is_forgotten_with_what_it_watched(owner) -> None:
    caller = listening(owner, watch=Watch("you", frozenset({"rssi"}), 2.0))
    assert owner.asked == [Watch("you (outside)", frozenset({"rssi"}), 2.0)]
    caller.close()
    until(lambda: len(owner.asked) == 2)
    assert owner.asked[1] == Unwatch("you (outside)")
    until(lambda: hearing(owner) == [owner.server._hear])


def test_a_watch_that_another_caller_has_replaced_stays(owner) -> None:
    first = listening(owner, watch=Watch("you", frozenset({"rssi"})))
    second = listening(owner, watch=Watch("you", frozenset({"position"})))
    first.close()
    until(lambda: len(owner.board._listeners) == 2)
    assert not [each for each in owner.asked if isinstance(each, Unwatch)]
    second.close()
    until(lambda: any(isinstance(each, Unwatch) for each in owner.asked))


def test_a_watch_can_be_ended_from_outside(owner) -> None:
    call_owner(owner.found, Unwatch("you"), "you")
    assert owner.asked == [Unwatch("you (outside)")]


def test_fifty_listeners_hear_the_same(owner) -> None:
    callers = [listening(owner) for _ in range(50)]
    told = [tell(owner, f"line {number}") for number in range(10)]
    owner.server.close()
    for caller in callers:
        assert [event_from_json(each) for each in lines_of(caller)[:-1]] == told


def test_stop_passes_by_those_who_listen(owner) -> None:
    callers = [listening(owner) for _ in range(20)]
    begun = time.monotonic()
    assert call_owner(owner.found, Stop("you"), "you")["confirmed"] is True
    assert time.monotonic() - begun < 1.0
    for caller in callers:
        caller.close()


def test_an_event_that_json_can_not_hold_is_left_out(owner, caplog) -> None:
    caller = listening(owner)
    owner.board.tell(MoveProgress(*owner.board.stamp(), None, float("nan"), 0.0))
    told = tell(owner, "after it")
    owner.server.close()
    assert [event_from_json(each) for each in lines_of(caller)[:-1]] == [told]
    assert "not told to other programs" in caplog.text


def test_the_client_yields_events_to_the_last_line(owner) -> None:
    with follow_owner(owner.found, TellStatus(), "you") as events:
        tell(owner, "bell\x1b[2J")
        owner.server.close()
        heard = list(events)
    assert [each["type"] for each in heard] == ["TranscriptLine", "EventsEnded"]
    assert heard[0]["text"] == "bell[2J"


def test_a_stream_that_is_cut_off_raises_and_leaves_the_file_of_a_living_owner(owner) -> None:
    with follow_owner(owner.found, TellStatus(), "you") as events:
        tell(owner, "first")
        assert next(events)["text"] == "first"
        owner.server._callers[-1].hang_up()
        with pytest.raises(OwnerGone):
            next(events)
    assert owner.found.file.exists()
