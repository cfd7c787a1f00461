"""DTR and RTS as the kernel and pyserial move them: up at the first opening, and never down or up again."""

from __future__ import annotations

import os
import termios
import tty

import pytest
from birdcage.base.clock import RealClock
from birdcage.link.opening import open_link
from serial import serialposix

DTR, RTS = serialposix.TIOCM_DTR, serialposix.TIOCM_RTS


class Board:
    """A pty with the two lines that it lacks: opening raises them as Linux does, closing drops them if HUPCL is set."""

    def __init__(self, monkeypatch):
        self.master, self.slave = os.openpty()
        tty.setraw(self.slave)
        self.hang_up(termios.HUPCL)
        self.path = os.ttyname(self.slave)
        self.up, self.history = 0, []
        self._ours = set()
        self._patch(monkeypatch)

    def _patch(self, monkeypatch):
        real_open, real_close, real_ioctl = os.open, os.close, serialposix.fcntl.ioctl

        def opened(path, *args, **more):
            descriptor = real_open(path, *args, **more)
            if str(path) == self.path:
                self._ours.add(descriptor)
                self._set(DTR | RTS)
            return descriptor

        def closed(descriptor):
            if descriptor in self._ours:
                self._ours.discard(descriptor)
                if termios.tcgetattr(descriptor)[2] & termios.HUPCL:
                    self._set(0)
            real_close(descriptor)

        def ioctl(descriptor, request, argument=0, *rest):
            if descriptor in self._ours and request in (serialposix.TIOCMBIS, serialposix.TIOCMBIC):
                bits = int.from_bytes(argument, "little")
                self._set(self.up | bits if request == serialposix.TIOCMBIS else self.up & ~bits)
                return 0
            return real_ioctl(descriptor, request, argument, *rest)

        monkeypatch.setattr("serial.serialposix.os.open", opened)
        monkeypatch.setattr("serial.serialposix.os.close", closed)
        monkeypatch.setattr("serial.serialposix.fcntl.ioctl", ioctl)

    def _set(self, lines):
        if lines != self.up:
            self.up = lines
            self.history.append(lines)

    def hang_up(self, flag):
        settings = termios.tcgetattr(self.slave)
        settings[2] = settings[2] & ~termios.HUPCL | flag
        termios.tcsetattr(self.slave, termios.TCSANOW, settings)


@pytest.fixture
def board(monkeypatch):
    board = Board(monkeypatch)
    yield board
    os.close(board.master)
    os.close(board.slave)


def test_the_lines_rise_once_however_often_the_port_is_opened(board):
    for baud in (115200, 57600, 9600):
        link = open_link(board.path, baud=baud, clock=RealClock())
        link.write(b"\r")
        link.close()
    assert board.history == [DTR | RTS]


def test_the_stand_in_would_show_a_pulse(board):
    """The same without our care: pyserial as it comes drops both on closing, and lines said to be down fall."""
    for _ in range(2):
        serialposix.Serial(board.path, 9600).close()
    assert board.history == [DTR | RTS, 0, DTR | RTS, 0]
    port = serialposix.Serial(None, 9600)
    port.port, port.dtr = board.path, False
    board.history.clear()
    port.open()
    port.close()
    assert board.history == [DTR | RTS, RTS, 0]


def test_a_port_that_refuses_the_setting_opens_all_the_same(board, monkeypatch):
    real = termios.tcsetattr

    def refuse(descriptor, when, settings):
        if not settings[2] & termios.HUPCL:
            raise termios.error(5, "Input/output error")
        real(descriptor, when, settings)

    monkeypatch.setattr("termios.tcsetattr", refuse)
    link = open_link(board.path, baud=9600, clock=RealClock())
    link.write(b"\r")
    assert os.read(board.master, 10) == b"\r"
    link.close()
