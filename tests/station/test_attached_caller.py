"""Attached programs as a station has to bear them: many, mute, deaf, confused."""

from __future__ import annotations

import contextlib
import random
import socket
import threading
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import replace
from datetime import UTC, datetime

import pytest
from birdcage.base.errors import BirdcageError, Held
from birdcage.station import attached_caller
from birdcage.station.attach_messages import Attach, ShowNetwork, asked_from_json, state_from_json
from birdcage.station.control_client import call_owner
from birdcage.station.control_messages import as_line
from birdcage.station.event_stream import LONGEST_QUEUE
from birdcage.station.json_form import event_from_json, to_json
from birdcage.station.network_state import NetworkClient, NetworkLine, NetworkProgram, NetworkState
from birdcage.station.requests import AcquireLease, Drive, Goto, Jog, Stop
from birdcage.station.state import StationState
from hypothesis import given, settings
from hypothesis import strategies as st

from .attached_bench import Caller, is_alone, tell, until


def test_it_is_told_the_whole_state_first_and_what_changes_after_that(owner, attach) -> None:
    anna = attach()
    whole = anna.hear()
    assert whole["type"] == "StateTold"
    assert state_from_json(whole, StationState()) == owner.state
    owner.board.change(holder="bert", homed=True)
    assert anna.hear() == {"v": 1, "type": "StateChanged", "changes": {"holder": "bert", "homed": True}}


def test_no_state_is_older_than_the_event_or_answer_behind_it_and_none_goes_back(owner, attach) -> None:
    callers = [attach(f"face {number}") for number in range(5)]
    over = threading.Event()

    def warn() -> None:
        """Another thread changes the state all the while."""
        number = 0
        while not over.is_set():
            number += 1
            owner.board.warn("other", str(number))

    other = threading.Thread(target=warn)
    other.start()
    for number in range(300):
        owner.board.change(target_miss_deg=float(number))
        tell(owner, str(number))
    over.set()
    other.join()
    for caller in callers:
        state, warned, heard = StationState(), 0, 0
        while heard < 300:
            told = caller.hear()
            if told["type"].startswith("State"):
                state = state_from_json(told, state)
                now = int(state.warnings.get("other", 0))
                assert now >= warned
                warned = now
            elif told["type"] == "TranscriptLine":
                assert state.target_miss_deg >= float(told["text"])
                heard += 1


def test_each_event_comes_with_the_state_of_its_moment(owner, attach) -> None:
    anna = attach()
    for number in range(200):
        owner.board.change(target_miss_deg=float(number))
        tell(owner, str(number))
    state, heard = StationState(), 0
    while heard < 200:
        told = anna.hear()
        if told["type"].startswith("State"):
            state = state_from_json(told, state)
        else:
            assert state.target_miss_deg == float(told["text"])
            heard += 1


def test_changes_without_an_event_are_gathered(owner, attach) -> None:
    anna = attach()
    anna.hear()
    for number in range(5000):
        owner.board.change(target_miss_deg=float(number))
    state, lines = StationState(), 0
    while state.target_miss_deg < 4999.0:
        state, lines = state_from_json(anna.hear(), state), lines + 1
    assert lines < 1000


def test_answers_come_as_they_are_done_with_their_numbers(owner, attach) -> None:
    open_ = {}

    def submit(request):
        open_[request] = Future()
        open_[request].set_running_or_notify_cancel()
        return open_[request]

    owner.submit = submit
    anna = attach()
    for number, request in enumerate((Jog(1.0, 0.0, "anna"), AcquireLease("anna"), Goto(10.0, 45.0, "anna"))):
        anna.ask(number, request)
    until(lambda: len(open_) == 3)
    open_[Goto(10.0, 45.0, "anna")].set_exception(Held("HELD by bert."))
    assert anna.until(id=2)["error"] == {"kind": "Held", "reason": "held", "sentence": "HELD by bert."}
    open_[AcquireLease("anna")].set_result(None)
    assert anna.until(id=1) == {"v": 1, "id": 1, "ok": True, "result": None}
    open_[Jog(1.0, 0.0, "anna")].set_exception(RuntimeError("boom"))
    assert "boom" in anna.until(id=0)["error"]["sentence"]


def test_stop_waits_for_no_request(owner, attach) -> None:
    owner.submit = lambda _request: Future()
    anna = attach()
    for number in range(20):
        anna.ask(number, Goto(10.0, 45.0, "anna"))
    anna.ask(99, Stop("anna"))
    assert anna.until(id=99)["ok"] is True
    assert owner.stops == ["anna"]


def test_too_many_open_requests_are_refused_and_stop_is_not(owner, attach) -> None:
    asked = []
    owner.submit = lambda request: asked.append(request) or Future()
    anna = attach()
    for number in range(attached_caller.MOST_OPEN + 1):
        anna.ask(number, Drive(1, 0, "anna"))
    refused = anna.until(id=attached_caller.MOST_OPEN)
    assert refused["error"]["reason"] == "busy"
    assert len(asked) == attached_caller.MOST_OPEN
    anna.ask(1000, Stop("anna"))
    assert anna.until(id=1000)["ok"] is True


@pytest.mark.parametrize("field", ["holder", "by"])
def test_nobody_outside_is_the_person_at_the_station(owner, attach, field) -> None:
    anna = attach()
    anna.ask(1, Jog(1.0, 0.0, "you") if field == "holder" else Stop("you"))
    assert f'{field} is "you". Give the name' in anna.until(id=1)["error"]["sentence"]
    assert (owner.asked, owner.stops) == ([], [])


@pytest.mark.parametrize("name", ["", " ", "you", "console", "x" * 61])
def test_a_name_is_a_name(owner, name) -> None:
    with pytest.raises(BirdcageError, match="can't be a name here"):
        call_owner(owner.found, Attach(name), "test")


@pytest.mark.parametrize("line", [
    b"\n", b"hello\n", b"[]\n", b'{"v": 1}\n', b'{"v": 1, "id": -1}\n', b'{"v": 1, "id": true}\n',
    b"x" * 1_000_100 + b"\n", b"x" * 1_000_100, b'{"v": 1, "id": 1e3}\n', b"\xff\xfe\n", b"[" * 4000 + b"\n",
])  # fmt: skip
def test_a_line_that_is_none_is_answered_and_ends_it(owner, attach, line) -> None:
    anna = attach()
    anna.say(line)
    assert anna.until(id=None)["error"]["kind"] == "BadMessage"
    last = anna.until(type="EventsEnded")
    assert last["why"] == "bad line"
    assert anna.hear() is None
    until(lambda: is_alone(owner))


@pytest.mark.parametrize("told", [
    {"v": 2, "id": 1, "request": {}}, {"v": 1, "id": 1}, {"v": 1, "id": 1, "request": []},
    {"v": 1, "id": 1, "request": {"v": 1, "type": "Pursue"}}, {"v": 1, "id": 1, "request": {"v": 1, "type": "Hat"}},
    {"v": 1, "id": 1, "request": {"v": 1, "type": "Goto", "az_deg": "x"}}, {"v": 1, "id": 1, "then": 2},
])  # fmt: skip
def test_a_request_that_is_none_is_answered_and_ends_nothing(owner, attach, told) -> None:
    anna = attach()
    anna.say(told)
    assert anna.until(id=1)["error"]["kind"] == "BadMessage"
    anna.ask(2, AcquireLease("anna"))
    assert anna.until(id=2)["ok"] is True
    assert owner.asked == [AcquireLease("anna")]


def test_any_bytes_hurt_nobody(owner, attach) -> None:
    bert = attach("bert")
    chance = random.Random(7)
    good = as_line({"v": 1, "id": 5, "request": to_json(Goto(10.0, 45.0, "anna"))})
    for _ in range(150):
        said = bytearray(chance.choice([good, good * 3, chance.randbytes(200), b"\n".join([good, b"{}", good])]))
        for _ in range(chance.randrange(4)):
            said[chance.randrange(len(said))] = chance.randrange(256)
        enemy = Caller(owner, "enemy")
        with contextlib.suppress(OSError):
            for at in range(0, len(said), 50):
                enemy.line.sendall(said[at : at + 50])
        enemy.close()
    bert.ask(1, AcquireLease("bert"))
    assert bert.until(id=1)["ok"] is True
    assert owner.stops == []
    bert.close()
    until(lambda: is_alone(owner))


@settings(max_examples=60, deadline=None, database=None)
@given(
    st.recursive(
        st.none() | st.booleans() | st.integers() | st.floats() | st.text(),
        lambda inner: st.lists(inner, max_size=3) | st.dictionaries(
            st.sampled_from(["v", "id", "request", "type", "holder"]) | st.text(), inner, max_size=4
        ),
        max_leaves=10,
    )
)  # fmt: skip
def test_any_json_is_a_request_or_refused_in_one_way(told) -> None:
    with contextlib.suppress(BirdcageError):
        _number, request = asked_from_json(told)
        assert isinstance(request, BirdcageError) or to_json(request)


def test_twenty_callers_hear_the_same_and_are_all_answered(owner, attach) -> None:
    callers = [attach(f"face {number}") for number in range(20)]
    told = [tell(owner, f"line {number}") for number in range(50)]
    with ThreadPoolExecutor(20) as pool:
        list(pool.map(lambda caller: caller.ask(1, AcquireLease("x")), callers))
    for caller in callers:
        heard = []
        while len(heard) < len(told):
            line = caller.hear()
            if line["type" if "type" in line else "id"] == "TranscriptLine":
                heard.append(event_from_json(line))
        assert heard == told
    assert len(owner.asked) == 20
    names = {caller.welcome["result"]["name"] for caller in callers}
    assert len(names) == 20


def test_who_never_reads_is_dropped_and_harms_no_other(owner, attach, monkeypatch) -> None:
    monkeypatch.setattr(attached_caller, "LAST_LINE_S", 0.2)
    deaf, bert = attach("deaf"), attach("bert")
    deaf.line.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
    heard, over = [], threading.Event()

    def read() -> None:
        for told in bert.hear_all():
            heard.append(told)
            if told.get("id") == 1:
                over.set()
                return

    reader = threading.Thread(target=read)
    reader.start()
    for number in range(4 * LONGEST_QUEUE):
        tell(owner, f"{number} " + "x" * 10_000)
        if number % 100 == 99:
            until(lambda: sum(each.get("type") == "TranscriptLine" for each in heard) > number - 90)  # noqa: B023
    until(lambda: len(owner.board._watchers) == 1)  # the deaf one is gone
    bert.ask(1, AcquireLease("bert"))
    assert over.wait(10.0)
    reader.join(10.0)
    deaf.line.settimeout(10.0)
    with contextlib.suppress(ConnectionError):
        while deaf.line.recv(2**20):
            pass  # what the system had kept for it, and then the end


def test_the_end_of_the_station_is_told_in_a_last_line(owner, attach) -> None:
    anna = attach()
    last_words = tell(owner, "last words")
    owner.server.close()
    *_, event, last = anna.hear_all()
    assert event_from_json(event) == last_words
    assert (last["type"], last["why"]) == ("EventsEnded", "closing")


SERVER = NetworkState("127.0.0.1", 4533, clients=(
    NetworkClient(
        1, "rotctld 1", NetworkProgram.GPREDICT, "127.0.0.1:5000", datetime(2026, 3, 20, tzinfo=UTC),
        wants_az_deg=200.0, lines=(NetworkLine(datetime(2026, 3, 20, tzinfo=UTC), "p", "180.00 45.00"),) * 50,
    ),
))  # fmt: skip


def test_the_clients_of_a_caller_are_shown_until_it_leaves(owner, attach) -> None:
    anna = attach()
    anna.ask(1, ShowNetwork(SERVER))
    assert anna.until(id=1)["ok"] is True
    assert owner.state.network == replace(SERVER, by=anna.welcome["result"]["name"])
    anna.close()
    until(lambda: owner.state.network is None)


def test_no_caller_hides_the_server_of_another(owner, attach) -> None:
    own = NetworkState("127.0.0.1", 4600)
    owner.show_network(own)
    anna, bert = attach("anna"), attach("bert")
    for told in (SERVER, None):
        anna.ask(1, ShowNetwork(told))
        assert anna.until(id=1)["error"]["reason"] == "busy"
    owner.show_network(None)
    bert.ask(1, ShowNetwork(SERVER))
    assert bert.until(id=1)["ok"] is True
    owner.show_network(own)  # it shows its own, and then the caller goes
    anna.close()
    bert.close()
    until(lambda: is_alone(owner))
    assert owner.state.network == own
