"""A program in a terminal of its own: a real pty, the installed script, and what it shows. POSIX only."""

from __future__ import annotations

import fcntl
import os
import pty
import select
import signal
import struct
import subprocess
import sys
import termios
import threading
import time
from contextlib import suppress
from pathlib import Path

BIN = Path(sys.executable).parent
BOUND_S = 25.0
"""Longer than anything takes on a loaded machine: what is waited for is an event."""


class PtyTerminal:
    """Runs one of our scripts on a pty; a thread reads what it shows, as a terminal does."""

    def __init__(self, *words, env=None, stderr=None, ignored=(), columns=100, rows=30) -> None:
        self._master, slave = pty.openpty()
        fcntl.ioctl(slave, termios.TIOCSWINSZ, struct.pack("HHHH", rows, columns, 0, 0))
        self.before = termios.tcgetattr(slave)
        self._slave = slave
        self.output = b""
        self._changed = threading.Condition()
        self._closing = False

        def fresh() -> None:  # in the child: a test may run in the background of a shell, which has SIGINT ignored
            for name in ("SIGINT", "SIGTERM", "SIGHUP", "SIGQUIT"):
                number = getattr(signal, name)
                signal.signal(number, signal.SIG_IGN if name in ignored else signal.SIG_DFL)
            fcntl.ioctl(0, termios.TIOCSCTTY, 0)

        self.process = subprocess.Popen(
            [str(BIN / words[0]), *map(str, words[1:])], stdin=slave, stdout=slave,
            stderr=slave if stderr is None else stderr, start_new_session=True, preexec_fn=fresh,
            env={**os.environ, **(env or {})},
        )  # fmt: skip
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()

    def _read(self) -> None:
        while not self._closing:
            if not select.select([self._master], [], [], 0.05)[0]:
                continue
            try:
                data = os.read(self._master, 65536)
            except OSError:
                return
            with self._changed:
                self.output += data
                self._changed.notify_all()

    def wait_for(self, text: bytes, after: int = 0) -> int:
        """Wait until `text` is shown; return where it ends in the output."""
        end = time.monotonic() + BOUND_S
        with self._changed:
            while (at := self.output.find(text, after)) < 0:
                assert self.process.poll() is None, (self.process.returncode, self.output[-3000:])
                assert time.monotonic() < end, self.output[-3000:]
                self._changed.wait(0.1)
        return at + len(text)

    def press(self, keys: bytes) -> None:
        os.write(self._master, keys)

    @property
    def unread(self) -> int:
        """How many bytes that were pressed the program has not read yet."""
        return struct.unpack("i", fcntl.ioctl(self._slave, termios.FIONREAD, bytes(4)))[0]

    def signal(self, number: int) -> None:
        self.process.send_signal(number)

    def block(self) -> None:
        """Take no more output, as a terminal after Ctrl+S."""
        termios.tcflow(self._slave, termios.TCOOFF)

    def hang_up(self) -> None:
        """Close the terminal, as a person closes its window."""
        self._closing = True
        self._reader.join()
        os.close(self._slave)
        os.close(self._master)
        self._slave = self._master = -1

    def status(self) -> int:
        """Wait for the end of the program; return its exit status."""
        status = self.process.wait(BOUND_S)
        if self._master >= 0:
            time.sleep(0)  # the reader takes what is left
            while select.select([self._master], [], [], 0.2)[0] and self._reader.is_alive():
                with self._changed:
                    self._changed.wait(0.05)
        return status

    @property
    def text(self) -> str:
        return self.output.decode("utf-8", "replace")

    def attributes(self) -> list:
        """How the terminal is set now."""
        return termios.tcgetattr(self._slave)

    def close(self) -> None:
        if self.process.poll() is None:
            self.process.kill()
            self.process.wait()
        self._closing = True
        self._reader.join()
        for fd in (self._slave, self._master):
            if fd >= 0:
                with suppress(OSError):
                    os.close(fd)
