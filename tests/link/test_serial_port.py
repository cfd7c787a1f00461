"""Real pseudo terminals under real pyserial."""

from __future__ import annotations

import errno
import os
import subprocess
import sys
import time
import tty

import pytest
from birdcage.base.clock import RealClock, WaitOutcome
from birdcage.base.errors import LinkError
from birdcage.link.opening import open_link


class Pty:
    def __init__(self):
        self.master, self._slave = os.openpty()
        tty.setraw(self._slave)
        self.path = os.ttyname(self._slave)
        self._open = True

    def close(self):
        if self._open:
            self._open = False
            os.close(self._slave)
            os.close(self.master)


@pytest.fixture
def pty():
    made = Pty()
    yield made
    made.close()


def read_within(link, clock, timeout_s=60.0):
    assert clock.wait(link, clock.monotonic() + timeout_s) is WaitOutcome.READY
    return link.read()


def test_bytes_pass_both_ways_without_waiting(pty):
    clock = RealClock()
    link = open_link(pty.path, baud=57600, clock=clock)
    assert link.name == pty.path
    assert link.demo is False
    assert link.next_event() is None
    assert link.fileno() is not None
    assert not link.pending()
    assert link.read() == b""
    link.write(b"a 0 180\r")
    assert os.read(pty.master, 100) == b"a 0 180\r"
    os.write(pty.master, b"\x00\xffTRK>")
    assert read_within(link, clock) == b"\x00\xffTRK>"
    link.close()
    link.close()


def test_a_link_to_the_device_opens_it(pty, tmp_path):
    name = tmp_path / "dish"
    name.symlink_to(pty.path)
    link = open_link(str(name), baud=57600, clock=RealClock())
    link.write(b"x")
    assert os.read(pty.master, 10) == b"x"
    link.close()


def test_a_second_open_is_refused_and_names_the_first(pty):
    holder = (
        "import sys, time\n"
        "from birdcage.base.clock import RealClock\n"
        "from birdcage.link.opening import open_link\n"
        "link = open_link(sys.argv[1], baud=57600, clock=RealClock())\n"
        "print('open', flush=True)\n"
        "time.sleep(30)\n"
    )
    other = subprocess.Popen([sys.executable, "-c", holder, pty.path], stdout=subprocess.PIPE)
    try:
        assert other.stdout.readline() == b"open\n"
        with pytest.raises(LinkError) as refused:
            open_link(pty.path, baud=57600, clock=RealClock())
        assert refused.value.reason == "busy"
        assert pty.path in str(refused.value)
        assert f"(process {other.pid})" in str(refused.value)
    finally:
        other.kill()
        other.wait()
        other.stdout.close()
    open_link(pty.path, baud=57600, clock=RealClock()).close()


def test_two_programs_use_it_one_after_the_other(pty):
    for _ in range(2):
        open_link(pty.path, baud=57600, clock=RealClock()).close()


def test_missing_names_the_ports_there_are(monkeypatch):
    monkeypatch.setattr("birdcage.link.trouble.list_ports", list)
    with pytest.raises(LinkError, match="no serial port is plugged in") as refused:
        open_link("/dev/ttyUSB99", baud=57600, clock=RealClock())
    assert refused.value.reason == "missing"


def test_no_permission_names_the_group(pty, monkeypatch):
    def forbid(*args):
        raise PermissionError(errno.EACCES, "Permission denied")

    monkeypatch.setattr("serial.serialposix.os.open", forbid)
    with pytest.raises(LinkError, match=r"usermod -aG|chmod") as refused:
        open_link(pty.path, baud=57600, clock=RealClock())
    assert refused.value.reason == "permission"


@pytest.mark.parametrize("make", ["mkdir", "touch"])
def test_a_folder_or_file_is_no_port(tmp_path, make):
    path = tmp_path / "thing"
    getattr(path, make)()
    with pytest.raises(LinkError, match="not a serial port") as refused:
        open_link(str(path), baud=57600, clock=RealClock())
    assert refused.value.reason == "unsupported"


def test_a_character_device_that_is_no_terminal(tmp_path):
    with pytest.raises(LinkError, match="not a serial port") as refused:
        open_link("/dev/null", baud=57600, clock=RealClock())
    assert refused.value.reason == "unsupported"


def test_a_vanished_port_is_noticed_at_once_by_read_write_and_discard(pty):
    clock = RealClock()
    link = open_link(pty.path, baud=57600, clock=clock)
    pty.close()
    started = time.monotonic()
    with pytest.raises(LinkError, match="is gone") as lost:
        read_within(link, clock)
    assert lost.value.reason == "lost"
    with pytest.raises(LinkError) as lost:
        link.write(b"x")
    assert lost.value.reason == "lost"
    with pytest.raises(LinkError) as lost:
        link.discard()
    assert lost.value.reason == "lost"
    link.close()
    assert time.monotonic() - started < 0.5


def test_a_port_that_takes_no_bytes_says_so_and_closes_quickly(pty):
    link = open_link(pty.path, baud=57600, clock=RealClock())
    started = time.monotonic()
    with pytest.raises(LinkError, match="takes no more bytes") as jammed:
        link.write(b"x" * 400_000)
    assert jammed.value.reason == "failed"
    link.close()
    assert time.monotonic() - started < 2.0


def test_the_last_bytes_before_close_arrive(pty):
    link = open_link(pty.path, baud=57600, clock=RealClock())
    link.write(b"a 0 181\r")
    link.close()
    assert os.read(pty.master, 100) == b"a 0 181\r"


def test_discard_throws_away_what_was_not_read(pty):
    clock = RealClock()
    link = open_link(pty.path, baud=57600, clock=clock)
    os.write(pty.master, b"old")
    assert clock.wait(link, clock.monotonic() + 2) is WaitOutcome.READY
    link.discard()
    assert link.read() == b""
    link.close()
