"""Clients that come, ask, and go: what each gets over a real socket, and what becomes of the dish."""

from __future__ import annotations

import socket
import struct
from selectors import EVENT_WRITE

import pytest
from birdcage.rotctld.options import RotctldOptions
from birdcage.rotctld.served_client import ENOUGH_UNSENT, HangUp
from birdcage.station.network_state import NetworkProgram, NetworkRole

from tests.rotctld.net_bench import NetBench


@pytest.fixture
def bench():
    bench = NetBench().connect()
    yield bench
    bench.close()


def is_at(client, az_deg, el_deg):
    return [float(each) for each in client.ask(b"p\n").split()] == pytest.approx([az_deg, el_deg], abs=0.1)


def test_it_listens_and_answers_before_the_dish_is_there():
    bench = NetBench()
    client = bench.join()
    assert client.ask(b"p\n") == b"RPRT -6\n"
    assert client.ask(b"\\dump_state\n").endswith(b"done\n")
    bench.connect()
    bench.run(2.0)
    az, el = client.ask(b"p\n").split()
    assert (float(az), float(el)) == pytest.approx((bench.state.position.az_deg, bench.state.position.el_deg), abs=0.01)
    bench.close()


def test_a_wish_moves_the_dish_and_its_end_frees_control(bench):
    client = bench.join()
    bench.run(1.0)
    assert client.ask(b"P 180 45\n") == b"RPRT 0\n"
    bench.run(15.0)
    assert is_at(client, 180.0, 45.0)
    assert bench.state.holder == "rotctld 1"
    client.line.close()
    bench.run(1.0)
    assert bench.state.holder is None
    assert bench.network.clients == ()


def test_every_reply_is_one_piece_and_they_come_in_order(bench):
    client = bench.join()
    sent = []
    served = next(iter(bench.service._served.values())).client
    send = served.line.send
    served.line = Spy(served.line, sent)
    client.send(b"p\n_\nzzz\n")
    assert len(sent) == 3
    assert sent[0].count(b"\n") == 2
    assert sent[2].startswith(b"RPRT -")
    assert client.read() == b"".join(sent)
    assert send is not None


class Spy:
    """A socket that keeps what each `send` was given."""

    def __init__(self, line, sent):
        self._line, self._sent = line, sent

    def __getattr__(self, name):
        return getattr(self._line, name)

    def send(self, data):
        self._sent.append(data)
        return self._line.send(data)


def test_it_sends_at_once_and_notices_who_is_gone(bench):
    bench.join()
    line = next(iter(bench.service._served.values())).client.line
    assert line.getsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY)
    assert line.getsockopt(socket.SOL_SOCKET, socket.SO_KEEPALIVE)
    if hasattr(socket, "TCP_KEEPIDLE"):
        assert line.getsockopt(socket.IPPROTO_TCP, socket.TCP_KEEPIDLE) <= 15


def test_q_hangs_up_and_a_half_closed_side_still_gets_its_answer(bench):
    client = bench.join()
    assert client.ask(b"p\nq\np\n").count(b"\n") == 2
    assert client.read() is None
    half = bench.join()
    half.line.sendall(b"_")
    half.line.shutdown(socket.SHUT_WR)
    bench.turn()
    assert half.read() == b"Carryout G2\n"
    bench.turn()
    assert half.read() is None
    assert [news.why for news in bench.news] == [None, HangUp.QUIT, None, HangUp.QUIT]


def test_one_killed_in_mid_command_leaves_nothing_behind(bench):
    bench.run(1.0)
    client, other = bench.join(), bench.join()
    client.send(b"P 200 45\nP 123 4")
    client.line.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))  # as kill -9 in full flight
    client.line.close()
    bench.run(20.0)
    assert is_at(other, 200.0, 45.0)
    assert bench.state.holder is None
    assert [each.name for each in bench.network.clients] == ["rotctld 2"]
    assert other.ask(b"P 190 45\n") == b"RPRT 0\n"
    bench.run(0.5)
    assert bench.state.holder == "rotctld 2"


def test_one_that_floods_and_never_reads_slows_no_other_and_is_hung_up_on():
    bench = NetBench(settings={"commands_per_s": 1e6}).connect()
    flooder, other = bench.join(takes_bytes=4096), bench.join()
    blocked = 0
    while blocked < 20:
        try:
            flooder.line.send(b"p\n" * 2048)
        except BlockingIOError:
            blocked += 1
        bench.turn(1)
        assert other.ask(b"_\n") == b"Carryout G2\n"
    served = bench.service._served[1].client
    assert served.events == EVENT_WRITE  # nothing more is read from it
    assert len(served._unsent) < 2 * ENOUGH_UNSENT
    assert other.ask(b"_\n") == b"Carryout G2\n"
    bench.run(16.0)
    assert other.ask(b"_\n") == b"Carryout G2\n"
    assert [(news.client.name, news.why) for news in bench.news if news.why] == [("rotctld 1", HangUp.SLOW)]
    bench.close()


def test_what_it_may_ask_in_a_second_is_limited_and_all_of_it_is_answered():
    bench = NetBench(settings={"commands_per_s": 20.0}).connect()
    client = bench.join()
    client.send(b"_\n" * 100)
    first = client.read().count(b"\n")
    assert first <= 21
    bench.run(2.0)
    second = client.read().count(b"\n")
    assert 35 <= second <= 45
    bench.run(4.0)
    assert first + second + client.read().count(b"\n") == 100
    bench.close()


def test_the_longest_silent_one_makes_room_for_a_new_one():
    bench = NetBench(settings={"most_clients": 2}).connect()
    first, second = bench.join(), bench.join()
    assert bench.join().read() is None  # both have just come
    assert bench.news[-1].why is HangUp.FULL
    bench.run(11.0)
    assert second.ask(b"_\n") == b"Carryout G2\n"
    third = bench.join()
    assert third.ask(b"_\n") == b"Carryout G2\n"
    assert first.read() is None
    assert bench.network.turned_away == 1
    bench.close()


def test_one_that_has_control_keeps_its_place():
    bench = NetBench(settings={"most_clients": 1}).connect()
    first = bench.join()
    bench.run(1.0)
    assert first.ask(b"P 180 45\n") == b"RPRT 0\n"
    bench.run(20.0)
    assert bench.join().read() is None
    assert is_at(first, 180.0, 45.0)
    bench.close()


def test_one_that_says_nothing_for_too_long_is_hung_up_on_where_that_is_set():
    bench = NetBench(settings={"silent_s": 60.0}).connect()
    client, other = bench.join(), bench.join()
    for _ in range(4):
        bench.run(20.0)
        assert other.ask(b"_\n") == b"Carryout G2\n"
    assert client.read() is None
    assert bench.news[-1].why is HangUp.SILENT
    bench.close()


def test_a_client_from_elsewhere_is_not_let_in(monkeypatch):
    bench = NetBench(settings={"allow": "192.168.7.0/24"}).connect()
    monkeypatch.setattr(bench.service, "_listener", Elsewhere(bench.service._listener))
    client = bench.join()
    assert client.read() is None
    assert bench.news[-1].why is HangUp.NOT_ALLOWED
    assert bench.network.turned_away == 1
    bench.close()


class Elsewhere:
    """A listener whose clients seem to come from another network."""

    def __init__(self, listener):
        self._listener = listener

    def __getattr__(self, name):
        return getattr(self._listener, name)

    def accept(self):
        line, (_, port) = self._listener.accept()
        return line, ("10.1.2.3", port)


def test_a_fault_of_ours_ends_one_connection_only(bench, monkeypatch):
    client, other = bench.join(), bench.join()
    rotor = bench.service._served[1].rotor
    monkeypatch.setattr(type(rotor), "name", lambda self: 1 / 0 if self is rotor else "Dish")
    assert client.ask(b"_\n") is None
    assert other.ask(b"_\n") == b"Dish\n"
    assert bench.news[-1].why is HangUp.FAULT


def test_faces_see_who_is_there_and_what_they_say(bench):
    client, other = bench.join(), bench.join()
    bench.run(1.0)
    client.send(b"P 180,5 45\n")
    other.send(b"P 10 50\n")
    other.send(b"zzz\n")
    first, second = bench.network.clients
    assert (first.name, first.role, first.wants_az_deg) == ("rotctld 1", NetworkRole.CONTROL, 180.5)
    assert (second.role, second.ignored, second.errors) == (NetworkRole.IGNORED, 1, 1)
    assert "rotctld 1 has control" in second.why
    assert first.program is NetworkProgram.UNKNOWN
    assert [(line.command, line.reply) for line in second.lines] == [("P 10 50", "RPRT 0"), ("zzz", "RPRT -4")]
    assert first.last_command == "P 180,5 45"
    assert bench.network.address == f"127.0.0.1:{bench.service.address[1]}"
    for _ in range(60):
        client.send(b"p\n")
    assert len(bench.network.clients[0].lines) == 50


def test_what_no_terminal_shows_is_not_kept(bench):
    client = bench.join()
    client.send(b"\x1b]0;title\x07 \xff\n")
    assert all(line.command.isprintable() for line in bench.network.clients[0].lines)


def test_the_end_hangs_up_on_all_and_gives_the_port_back(bench):
    client = bench.join()
    bench.run(1.0)
    client.send(b"P 180 45\n")
    port = bench.service.address[1]
    bench.service.shutdown()
    assert client.read() is None or client.read() is None
    assert bench.state.network is None
    with socket.create_server(("127.0.0.1", port)):
        pass
    bench.step(3.0)
    assert bench.news[-1].why is HangUp.CLOSING
    assert (bench.state.motion, bench.state.holder, bench.state.held) == (None, None, None)
    assert abs(bench.state.position.az_deg - 180.0) > 10.0  # what it moved has ended, too


def test_a_dish_that_was_leap_frogged_comes_back_when_it_is_told_again():
    bench = NetBench(options=RotctldOptions(leapfrog=True)).connect()
    client = bench.join()
    bench.run(1.0)
    for az_deg in (14, 20):
        client.send(f"P {az_deg} 45\n".encode())
        bench.run(2.0)
    client.read()
    assert is_at(client, 21.0, 45.0)
    for _ in range(2):  # the first may overshoot by half a degree the other way
        client.send(b"P 20 45\n")
        bench.run(2.0)
    client.read()
    assert is_at(client, 20.0, 45.0)
    bench.close()
