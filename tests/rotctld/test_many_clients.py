"""Many clients at once, idle ones and bad ones, and answers for which the dish is needed: the others are answered."""

from __future__ import annotations

import contextlib
import resource
import socket
import struct
import threading
from concurrent.futures import Future

import pytest
from birdcage.rotctld.client_rotor import ClientRotor
from birdcage.rotctld.rotor import SignalCounts
from birdcage.rotctld.served_client import HangUp
from birdcage.rotctld.server import RESERVED, RotctldService

from tests.rotctld.net_bench import NetBench


@pytest.fixture
def bench():
    bench = NetBench(settings={"most_clients": 600}).connect()
    bench.run(1.0)
    yield bench
    bench.close()


@pytest.fixture
def many_descriptors():
    """Both ends of every connection are in this process."""
    before = resource.getrlimit(resource.RLIMIT_NOFILE)
    resource.setrlimit(resource.RLIMIT_NOFILE, (max(before[0], min(4096, before[1])), before[1]))
    yield
    resource.setrlimit(resource.RLIMIT_NOFILE, before)


def test_five_hundred_idle_clients_and_bad_ones_beside(many_descriptors, bench):
    asker, flooder = bench.join(), bench.join(takes_bytes=4096)
    idle = []
    for _ in range(500):
        line = socket.socket()
        line.connect(bench.service.address)
        idle.append(line)
        bench.turn(1)
    flooder.line.setblocking(False)
    for number in range(200):
        with contextlib.suppress(BlockingIOError):
            flooder.line.send(b"p\n" * 500)
        idle[number].sendall(b"P 18")  # and leaves it at that
        if number % 3 == 0:
            idle[number].setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
            idle[number].close()
        assert asker.ask(b"_\n") == b"Carryout G2\n"
    bench.run(1.0)
    assert len(bench.network.clients) == 502 - 67
    assert {news.why for news in bench.news} == {None, HangUp.LOST}
    assert asker.ask(b"P 170 45\n") == b"RPRT 0\n"
    bench.run(20.0)
    assert bench.state.position.az_deg == pytest.approx(170.0, abs=0.1)
    for line in idle:
        line.close()


def test_places_are_left_for_the_dish_and_its_files(monkeypatch):
    """The system gives a program only so many descriptors; a cable that comes back needs one, too."""
    # Told and not set: this process may have more of them open than that.
    monkeypatch.setattr(resource, "getrlimit", lambda _which: (RESERVED + 3, RESERVED + 3))
    bench = NetBench(settings={"most_clients": 600})
    clients = [bench.join() for _ in range(4)]
    assert [client.ask(b"_\n") for client in clients[:3]] == [b"Carryout G2\n"] * 3
    assert clients[3].read() is None
    assert bench.news[-1].why is HangUp.FULL
    bench.close()


@pytest.fixture
def asked(monkeypatch):
    """Futures of signals that clients have asked for."""
    asked: list[Future[SignalCounts]] = []

    def read_signal(self, reads):
        asked.append(Future())
        return asked[-1]

    monkeypatch.setattr(ClientRotor, "read_signal", read_signal)
    return asked


def test_an_answer_of_the_dish_is_waited_for_and_holds_up_that_client_only(bench, asked):
    client, other = bench.join(), bench.join()
    assert client.ask(b"R 5\n_\n") == b""
    assert other.ask(b"_\n") == b"Carryout G2\n"
    thread = threading.Thread(target=lambda: asked[0].set_result(SignalCounts(5, 700, 701)))
    thread.start()
    thread.join()
    bench.turn()
    assert client.read() == b"5\n700\n701\nCarryout G2\n"


def test_a_dish_that_does_not_answer_in_time_is_said_so_and_its_late_answer_is_dropped(bench, asked):
    client = bench.join()
    client.send(b"R 5\n_\n")
    bench.run(4.0)
    assert client.read() == b""
    bench.run(2.0)
    assert client.read() == b"RPRT -5\nCarryout G2\n"
    asked[0].set_result(SignalCounts(5, 700, 701))
    bench.run(1.0)
    assert client.ask(b"_\n") == b"Carryout G2\n"


def test_one_that_is_killed_while_the_dish_is_asked_leaves_nothing_behind(bench, asked):
    client, other = bench.join(), bench.join()
    client.send(b"R 5\n")
    client.line.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
    client.line.close()
    bench.run(7.0)
    assert [each.name for each in bench.network.clients] == ["rotctld 2"]
    asked[0].set_result(SignalCounts(5, 700, 701))
    assert other.ask(b"_\n") == b"Carryout G2\n"


def test_it_serves_on_a_thread_of_its_own_and_ends_at_once(bench):
    service: RotctldService = bench.service
    service.start()
    with socket.create_connection(service.address, timeout=5.0) as line:
        line.sendall(b"_\n")
        assert line.recv(100) == b"Carryout G2\n"
        service.shutdown()
        assert service.wait(5.0)
        assert line.recv(100) == b""
    assert service.crash is None


def test_one_without_clients_ends_at_once_too(bench):
    bench.service.start()
    bench.service.shutdown()
    assert bench.service.wait(0.0)
