"""EasyComm II and III as a program on a serial port speaks them: bytes in, replies out. No port, no clock, no thread.

Who sends what, and what each version of Hamlib reads: `docs/network.md`, *Programs that know only a serial port*.
"""

from __future__ import annotations

import logging
import re
from collections.abc import Callable, Mapping
from contextlib import suppress
from enum import IntFlag

from birdcage.base.text import clean
from birdcage.base.version import version
from birdcage.rotctld.command_lines import CommandLines
from birdcage.rotctld.rotor import MoveDirection, Rotor
from birdcage.rotctld.rprt import RotctldError

LONGEST = 127
"""Bytes of a line, as the rotators take them that speak this."""
UNCHANGED = -1
_APART = re.compile(r"\b(AZ|EL)\s+(?=[-+.\d])", re.IGNORECASE)
"""Some write `AZ 45.0`."""
_AXIS = re.compile(r"(AZ|EL)([-+]?(?:\d{1,9}(?:[.,]\d{0,9})?|[.,]\d{1,9}))?")
_DRIVE = re.compile(r"(?:V([UDLR])(\d{1,9})|M([UDLR]))")
_STOPS = frozenset({"SA", "SE", "S", "STOP"})
_WAYS: Mapping[str, MoveDirection] = {
    "U": MoveDirection.UP, "D": MoveDirection.DOWN, "L": MoveDirection.LEFT, "R": MoveDirection.RIGHT,
}  # fmt: skip
log = logging.getLogger("birdcage.rotctld")


class EasycommError(IntFlag):
    """What `GE` tells: 1 alone is no error."""

    NONE = 1
    SENSOR = 2
    """Where it points can't be read now."""
    HOMING = 4
    """It does not know where it points: it is not homed, or not synced."""
    MOTOR = 8
    """A fault waits for a person."""


IDLE, MOVING, ERROR = 1, 2, 8
"""What `GS` tells."""


class EasycommConversation:
    """One program. Each line gets its answer, or none: what is not known is not answered, and says so to `GE`."""

    def __init__(self, rotor: Rotor, errors: Callable[[], EasycommError]) -> None:
        self._rotor, self._errors = rotor, errors
        self._lines = CommandLines(LONGEST)
        self._wish: dict[str, float] = {}
        """What it has asked for last, by axis: each may come in a line of its own."""

    def feed(self, data: bytes) -> list[bytes]:
        """Take what came, cut anywhere; return the replies. Never raises for anything that may come."""
        found = (self._answer(line) for line in self._lines.feed(data) if line is not None)
        return [reply for reply in found if reply]

    def _answer(self, line: bytes) -> bytes:
        """Do what a line says, and return its one reply; empty for none."""
        # Hamlib ends some commands by LF and a semicolon, which then stands before the next one.
        text = _APART.sub(r"\1", clean(line.decode("ascii", "replace")).replace(";", " "))
        tokens = text.upper().split()
        try:
            return "".join(f"{each}\n" for each in self._do(tokens)).encode("ascii")
        except RotctldError as error:
            log.debug("EasyComm %s: %s", text, error)
            return b""

    def _do(self, tokens: list[str]) -> list[str]:
        asked, wants, way, told = list[str](), dict[str, float](), MoveDirection(0), list[str]()
        for token in tokens:
            if (axis := _AXIS.fullmatch(token)) is not None:
                if axis[2] is None:
                    asked.append(axis[1])
                else:
                    wants[axis[1]] = float(axis[2].replace(",", "."))
            elif (drive := _DRIVE.fullmatch(token)) is not None and (drive[2] is None or int(drive[2])):
                way |= _WAYS[drive[1] or drive[3]]
            elif drive is not None or token in _STOPS:
                wants, way = {}, MoveDirection(0)  # what stands before it in the line must not outlast it
                self._stop()
            else:
                told += self._others(token)
        if wants:
            self._go(wants)
        if way:
            self._wish.clear()
            self._rotor.move(way, UNCHANGED)
        return [*self._position(asked), *told]

    def _others(self, token: str) -> list[str]:
        """Do a command without a number. Frequencies, modes, gains and `RESET` are left alone: nothing homes by it."""
        match token:
            case "PARK":
                self._wish.clear()
                self._rotor.park()
            case "VE":
                return [f"VEbirdcage-{version()}"]
            case "GS":
                return [f"GS{self._status()}"]
            case "GE":
                return [f"GE{int(self._errors() | EasycommError.NONE)}"]
        return []

    def _status(self) -> int:
        if self._errors() != EasycommError.NONE:
            return ERROR
        return MOVING if "MOVING" in self._rotor.status() else IDLE

    def _stop(self) -> None:
        self._wish.clear()
        with suppress(RotctldError):  # no link: it is told to whoever looks, and the rest of the line counts
            self._rotor.stop()

    def _go(self, wants: Mapping[str, float]) -> None:
        """Take a wish. An axis that is not named stays where it was sent last, or where it is."""
        wish = {**self._wish, **wants}
        if len(wish) < len(_AXES):
            wish = {**dict(zip(_AXES, self._rotor.position(), strict=True)), **wish}
        self._wish = wish
        self._rotor.set_position(wish["AZ"], wish["EL"])

    def _position(self, asked: list[str]) -> list[str]:
        if not asked:
            return []
        az_deg, el_deg = self._rotor.position()
        # Rounded first: 359.96 is 0.0, and no zero has a sign.
        shown = {"AZ": round(az_deg, 1) % 360.0 + 0.0, "EL": round(el_deg, 1) + 0.0}
        return [" ".join(f"{name}{shown[name]:.1f}" for name in _AXES if name in asked)]


_AXES = ("AZ", "EL")
