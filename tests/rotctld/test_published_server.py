"""`RotctldServer` as it was published: made from an antenna, `serve_forever`, `shutdown`."""

from __future__ import annotations

import socket
import threading
import time

import pytest
from birdcage.antenna import AntennaConfig, BirdcageAntenna
from birdcage.protocol import get_protocol
from birdcage.rotctld import RotctldServer
from birdcage.station.session import Session
from birdcage.station.station import Station


@pytest.fixture
def server():
    made = []

    def server(**config):
        antenna = BirdcageAntenna(get_protocol("g2"), AntennaConfig(port="sim:g2?seed=1", **config))
        one = RotctldServer(antenna, "127.0.0.1", 0)
        thread = threading.Thread(target=one.serve_forever, daemon=True)
        thread.start()
        made.append((one, thread))
        return one, antenna

    yield server
    for one, thread in made:
        one.shutdown()
        thread.join(10.0)
        assert not thread.is_alive()


class Client:
    """Asks, and waits for the answer."""

    def __init__(self, address):
        self.line = socket.create_connection(address, timeout=10.0)

    def ask(self, command):
        self.line.sendall(command.encode() + b"\n")
        return self.line.recv(1000).decode()

    def until(self, command, good, within_s=30.0):
        end = time.monotonic() + within_s
        while not good(said := self.ask(command)):
            assert time.monotonic() < end, said
            threading.Event().wait(0.05)
        return said


def wait_for(seen, within_s=30.0):
    end = time.monotonic() + within_s
    while not seen():
        assert time.monotonic() < end
        threading.Event().wait(0.05)


def is_at(az_deg, el_deg):
    return lambda said: (
        "RPRT" not in said and [float(x) for x in said.split()] == pytest.approx([az_deg, el_deg], abs=0.1)
    )


def test_an_antenna_of_a_script_is_served_and_given_back(server):
    one, antenna = server(leapfrog_enabled=False)
    client = Client(one.address)
    client.until("p", lambda said: "RPRT" not in said)
    assert client.ask("P 20 45") == "RPRT 0\n"
    client.until("p", is_at(20.0, 45.0))
    one.shutdown()
    assert client.line.recv(100) == b""
    deadline = time.monotonic() + 10.0
    while antenna.is_connected and time.monotonic() < deadline:
        threading.Event().wait(0.05)
    assert not antenna.is_connected


@pytest.mark.parametrize(("leapfrog", "sent"), [(True, "a 0 21.00"), (False, "a 0 20.00")])
def test_an_antenna_with_leapfrog_overshoots_in_a_stream(server, leapfrog, sent, monkeypatch):
    sessions = []
    start = Session.start
    monkeypatch.setattr(Session, "start", lambda self: (sessions.append(self), start(self)))
    one, _antenna = server(leapfrog_enabled=leapfrog)
    client = Client(one.address)
    client.until("p", lambda said: "RPRT" not in said)
    lines = []
    sessions[0].on_wire(lambda entry: lines.append(entry.text) if entry.direction == ">" else None)
    client.ask("P 14 45")
    wait_for(lambda: any(line.startswith("a 0 14") for line in lines))
    threading.Event().wait(0.3)
    assert client.ask("P 20 45") == "RPRT 0\n"
    wait_for(lambda: any(sent in line for line in lines))


def test_a_station_that_fails_ends_serving_with_its_error(monkeypatch):
    antenna = BirdcageAntenna(get_protocol("g2"), AntennaConfig(port="sim:g2?seed=1"))
    one = RotctldServer(antenna, "127.0.0.1", 0)
    monkeypatch.setattr(Station, "begin", lambda self: 1 / 0)
    with pytest.raises(ZeroDivisionError):
        one.serve_forever()
