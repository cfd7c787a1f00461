"""Why a serial port did not open, and what to do: one sentence, one reason."""

from __future__ import annotations

import contextlib
import errno
import os
import re
from pathlib import Path

from birdcage.base.errors import LinkError
from birdcage.base.reason import Reason
from birdcage.base.text import clean
from birdcage.link.ports import list_ports

PROC = Path("/proc")

_MISSING = {errno.ENOENT, errno.ENODEV, errno.ENXIO, errno.ENOTDIR}
_BUSY = {errno.EAGAIN, errno.EWOULDBLOCK, errno.EBUSY}
_FORBIDDEN = {errno.EACCES, errno.EPERM}


def explain(url: str, baud: int, error: Exception, *, is_device: bool) -> LinkError:
    """Return the LinkError for what pyserial raised on opening `url`."""
    if isinstance(error, ValueError):
        return LinkError(f"{url} does not open at {baud} baud: {error}.", reason=Reason.UNSUPPORTED)
    if not is_device:
        return LinkError(
            f"{url}: no connection ({_short(error)}). Check the address, and that the serial server listens.",
            reason=Reason.MISSING if "refused" in str(error) else Reason.FAILED,
        )
    number = _number(error)
    if number in _MISSING:
        return LinkError(f"{url} does not exist: {_ports_there_are()}", reason=Reason.MISSING)
    if number in _BUSY:
        return LinkError(f"{url} is in use by {_holder(url)}: end that program first.", reason=Reason.BUSY)
    if number in _FORBIDDEN:
        return LinkError(f"No permission to open {url}: {_remedy(url)}", reason=Reason.PERMISSION)
    if number == errno.ENOTTY:
        return LinkError(f"{url} is not a serial port. `birdcage ports` lists them.", reason=Reason.UNSUPPORTED)
    return LinkError(
        f"{url} cannot be opened ({_short(error)}); unplug the adapter, plug it in again and retry.",
        reason=Reason.FAILED,
    )


def _number(error: Exception) -> int | None:
    """Return the system's error number; pyserial hides it in the text on Windows, and of termios everywhere."""
    number = getattr(error, "errno", None)
    if isinstance(number, int):
        return number
    text = str(error)
    if "FileNotFoundError" in text:
        return errno.ENOENT
    if "PermissionError" in text:
        return errno.EBUSY  # What Windows says of a port that another program has open.
    found = re.search(r"\((\d+),", text)
    return int(found.group(1)) if found else None


def _short(error: Exception) -> str:
    found = re.search(r"\[Errno -?\d+\] ([^:']+)|\(\d+, '([^']+)'\)", str(error))
    return (found.group(1) or found.group(2)) if found else str(error)


def _ports_there_are() -> str:
    ports = list_ports()
    if not ports:
        return "no serial port is plugged in. Check the adapter and its cable."
    return f"there {'is' if len(ports) == 1 else 'are'} {', '.join(port.device for port in ports)}."


def _remedy(url: str) -> str:
    try:
        import grp

        group = grp.getgrgid(Path(url).stat().st_gid).gr_name
    except (ImportError, KeyError, OSError):
        group = "dialout"
    if group == "root":
        return f"it belongs to root alone; `sudo chmod a+rw {url}` lends it to you until it is plugged in again."
    return f"it belongs to the group {group}; run `sudo usermod -aG {group} $USER`, then log out and in again."


def other_program(url: str, proc: Path = PROC) -> str | None:
    """Return which other program has this port open, `screen (process 4711)`; None if none can be seen.

    Only programs that this user may look into, and those that locked the port, can be seen; Linux only. A pseudo
    terminal is held open by whoever made it (a simulated dish): that takes no bytes away, so none is named.
    """
    if Path(url).resolve().is_relative_to("/dev/pts"):
        return None
    pid = _holder_pid(url, proc, but=os.getpid())
    return None if pid is None else _program(pid, proc)


def _holder(url: str) -> str:
    pid = _holder_pid(url, PROC)
    if pid is None:
        return "another program"
    return "this program itself" if pid == os.getpid() else _program(pid, PROC)


def _holder_pid(url: str, proc: Path, *, but: int | None = None) -> int | None:
    owner = _lock_owner(url, proc)
    return owner if owner not in (None, but) else _opener(url, proc, but)


def _program(pid: int, proc: Path) -> str:
    try:
        return f"{clean((proc / str(pid) / 'comm').read_text(errors='replace')).strip()} (process {pid})"
    except OSError:
        return f"process {pid}"


def _lock_owner(url: str, proc: Path) -> int | None:
    """Return who holds the exclusive lock, from /proc/locks: `1: FLOCK ADVISORY WRITE 4711 00:05:123 0 EOF`."""
    try:
        node = Path(url).stat()
        lines = (proc / "locks").read_text().splitlines()
    except OSError:
        return None
    wanted = (os.major(node.st_dev), os.minor(node.st_dev), node.st_ino)
    for line in lines:
        fields = line.split()
        if len(fields) < 6 or fields[1] != "FLOCK" or not fields[4].isdigit():
            continue
        major, minor, inode = fields[5].split(":")
        if (int(major, 16), int(minor, 16), int(inode)) == wanted and int(fields[4]) > 0:
            return int(fields[4])
    return None


def _opener(url: str, proc: Path, but: int | None) -> int | None:
    """Return a process that has the device open, as far as we may look."""
    device = str(Path(url).resolve())
    for folder in proc.glob("[0-9]*/fd"):
        if folder.parent.name == str(but):
            continue
        with contextlib.suppress(OSError):
            for descriptor in folder.iterdir():
                with contextlib.suppress(OSError):
                    if str(descriptor.readlink()) == device:
                        return int(folder.parent.name)
    return None
