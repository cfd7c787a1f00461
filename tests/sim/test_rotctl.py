"""The simulated rotctld, walked by docs/reference/rotctl.md, and held against Hamlib's own."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest
from birdcage.base.clock import VirtualClock
from birdcage.sim.port import SimPort, open_device

sys.path.insert(0, str(Path(__file__).parents[1] / "rotctld"))
from hamlib_daemon import hamlib_daemon

STATE = (
    "1\n1\nmin_az=-180.000000\nmax_az=450.000000\nmin_el=0.000000\nmax_el=90.000000\n"
    "south_zero=0\nrot_type=AzEl\ndone\n"
)


class Server:
    """One of them, and what it says."""

    def __init__(self, options=""):
        self.clock = VirtualClock()
        self.device = open_device(f"rotctl?{options}", clock=self.clock)
        self.port = SimPort(self.device, "rotctl")

    def ask(self, said, seconds=0.5):
        self.port.write(said.encode())
        return self.wait(seconds)

    def wait(self, seconds):
        heard, end = b"", self.clock.monotonic() + seconds
        while self.clock.monotonic() < end:
            self.clock.advance(0.001)
            heard += self.port.read()
        return heard.decode()

    def pieces(self, said):
        self.port.write(said.encode())
        heard = []
        for _ in range(500):
            self.clock.advance(0.001)
            if piece := self.port.read():
                heard.append(piece)
        return heard


@pytest.fixture
def server():
    return Server()


@pytest.mark.parametrize(
    ("said", "told"),
    [
        ("p\n", "0.00\n0.00\n"), ("p\r\n", "0.00\n0.00\n"), ("\n\n", ""), ("# p\n", ""),
        ("p # c\np\n", "0.00\n0.00\n" * 2),
        ("+p\n", "get_pos:\nAzimuth: 0.00\nElevation: 0.00\nRPRT 0\n"),
        ("+\\get_pos\n", "get_pos:\nAzimuth: 0.00\nElevation: 0.00\nRPRT 0\n"),
        (";p\n", "get_pos:;Azimuth: 0.00;Elevation: 0.00;RPRT 0\n"),
        ("_\n", "Dummy rotator\n"), ("+_\n", "get_info:\nInfo: Dummy rotator\nRPRT 0\n"),
        ("S\n", "RPRT 0\n"), ("+S\n", "stop:\nRPRT 0\n"), ("K\n", "RPRT 0\n"), ("R 1\n", "RPRT 0\n"),
        ("P 900 20\n", "RPRT -1\n"), ("+P 900 20\n", "set_pos: 900 20\nRPRT -1\n"), ("P inf 0\n", "RPRT -1\n"),
        ("P nan 10\n", "RPRT 0\n"), ("|P 135 22.5\n", "set_pos: 135 22.5|RPRT 0\n"), ("P10 20\n", "RPRT 0\n"),
        ("P 11\n22\n", "RPRT 0\n"), ("P 10,5 20,5\n", "RPRT 0\n"), ("P 10.5,20.5\n", ""),
        ("P 1 2 P 3 4\n", "RPRT 0\n" * 2),
        ("M 8 100\n", "RPRT 0\n"), ("+M 8 100\n", "move: 8 100\nRPRT 0\n"), ("M 3 50\n", "RPRT -1\n"),
        ("M CW 50\n", "RPRT 0\n"), ("V SPEED 40\nv SPEED\n", "RPRT 0\n40\n"), ("v ?\n", "SPEED\n"),
        ("\\dump_state\n", STATE), ("w AZ\n", "RPRT -6\n"), ("q\n", ""), ("Z\n", ""), ("\\nothing\n", ""),
    ],
)  # fmt: skip
def test_what_it_answers(server, said, told):
    assert server.ask(said) == told


def test_unknown_bytes_are_tried_one_by_one(server):
    assert server.ask("zz p\n") == "0.00\n0.00\n"
    assert server.ask("GET / HTTP/1.1\n") == "", "its P waits for a second angle"
    assert server.ask("0\n") == "RPRT -1\n"


def test_it_turns_and_stops(server):
    server.ask("P 90 30\n", 2.0)
    assert server.device.truth().moving
    assert server.ask("s\n") == "MOVING MOVING_AZ MOVING_RIGHT MOVING_EL MOVING_UP \n"
    server.ask("S\n", 2.0)
    truth = server.device.truth()
    assert not truth.moving
    assert 5.0 < truth.az_deg < 30.0
    server.ask("M LEFT 100\n", 60.0)
    assert server.device.truth().cable_deg == pytest.approx(-180.0, abs=0.1)
    server.ask("K\n", 60.0)
    assert server.ask("p\n") == "0.00\n0.00\n"


def test_its_speed_is_that_of_its_level(server):
    server.ask("V SPEED 50\nP 60 0\n", 0.1)
    server.wait(10.0)
    assert server.device.truth().az_deg == pytest.approx(30.0, abs=1.5), "3 deg/s instead of 6"


@pytest.mark.parametrize(
    ("options", "said", "told"),
    [
        ("dump_state=bare", "\\dump_state\n", "0\n1\n-180.000000\n450.000000\n0.000000\n90.000000\n"),
        ("dump_state=error", "\\dump_state\n", "RPRT -4\n"), ("dump_state=silent", "\\dump_state\n", ""),
        ("stop=mute", "S\np\n", "0.00\n0.00\n"), ("stop=error", "S\n", "RPRT -4\n"),
        ("knows=pP", "_\nS\np\n", "0.00\n0.00\n"), ("code_space=1", "P 0 0\n", "RPRT 0 \n"),
        ("decimals=1", "p\n", "0.0\n0.0\n"), ("decimals=0", "p\n", "0\n0\n"),
        ("range_code=-21", "P 900 0\n", "RPRT -21\n"),
        ("lost=1", "p\nP 0 0\n", "RPRT -6\n" * 2), ("info=SPID", "_\n", "SPID\n"),
    ],
)  # fmt: skip
def test_servers_differ(options, said, told):
    assert Server(options).ask(said) == told


def test_a_reply_comes_in_one_piece_unless_it_is_split():
    assert Server().pieces("p\n") == [b"0.00\n0.00\n"]
    assert Server("split=1").pieces("p\n") == [b"0.00\n", b"0.00\n"]


def test_it_answers_as_hamlibs_own_does(server):
    with hamlib_daemon() as ask:
        for said in (
            "p\n", "p\r\n", "+p\n", "+\\get_pos\n", ";p\n", "|p\n", "p # c\np\n", "_\n", "+_\n", "S\n", "+S\n",
            "P 900 20\n", "+P 900 20\n", "P nan 10\n", "P inf 0\n", "M 3 50\n", "P 0 0\n", "|P 0 0\n", "P0 0\n",
            "P 0\n0\n", "V SPEED 50\n", "v SPEED\n", "R 1\n", "K\n", "w AZ\n", "\\dump_state\n",
            "+\\dump_state\n", "Z\n", "\\nothing\n", "s\n",
        ):  # fmt: skip
            assert (said, server.ask(said)) == (said, ask(said.encode()).decode())
