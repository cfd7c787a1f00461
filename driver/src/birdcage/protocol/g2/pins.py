"""The processor's pins, `GPIO>`, and the DIP switches, `DIPSWITCH>` (docs/reference/g2-commands.md)."""

from __future__ import annotations

import re
from typing import ClassVar

from birdcage.console.events import Reply
from birdcage.protocol.g2.pin_functions import PORTS, lines_of_port
from birdcage.protocol.trk.reading import END, START, find, garbage, only_whole, printed, search
from birdcage.protocol.trk.room import Room
from birdcage.rotator.feature import Value

_PIN = re.compile(r"[A-E]\d{1,2}")
_DIRECTION = re.compile(r"\b(INPUT|OUTPUT)\b")
_STATE = re.compile(rf"{START}([A-E]\d{{1,2}})\s*[:= ]\s*([01]){END}")
_UNKNOWN = re.compile(rf"Unknown bit\s+([A-E]\d{{1,2}}){END}", re.IGNORECASE)
_RAW = re.compile(rf"(?<!\w)val:\s*(?:0x)?([0-9A-Fa-f]{{8}}){END}")
_CODE = re.compile(rf"app_dipswitch:\s*(\d+){END}")
_REGS_S = 5.0
_ALL_UP = "ffffff01"
_SATELLITES = {101: "DISH at 110, 119 and 129° west"}
"""By the code that the firmware makes of the switches (docs/reference/g2-commands.md, *DIPSWITCH>*)."""


class Gpio(Room):
    """Reads pins. `w`, which drives one, is not here: it can destroy what hangs on it."""

    menu: ClassVar[str] = "gpio"

    def direction(self, pin: str) -> str | None:
        """Read which way a pin goes: `INPUT` or `OUTPUT`; None for one that the dish calls unknown.

        It says little of a pin that serves a peripheral.
        """
        reply = self._run(f"dir {_checked(pin)}")
        return None if search(reply, _UNKNOWN) else find(reply, _DIRECTION)[1]

    def read(self, pin: str) -> int | None:
        """Read a pin: 0 or 1; None for one that the dish calls unknown."""
        reply = self._run(f"r {_checked(pin)}")
        if search(reply, _UNKNOWN):
            return None
        named = search(reply, _STATE)
        if named is not None and named[1] != pin:
            raise garbage(reply)
        state = int(named[2]) if named else only_whole(reply)
        if state not in (0, 1):
            raise garbage(reply)
        return state

    def registers(self) -> dict[str, int | None]:
        """Read all pins (`regs`: 92, of ports A to E) by name; None for one that the dish calls unknown."""
        return _states(self._regs())

    def told(self) -> dict[str, Value]:
        """Read all pins, port by port, with what each is for (`pins.a` to `pins.e`), and as printed (`pins`)."""
        reply = self._regs()
        states = _states(reply)
        ports = (printed(f"pins.{port.lower()}", lines_of_port(port, states)) for port in PORTS)
        return {name: text for port in ports for name, text in port.items()} | printed("pins", reply.lines)

    def _regs(self) -> Reply:
        return self._run("regs", takes_s=_REGS_S)


class Dipswitches(Room):
    """The switches under the cover."""

    menu: ClassVar[str] = "dipswitch"

    def read(self) -> dict[str, Value]:
        """Read `dip_switches`, the pins as they stand, and `dip_code`, the satellites that the firmware makes of them.

        `dip_meaning` says in words what is known of both.
        """
        reply = self._run("dipswitch")
        raw, code = find(reply, _RAW)[1], int(find(reply, _CODE)[1])
        return {"dip_switches": f"0x{raw}", "dip_code": code, "dip_meaning": _meaning(raw, code)}


def _states(reply: Reply) -> dict[str, int | None]:
    text = "\n".join(reply.lines)
    states: dict[str, int | None] = {m[1]: int(m[2]) for m in _STATE.finditer(text)}
    states |= {m[1]: None for m in _UNKNOWN.finditer(text)}
    if not states:
        raise garbage(reply)
    return states


def _meaning(raw: str, code: int) -> str:
    """Return what pins and code of the DIP switches say, in a line."""
    pins = "all switches up (off)" if raw.lower() == _ALL_UP else f"pins 0x{raw}, and no source tells which is which"
    return f"{pins}; code {code}: {_SATELLITES.get(code, 'no source tells its satellites')}"


def _checked(pin: str) -> str:
    if not _PIN.fullmatch(pin):
        raise ValueError(f"a pin is called `B0` or `E12`, not {pin!r}")
    return pin
