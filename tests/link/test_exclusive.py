"""Another program that opens our port without asking for a lock is refused by the kernel."""

from __future__ import annotations

import errno
import fcntl
import os
import subprocess
import sys
import tty

import pytest
from birdcage.base.clock import RealClock
from birdcage.link.opening import open_link

OPEN_AS_ANYBODY = """
import os, sys
if os.getuid() == 0:
    os.setuid(65534)  # the kernel lets root in
try:
    os.close(os.open(sys.argv[1], os.O_RDWR | os.O_NOCTTY))
except OSError as error:
    sys.exit(error.errno)
"""
TIOCGEXCL = 0x80045440


@pytest.fixture
def slave():
    master, slave = os.openpty()
    tty.setraw(slave)
    os.fchmod(slave, 0o666)
    yield slave
    os.close(master)
    os.close(slave)


def opened_by_anybody(slave):
    return subprocess.run([sys.executable, "-c", OPEN_AS_ANYBODY, os.ttyname(slave)], check=False).returncode


def is_exclusive(slave):
    return any(fcntl.ioctl(slave, TIOCGEXCL, bytes(4)))


def test_a_script_that_asks_for_no_lock_does_not_get_the_port(slave):
    assert opened_by_anybody(slave) == 0
    link = open_link(os.ttyname(slave), baud=57600, clock=RealClock())
    assert is_exclusive(slave)
    assert opened_by_anybody(slave) == errno.EBUSY
    link.close()
    assert not is_exclusive(slave), "a pseudo terminal lives on, and would let nobody in"
    assert opened_by_anybody(slave) == 0


def test_a_system_that_refuses_it_opens_the_port_all_the_same(slave, monkeypatch):
    def refuse(*_):
        raise OSError(errno.ENOTTY, "Inappropriate ioctl for device")

    monkeypatch.setattr("birdcage.link.exclusive.fcntl.ioctl", refuse)
    link = open_link(os.ttyname(slave), baud=57600, clock=RealClock())
    monkeypatch.undo()
    assert not is_exclusive(slave)
    link.close()
