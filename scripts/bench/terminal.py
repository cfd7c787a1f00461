"""A program in a terminal of its own, timed from outside. Shared by the benchmarks; POSIX only."""

from __future__ import annotations

import atexit
import fcntl
import math
import os
import pty
import select
import shutil
import signal
import struct
import sys
import tempfile
import termios
import time
from collections.abc import Callable, Sequence
from pathlib import Path

KEPT = 100_000
"""Bytes of output that are kept: more than two full frames."""
PLACE = '[place]\nname = "Bench"\nlatitude_deg = 47.0\nlongitude_deg = 8.0\n'


def settle(port: str) -> Path:
    """Give the programs that follow a settings folder of their own that knows this port: else the setup would open.

    Return it.
    """
    home = Path(tempfile.mkdtemp(prefix="birdcage-bench-"))
    atexit.register(shutil.rmtree, home, ignore_errors=True)
    home.joinpath("birdcage.toml").write_text(f'[dish]\nport = "{port}"\nfirmware = "g2"\n{PLACE}')
    os.environ["BIRDCAGE_HOME"] = str(home)
    return home


class Terminal:
    """Runs a command on a pseudo terminal of a given size, and keeps what it prints."""

    def __init__(self, command: Sequence[str], columns: int = 160, rows: int = 48) -> None:
        self.started = time.monotonic()
        self.pid, self.fd = pty.fork()
        if self.pid == 0:
            os.environ.update(TERM="xterm-256color", COLORTERM="truecolor", COLUMNS=str(columns), LINES=str(rows))
            os.execvp(command[0], list(command))
        fcntl.ioctl(self.fd, termios.TIOCSWINSZ, struct.pack("HHHH", rows, columns, 0, 0))
        self.output = b""
        self.ended = False

    def read(self, timeout_s: float) -> bytes:
        """Read what comes within `timeout_s`; empty when nothing did, or at the end."""
        try:
            if not select.select([self.fd], [], [], timeout_s)[0]:
                return b""
            data = os.read(self.fd, 65536)
        except OSError:
            return b""
        # The end is enough, and a growing buffer would be copied at every read, with all other threads waiting.
        self.output = (self.output + data)[-KEPT:]
        return data

    def wait_for(self, seen: Callable[[bytes], bool], timeout_s: float = 20.0) -> float:
        """Return the monotonic time at which `seen(output)` first held."""
        end = time.monotonic() + timeout_s
        while time.monotonic() < end:
            if self.read(0.05) and seen(self.output):
                return time.monotonic()
        sys.exit(f"not seen within {timeout_s} s; the end of the output: {self.output[-2000:]!r}")

    def watch(self, seconds: float) -> None:
        """Read on for a while, so that the program is never held up by a full terminal."""
        end = time.monotonic() + seconds
        while not self.ended and (left := end - time.monotonic()) > 0:
            self.read(min(left, 1.0))

    def press(self, keys: bytes) -> float:
        """Type; return the time just before the bytes went in."""
        now = time.monotonic()
        os.write(self.fd, keys)
        return now

    def wait_for_end(self, timeout_s: float = 10.0) -> float:
        """Return the time at which the program was gone."""
        end = time.monotonic() + timeout_s
        while time.monotonic() < end:
            pid, _status = os.waitpid(self.pid, os.WNOHANG)
            if pid:
                return time.monotonic()
            self.read(0.002)
        self.kill()
        sys.exit(f"still running after {timeout_s} s")

    def kill(self) -> None:
        """End the program for good."""
        self.ended = True
        try:
            os.kill(self.pid, signal.SIGKILL)
            os.waitpid(self.pid, 0)
        except (ProcessLookupError, ChildProcessError):
            pass
        os.close(self.fd)


def percentile(values: Sequence[float], share: float) -> float:
    """Return the value below which `share` of the values lie (nearest rank)."""
    ordered = sorted(values)
    return ordered[math.ceil(share * len(ordered)) - 1]
