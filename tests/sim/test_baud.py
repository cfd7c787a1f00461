"""A program at another rate than the dish's."""

from __future__ import annotations

import sys

import pytest
from birdcage.base.clock import VirtualClock
from birdcage.sim.port import open_port


def heard_at(baud, options=""):
    clock = VirtualClock()
    port = open_port(f"g2?{options}", clock=clock, baud=baud)
    port.write(b"mot\r")
    clock.advance(1.0)
    return port.read()


def test_the_rate_of_the_dish_and_none_at_all():
    assert heard_at(115200) == heard_at(None) == b"mot\r\nMOT>"


@pytest.mark.parametrize("baud", [9600, 19200, 38400, 57600])
def test_silent_at_another(baud):
    assert heard_at(baud) == b""


def test_or_garbage_both_ways():
    heard = heard_at(57600, "wrong_baud=garbage")
    assert heard
    assert b"MOT>" not in heard


def test_the_rate_may_change_while_it_is_open():
    clock = VirtualClock()
    port = open_port("g2", clock=clock, baud=9600)
    port.write(b"mot\r")
    clock.advance(1.0)
    port.set_baud(115200)
    port.write(b"\r")
    clock.advance(1.0)
    assert port.read() == b"\r\nTRK>"  # `mot` never arrived


@pytest.mark.skipif(sys.platform == "win32", reason="no pseudo-terminals")
def test_the_rate_of_a_pty_is_what_its_client_sets():
    import os
    import termios

    from birdcage.sim.pty import PtyChannel

    channel = PtyChannel()
    channel.open()
    try:
        assert channel.baud() == 115200
        client = os.open(channel.path, os.O_RDWR | os.O_NOCTTY)
        modes = termios.tcgetattr(client)
        modes[4] = modes[5] = termios.B57600
        termios.tcsetattr(client, termios.TCSANOW, modes)
        assert channel.baud() == 57600
        os.close(client)
    finally:
        channel.close()
    assert channel.baud() is None
