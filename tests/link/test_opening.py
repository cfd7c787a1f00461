from __future__ import annotations

import socket
import threading

import pytest
from birdcage.base.clock import RealClock, VirtualClock, WaitOutcome
from birdcage.base.errors import LinkError
from birdcage.link.opening import has_speed, open_link


class StandIn:
    name = "sim:g2"
    demo = True

    def __init__(self, address="", clock=None, baud=None):
        self.address, self.clock, self.baud = address, clock, baud
        self.written = b""

    def fileno(self):
        return None

    def pending(self):
        return False

    def next_event(self):
        return 5.0

    def read(self):
        return b""

    def write(self, data):
        self.written += data

    def discard(self):
        pass

    def close(self):
        pass


class EntryPoint:
    name = "sim"

    def __init__(self, opener):
        self._opener = opener

    def load(self):
        return self._opener


@pytest.fixture
def register(monkeypatch):
    def use(opener):
        def entry_points(*, group):
            assert group == "birdcage.link"
            return [EntryPoint(opener)]

        monkeypatch.setattr("importlib.metadata.entry_points", entry_points)

    return use


@pytest.fixture
def server():
    listener = socket.create_server(("127.0.0.1", 0))
    yield listener
    listener.close()


def test_a_registered_scheme_gets_its_address_the_clock_and_the_rate(register):
    made = []

    def opener(address, *, clock, baud):
        made.append(StandIn(address, clock, baud))
        return made[-1]

    register(opener)
    clock = VirtualClock()
    link = open_link("sim:g2?seed=3", baud=115200, clock=clock)
    assert (made[0].address, made[0].clock, made[0].baud) == ("g2?seed=3", clock, 115200)
    assert link.demo
    assert link.next_event() == 5.0
    link.write(b"q")
    assert made[0].written == b"q"


def test_an_unknown_scheme_names_what_there_is(register):
    register(StandIn)
    with pytest.raises(LinkError, match=r"'smi'.*socket://host:port.*sim:NAME") as refused:
        open_link("smi:g2", baud=115200, clock=VirtualClock())
    assert refused.value.reason == "unsupported"


@pytest.mark.parametrize(
    ("error", "reason"),
    [
        (ValueError("there is no firmware g3; there is g2"), "unsupported"),
        (KeyError("there is no firmware g3; there is g2"), "unsupported"),
        (ConnectionError("there is no firmware g3; there is g2"), "missing"),
        (OSError("there is no firmware g3; there is g2"), "failed"),
    ],
)
def test_what_a_scheme_refuses_is_passed_on_in_its_words(register, error, reason):
    def opener(address, *, clock, baud):
        raise error

    register(opener)
    with pytest.raises(LinkError, match=r"sim:g3.*: there is no firmware g3; there is g2\.$") as refused:
        open_link("sim:g3", baud=115200, clock=VirtualClock())
    assert refused.value.reason == reason


def test_socket_reads_from_the_first_byte_and_notices_the_end(server):
    url = f"socket://127.0.0.1:{server.getsockname()[1]}"
    opened = []
    thread = threading.Thread(target=lambda: opened.append(server.accept()[0]))
    thread.start()
    clock = RealClock()
    link = open_link(url, baud=57600, clock=clock)
    thread.join()
    (peer,) = opened
    peer.sendall(b"Boot\r\n")
    assert clock.wait(link, clock.monotonic() + 2) is WaitOutcome.READY
    assert link.read() == b"Boot\r\n"
    assert link.fileno() is not None
    link.write(b"mot\r")
    assert peer.recv(100) == b"mot\r"
    peer.close()
    assert clock.wait(link, clock.monotonic() + 2) is WaitOutcome.READY
    with pytest.raises(LinkError) as lost:
        link.read()
    assert lost.value.reason == "lost"
    link.close()
    assert link.fileno() is None


def test_a_socket_that_nobody_listens_on(server):
    port = server.getsockname()[1]
    server.close()
    with pytest.raises(LinkError, match="serial server") as refused:
        open_link(f"socket://127.0.0.1:{port}", baud=57600, clock=RealClock())
    assert refused.value.reason == "missing"


@pytest.mark.parametrize("url", ["socket://nowhere", "socket://:4", "socket://h:99999", "socket://h:x"])
def test_a_socket_without_host_or_port(url):
    with pytest.raises(LinkError, match="socket://host:port") as refused:
        open_link(url, baud=57600, clock=RealClock())
    assert refused.value.reason == "unsupported"


def test_rfc2217_that_nobody_listens_on(server):
    port = server.getsockname()[1]
    server.close()
    with pytest.raises(LinkError, match="serial server") as refused:
        open_link(f"rfc2217://127.0.0.1:{port}", baud=57600, clock=RealClock())
    assert refused.value.reason == "missing"


def test_loop_reads_back_its_own_bytes():
    clock = RealClock()
    link = open_link("loop://", baud=57600, clock=clock)
    assert link.fileno() is None
    assert not link.pending()
    link.write(b"hello")
    assert clock.wait(link, clock.monotonic() + 1) is WaitOutcome.READY
    assert link.read() == b"hello"
    link.close()
    with pytest.raises(LinkError, match="closed by this program"):
        link.write(b"x")


def test_no_port_given():
    with pytest.raises(LinkError, match="--port") as refused:
        open_link("", baud=57600, clock=VirtualClock())
    assert refused.value.reason == "missing"


@pytest.mark.parametrize(
    ("url", "device"),
    [
        ("/dev/ttyACM0", "/dev/ttyACM0"),
        ("/dev/serial/by-id/usb-Winegard_SK2DISH-if00", "/dev/ttyACM3"),
        ("/dev/cu.usbmodem14201", "/dev/cu.usbmodem14201"),
    ],
)
def test_1200_baud_is_refused_on_a_cdc_port(monkeypatch, url, device):
    monkeypatch.setattr("birdcage.link.opening.Path.resolve", lambda self: type(self)(device))
    monkeypatch.setattr("birdcage.link.opening.Path.stat", lambda self: type("S", (), {"st_mode": 0o020660}))
    monkeypatch.setattr("birdcage.link.opening.Path.exists", lambda self: True)
    with pytest.raises(LinkError, match="1200 baud") as refused:
        open_link(url, baud=1200, clock=VirtualClock())
    assert refused.value.reason == "unsupported"
    # Any other rate is tried, and fails only because there is no such device here.
    with pytest.raises(LinkError) as tried:
        open_link(url, baud=9600, clock=VirtualClock())
    assert tried.value.reason == "missing"


@pytest.mark.parametrize(
    ("url", "ours"),
    [
        ("/dev/ttyUSB0", True),
        ("COM4", True),
        ("rfc2217://host:2000", True),
        ("sim:g2", True),
        ("socket://host:2000", False),
    ],
)
def test_whose_the_rate_is(url, ours):
    assert has_speed(url) is ours
