"""A simulated dish behind a pseudo-terminal. POSIX only: nothing else imports pty, termios or tty."""

from __future__ import annotations

import contextlib
import os
import pty
import tty
from pathlib import Path

from birdcage.sim.channel import LONGEST_BACKLOG


class PtyChannel:
    """A raw pty whose slave side is held open, so that programs may come and go.

    With `link`, a symbolic link of that name points at it while it is there; it survives re-plugging.
    """

    def __init__(self, link: Path | None = None) -> None:
        self.path = ""
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
            raise FileExistsError(f"{self._link} exists and is no symbolic link: choose another name for --link")
        fresh = self._link.with_name(f".{self._link.name}.{os.getpid()}")
        fresh.symlink_to(self.path)
        fresh.replace(self._link)
