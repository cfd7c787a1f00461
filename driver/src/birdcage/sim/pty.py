"""A simulated dish behind a pseudo-terminal. POSIX only: nothing else imports pty, termios or tty."""

from __future__ import annotations

import contextlib
import fcntl
import os
import pty
import termios
import tty
from pathlib import Path

from birdcage.sim.channel import LONGEST_BACKLOG

RATES = {
    getattr(termios, f"B{rate}"): rate
    for rate in (1200, 2400, 4800, 9600, 19200, 38400, 57600, 115200, 230400, 460800, 921600)
    if hasattr(termios, f"B{rate}")
}
TIOCGEXCL = 0x80045440
"""Asks Linux whether a terminal is in exclusive use; Python has no name for it."""
UNUSUAL_BAUD = 0
"""Stands for any rate that is not in the table: the dish does not share it."""


class PtyChannel:
    """A raw pty whose slave side is held open, so that programs may come and go.

    With `link`, a symbolic link of that name points at it while it is there; it survives re-plugging. It starts at
    `baud`, the dish's own.
    """

    def __init__(self, link: Path | None = None, baud: int = 115200) -> None:
        self.path = ""
        self._speed = getattr(termios, f"B{baud}")
        self._link = link
        self._master = -1
        self._slave = -1
        self._left = bytearray()

    def open(self) -> None:
        """Make a new pty.

        Raises:
            OSError: the link cannot be made; `FileExistsError` when its name belongs to something that is no link.

        """
        self._master, self._slave = pty.openpty()
        tty.setraw(self._slave)
        # A program that sets no rate (`cat`, a script) meets the dish at the dish's own.
        modes = termios.tcgetattr(self._slave)
        modes[4] = modes[5] = self._speed
        termios.tcsetattr(self._slave, termios.TCSANOW, modes)
        os.set_blocking(self._master, False)
        self.path = os.ttyname(self._slave)
        try:
            self._point()
        except OSError:
            self.close()
            raise

    def close(self) -> None:
        """Close both sides: a client sees a hang-up."""
        if self._master < 0:
            return
        if self._link is not None and self._link.is_symlink() and str(self._link.readlink()) == self.path:
            self._link.unlink()
        os.close(self._master)
        os.close(self._slave)
        self._master = self._slave = -1
        self._left.clear()

    def descriptors(self) -> list[int]:
        """Return the master."""
        return [self._master] if self._master >= 0 else []

    def backlog(self) -> list[int]:
        """Return the master while output is left over."""
        return [self._master] if self._left else []

    def receive(self, descriptor: int) -> bytes:
        """Return what a client wrote."""
        with contextlib.suppress(BlockingIOError):
            return os.read(descriptor, 4096)
        return b""

    def baud(self) -> int | None:
        """Return the rate that the last client has set."""
        return RATES.get(termios.tcgetattr(self._slave)[5], UNUSUAL_BAUD) if self._slave >= 0 else None

    def attend(self) -> bool:
        """End an exclusive use whose program is gone: as this side stays open, the kernel would keep it for ever.

        Who uses it holds the lock on it too, as birdcage does.
        """
        if self._slave < 0 or not self._is_exclusive():
            return False
        try:
            fcntl.flock(self._slave, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            return True  # it is in use
        fcntl.ioctl(self._slave, termios.TIOCNXCL)
        fcntl.flock(self._slave, fcntl.LOCK_UN)
        return False

    def _is_exclusive(self) -> bool:
        try:
            return any(fcntl.ioctl(self._slave, TIOCGEXCL, bytes(4)))
        except OSError:  # no such question on this system
            return False

    def send(self, data: bytes) -> None:
        """Write as much as fits and keep the rest."""
        self._left += data
        if self._master >= 0 and self._left:
            with contextlib.suppress(BlockingIOError):
                del self._left[: os.write(self._master, self._left)]
        del self._left[:-LONGEST_BACKLOG]

    def _point(self) -> None:
        if self._link is None:
            return
        if self._link.exists() and not self._link.is_symlink():
            raise FileExistsError(f"{self._link} exists and is not a symbolic link: choose another name for --link")
        fresh = self._link.with_name(f".{self._link.name}.{os.getpid()}")
        fresh.symlink_to(self.path)
        fresh.replace(self._link)
