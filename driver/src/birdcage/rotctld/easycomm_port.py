"""A pseudo terminal for one program after the other, which take it for a serial port. POSIX only.

The program's side is held open here while no program has it, so that its first bytes find somebody, and let go then:
so the system tells when that program has closed it.
"""

from __future__ import annotations

import contextlib
import os
import pty
import termios
import tty
from pathlib import Path

from birdcage.base.errors import ConfigError

READ_BYTES = 1024
MOST_UNREAD = 4096
"""Bytes that wait for a program that does not read; older ones are lost, as on a serial line."""


class EasycommPort:
    """One at a time. All of it for one thread."""

    def __init__(self, link: Path | None = None) -> None:
        """Make it; with `link`, a symbolic link of that name points at it while it is there. ConfigError if not."""
        self._link = link
        self.path = ""
        self._master = self._slave = -1
        self._unread = bytearray()
        self._make()

    def fileno(self) -> int:
        """Return the descriptor to wait on."""
        return self._master

    @property
    def has_unread(self) -> bool:
        """Whether some of what was said did not go out yet."""
        return bool(self._unread)

    def read(self) -> bytes | None:
        """Return what came; None where the program has closed the port, and another may open it."""
        try:
            data = os.read(self._master, READ_BYTES)
        except BlockingIOError:
            return b""
        except OSError:  # as Linux says that all who had it open have closed it
            data = b""  # as macOS does
        if not data:
            self._hold()
            return None
        if self._slave >= 0:
            os.close(self._slave)
            self._slave = -1
        return data

    def write(self, data: bytes = b"") -> None:
        """Say it, and what was left of before, as far as there is room."""
        self._unread += data
        with contextlib.suppress(OSError):  # it does not read, or is gone: `read` tells
            del self._unread[: os.write(self._master, self._unread)]
        del self._unread[:-MOST_UNREAD]

    def close(self) -> None:
        """Take it away: a program that has it open sees a hang-up."""
        if self._link is not None and self._link.is_symlink() and str(self._link.readlink()) == self.path:
            self._link.unlink()
        self._let_go()

    def _let_go(self) -> None:
        for each in (self._slave, self._master):
            if each >= 0:
                os.close(each)
        self._master = self._slave = -1

    def _make(self) -> None:
        try:
            self._master, self._slave = pty.openpty()
            tty.setraw(self._slave)
            os.set_blocking(self._master, False)
            self.path = os.ttyname(self._slave)
        except OSError as error:
            self._let_go()
            raise ConfigError(
                f"No pseudo terminal can be made: {error.strerror or error}. Close terminals that you do not need."
            ) from error
        try:
            self._point()
        except OSError as error:
            self._let_go()
            raise ConfigError(
                f"{self._link} can't be made: {error.strerror or error}. Choose another --link."
            ) from error
        except ConfigError:
            self._let_go()
            raise

    def _hold(self) -> None:
        """Hold the program's side again. Answers that the last one has not read are dropped."""
        self._unread.clear()
        try:
            self._slave = os.open(self.path, os.O_RDWR | os.O_NOCTTY)
            tty.setraw(self._slave)
            termios.tcflush(self._slave, termios.TCIFLUSH)
        except OSError:  # it was left in exclusive use: another one takes its place
            self._let_go()
            self._make()

    def _point(self) -> None:
        if self._link is None:
            return
        if self._link.exists() and not self._link.is_symlink():
            raise ConfigError(f"{self._link} exists and is not a symbolic link. Choose another name for --link.")
        if self._link.is_symlink() and _kind(str(self._link.readlink())) != _kind(self.path):
            raise ConfigError(
                f"{self._link} points at {self._link.readlink()}, not at a pseudo terminal. Choose another name for "
                "--link."
            )
        fresh = self._link.with_name(f".{self._link.name}.{os.getpid()}")
        fresh.symlink_to(self.path)
        fresh.replace(self._link)


def _kind(path: str) -> str:
    """Return what the pseudo terminals of a system have in common in their paths."""
    return path.rstrip("0123456789")
