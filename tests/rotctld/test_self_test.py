"""What the self-test makes of servers that answer badly: each as a client of that kind would take it."""

from __future__ import annotations

import contextlib
import socket
import threading

import pytest
from birdcage.rotctld import self_test as module
from birdcage.rotctld.recorded_session import NAMES, packaged_sessions
from birdcage.rotctld.self_test import SelfTestVerdict, self_test

GOOD = {b"p": b"170.00\n18.00\n", b"P": b"RPRT 0\n", b"S": b"RPRT 0\n", b"_": b"A dish\n"}


def answer(command):
    """Answer as the recordings have it."""
    if command.startswith(b"\\dump_state"):
        return next(packaged_sessions("hamlib"))[0].answer
    return GOOD.get(command.strip()[:1], b"RPRT 0\n")


@pytest.fixture
def server(monkeypatch):
    """Serve with a function that says on a socket what it makes of a command; return the address."""
    monkeypatch.setattr(module, "PATIENCE_S", 0.3)
    listeners = []

    def server(say):
        listener = socket.create_server(("127.0.0.1", 0))
        listeners.append(listener)

        def serve():
            with contextlib.suppress(OSError):
                while True:
                    line, _ = listener.accept()
                    with line, contextlib.suppress(OSError):
                        line.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
                        while command := line.recv(100):
                            say(line, command)

        threading.Thread(target=serve, daemon=True).start()
        return listener.getsockname()

    yield server
    for listener in listeners:
        with contextlib.suppress(OSError):
            listener.shutdown(socket.SHUT_RDWR)
        listener.close()


@pytest.mark.parametrize("name", NAMES)
def test_a_good_server_is_good(server, name):
    address = server(lambda line, command: line.sendall(answer(command)))
    results = list(self_test(address, name))
    assert results
    assert all(result.good for result in results), results


class TellingSocket(socket.socket):
    """Tells when something was received."""

    received: threading.Event

    def recv(self, *limits):
        data = super().recv(*limits)
        self.received.set()
        return data


@pytest.fixture
def torn(monkeypatch):
    """Answer in two pieces, the second once the first was received."""
    received = threading.Event()

    def connect(*where):
        line = TellingSocket(fileno=plain(*where).detach())
        line.received = received
        return line

    def torn(line, command):
        first, *rest = answer(command).splitlines(keepends=True)
        received.clear()
        line.sendall(first)
        assert received.wait(5.0)
        line.sendall(b"".join(rest))

    plain = socket.create_connection
    monkeypatch.setattr(module.socket, "create_connection", connect)
    return torn


@pytest.mark.parametrize(
    ("name", "verdict"),
    [("gpredict", SelfTestVerdict.TORN), ("satdump", SelfTestVerdict.TORN), ("sdrangel", SelfTestVerdict.GOOD)],
)
def test_an_answer_in_pieces_is_torn_for_who_reads_it_with_one_recv(server, torn, name, verdict):
    first = next(result for result in self_test(server(torn), name) if result.sent == b"p\n")
    assert first.verdict is verdict


def test_a_server_that_says_nothing_is_silent(server):
    (result,) = self_test(server(lambda _line, _command: None), "gpredict")
    assert (result.verdict, result.came) == (SelfTestVerdict.SILENT, b"")


def test_a_late_answer_is_slow(server, monkeypatch):
    monkeypatch.setattr(module, "SLOW_S", 0.0)
    address = server(lambda line, command: line.sendall(answer(command)))
    assert next(self_test(address, "gpredict")).verdict is SelfTestVerdict.SLOW


def test_an_error_is_wrong_at_once_and_has_its_code(server):
    result = next(self_test(server(lambda line, _command: line.sendall(b"RPRT -6\n")), "gpredict"))
    assert (result.verdict, result.code) == (SelfTestVerdict.WRONG, -6)
    assert result.took_s < 0.25


def test_no_server_at_all_is_unreached():
    with socket.create_server(("127.0.0.1", 0)) as gone:
        address = gone.getsockname()
    (result,) = self_test(address, "gpredict")
    assert result.verdict is SelfTestVerdict.UNREACHED
