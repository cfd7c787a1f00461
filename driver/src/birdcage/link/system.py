"""What this machine may hold against a serial port, and the command that mends it. Linux; elsewhere all is unknown.

Read from /proc, /sys and the user's groups: no program is run, no port is opened.
"""

from __future__ import annotations

import os
import stat
import sys as python
from collections.abc import Collection
from dataclasses import dataclass
from pathlib import Path

from birdcage.link.latency import SYS, latency_ms
from birdcage.link.trouble import PROC, other_program

SLOW_MS = 2
"""A latency timer above this is worth a word: it is on the way of each answer."""


@dataclass(frozen=True, slots=True)
class Hindrance:
    """One thing that stands in the way."""

    name: str
    """`group`, `login`, `busy`, `modemmanager`, `brltty`, `latency`."""
    what: str
    """A sentence: what it is, and what it does to the dish's line."""
    command: str
    """What to type in a shell to mend it; empty if that is no single command."""
    then: str = ""
    """What to do afterwards, as a sentence."""


@dataclass(frozen=True, slots=True)
class SystemFacts:
    """What was found. None is not known: another system, or no such device."""

    device: str
    group: str | None = None
    """The group that the device belongs to: `dialout`, `uucp`."""
    may_open: bool | None = None
    """Whether this login may read and write the device."""
    enrolled: bool | None = None
    """Whether the user is in the group, be it that this login does not know yet."""
    modem_manager: bool | None = None
    brltty: bool | None = None
    other_program: str | None = None
    """Another program that has the port open, as far as can be seen."""
    latency_ms: int | None = None
    """How long an FTDI adapter holds short answers back."""

    @property
    def hindrances(self) -> tuple[Hindrance, ...]:
        """What stands in the way, worst first."""
        found = [self._permission(), self._busy(), self._modem_manager(), self._brltty(), self._latency()]
        return tuple(each for each in found if each is not None)

    def _permission(self) -> Hindrance | None:
        if self.may_open is not False or self.group is None:
            return None
        if self.group == "root":
            return Hindrance(
                "group", f"{self.device} belongs to root alone.", f"sudo chmod a+rw {self.device}",
                "It lasts until the adapter is unplugged.",
            )  # fmt: skip
        if self.enrolled:
            return Hindrance(
                "login", f"You joined the group {self.group} after you logged in.",
                f"newgrp {self.group}", "Or log out and in again; then start birdcage anew.",
            )  # fmt: skip
        return Hindrance(
            "group", f"{self.device} belongs to the group {self.group}, and you are not a member.",
            f"sudo usermod -aG {self.group} $USER", "Then log out and in again.",
        )  # fmt: skip

    def _busy(self) -> Hindrance | None:
        if self.other_program is None:
            return None
        return Hindrance(
            "busy", f"{self.other_program} has {self.device} open: it takes bytes that are meant for birdcage.",
            "", "End that program.",
        )  # fmt: skip

    def _modem_manager(self) -> Hindrance | None:
        if not self.modem_manager:
            return None
        return Hindrance(
            "modemmanager", "ModemManager is running. It may open a new port and send it AT commands.",
            "sudo systemctl stop ModemManager", "It comes back at the next start; `disable` instead of `stop` lasts.",
        )  # fmt: skip

    def _brltty(self) -> Hindrance | None:
        if not self.brltty:
            return None
        return Hindrance(
            "brltty", "brltty, for Braille displays, is running: it takes some adapters (CH340, FTDI) for a display, "
            "and their port then vanishes.",
            "sudo apt remove brltty",
            "If you need it, mask its udev rule instead: sudo ln -s /dev/null /etc/udev/rules.d/85-brltty.rules. "
            "Then plug the adapter in again.",
        )  # fmt: skip

    def _latency(self) -> Hindrance | None:
        if self.latency_ms is None or self.latency_ms <= SLOW_MS:
            return None
        name = Path(self.device).resolve().name
        return Hindrance(
            "latency", f"The FTDI adapter holds each answer back for {self.latency_ms} ms. All works, only slower. "
            "birdcage sets 1 ms while it has the port.",
            f"echo 1 | sudo tee /sys/class/tty/{name}/device/latency_timer",
        )  # fmt: skip


def look_at_system(device: str, *, proc: Path = PROC, sys: Path = SYS) -> SystemFacts:
    """Look at what this machine may hold against `device` (a path or a URL). Some milliseconds; never raises.

    Nothing is known of an empty name.
    """
    if not device or not python.platform.startswith("linux"):
        return SystemFacts(device)
    running = _running(proc)
    group, may_open, enrolled = _permission(device)
    return SystemFacts(
        device,
        group=group,
        may_open=may_open,
        enrolled=enrolled,
        modem_manager=None if running is None else "ModemManager" in running,
        brltty=None if running is None else "brltty" in running,
        other_program=other_program(device, proc),
        latency_ms=latency_ms(device, sys),
    )


def _running(proc: Path) -> Collection[str] | None:
    """Return the names of all processes; None if they cannot be listed."""
    names = set()
    for file in proc.glob("[0-9]*/comm"):
        try:
            names.add(file.read_text(errors="replace").strip())
        except OSError:
            continue  # It has ended meanwhile.
    return names or None


def _permission(device: str) -> tuple[str | None, bool | None, bool | None]:
    """Return the device's group, whether this login may use it, and whether the user is in that group."""
    import grp
    import pwd

    try:
        found = Path(device).stat()
    except OSError:
        return None, None, None
    if stat.S_ISDIR(found.st_mode):
        return None, None, None  # no rights to a folder make it a port
    gid = found.st_gid
    may_open = os.access(device, os.R_OK | os.W_OK)
    try:
        group = grp.getgrgid(gid)
        user = pwd.getpwuid(os.getuid())
    except KeyError:  # no names for these numbers: a container, say
        return str(gid), may_open, None
    return group.gr_name, may_open, user.pw_name in group.gr_mem or user.pw_gid == gid
