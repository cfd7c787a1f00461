"""Which dish stands behind a port: what is remembered of a dish is kept under this, not under a name like ttyUSB0.

    usb:0403:6001:A50285BI     an adapter with a serial number; `.1` follows for one of several interfaces
    path:/dev/ttyS0            any other device, all links followed; `path:COM4`
    pty:/dev/pts/4@1763…       a pseudo terminal and when it was made (ns): the next one of that name is another dish
    url:socket://rack:2217     a serial server

A simulated dish inside this program has none: what is known of it ends with the program.
"""

from __future__ import annotations

import hashlib
import re
import shutil
from pathlib import Path

from birdcage.link.opening import is_registered
from birdcage.link.ports import PortLister, find_port, list_ports

FOLDER = "dishes"
"""Where in the state folder each dish has a folder of its own."""

_PTY = re.compile(r"/dev/(pts/\d+|ttys\d+)")
"""Pseudo terminals of Linux and macOS."""


def dish_identity(port: str, list_ports: PortLister = list_ports) -> str | None:
    """Return the identity of the dish at `port` (a device, a link to one, a URL).

    None if nothing lasts beyond the program (`sim:g2`, `loop://`), where no port is given, and for a device that is
    not there: which adapter it would be is not known.
    """
    if not port:
        return None
    path = Path(port)
    here = path.exists()
    if not here and (is_registered(port) or port.lower().startswith("loop:")):
        return None
    if not here and "://" in port:
        return f"url:{port.lower()}"
    found = find_port(port, list_ports)
    if found is not None and found.vid_pid is not None and found.serial_number:
        interface = "" if found.interface is None else f".{found.interface}"
        return f"usb:{found.vid_pid}:{found.serial_number}{interface}"
    if not here:
        return None if found is None else f"path:{found.device}"
    real = str(path.resolve())
    if not _PTY.fullmatch(real):
        return f"path:{real}"
    try:
        return f"pty:{real}@{path.stat().st_ctime_ns}"
    except OSError:  # it went while it was looked at: not there
        return None


def made_at(port: str) -> str:
    """Return what tells one making of a device file by the system from the next: its number, and when; else ``.

    A device on USB gets a new file each time that it is plugged in or gets power.
    """
    try:
        found = Path(port).stat()
    except OSError:
        return ""
    return f"{found.st_ino} {found.st_ctime_ns}"


def forget_reused(state: Path, identity: str) -> None:
    """Remove what is remembered of earlier dishes at the same pseudo terminal: they ended with it."""
    if not identity.startswith("pty:"):
        return
    here = dish_folder(state, identity)
    alike = here.name.removesuffix(f"-{_sum(identity)}").rpartition("-")[0]
    for folder in here.parent.glob(f"{alike}-*"):
        if folder.name != here.name:
            shutil.rmtree(folder, ignore_errors=True)


def dish_folder(state: Path, identity: str) -> Path:
    """Return the folder, in the state folder, for what is remembered of a dish. Whoever writes into it makes it."""
    # The name is for people; what tells one dish from another is the sum.
    readable = re.sub(r"\W+", "-", identity).strip("-")[-40:]
    return state / FOLDER / f"{readable}-{_sum(identity)}"


def _sum(identity: str) -> str:
    return hashlib.sha256(identity.encode()).hexdigest()[:8]
