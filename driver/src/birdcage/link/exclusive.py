"""Keeps other programs off an open serial port, by the kernel (`TIOCEXCL`): a lock is only kept by who asks for it.

What it cannot keep out: root, on Linux; a program that had the port open before; whatever sits at the other end of a
network port; and anything on Windows, which needs none of this, as a port there opens once.
"""

from __future__ import annotations

import contextlib
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import serial

with contextlib.suppress(ImportError):
    import fcntl
    import termios


def shut_others_out(port: serial.Serial) -> str:
    """Let no further program open the port; return a remark for the transcript, empty if that cannot be done."""
    try:
        fcntl.ioctl(port.fileno(), termios.TIOCEXCL)
    except (NameError, OSError):
        return ""
    return "exclusive"


def let_others_in(descriptor: int) -> None:
    """Take that back, before the port is closed: a pseudo terminal may live on."""
    with contextlib.suppress(NameError, OSError):
        fcntl.ioctl(descriptor, termios.TIOCNXCL)
