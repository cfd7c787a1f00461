"""DiSEqC 2.x in `DVB>`: the bus that the tuner drives on the LNB's cable (docs/reference/g2-signal.md, *DiSEqC*).

Figures, `3 21180544 238 <4.5` and `RxReplyTimeout` with no switch are noted; the lines around them are assumed, as
is all that a switch (setting `switch_port`) answers. Its port stands in bits 2 and 3, as on the bus
(docs/reference/diseqc.md, *Switches*).
"""

from __future__ import annotations

import re

from birdcage.sim.g2.eeprom import whole
from birdcage.sim.g2.menu import G2Menu
from birdcage.sim.shell import Pause, Script
from birdcage.sim.trk.menu import Command

RAW_CONFIG = "3 21180544 238 <4.5"
TIMED_OUT = "RxReplyTimeout"
LONGEST = 6
"""Bytes of a packet."""
PORTS = 4
BYTE_S = 0.0135
"""A byte on the bus: eight bits and parity of 1.5 ms."""
COMMITTED = 0x38
"""`E0 10 38 Fx` writes the committed switch."""
WANTS_REPLY = frozenset({0xE2, 0xE3})
ACKNOWLEDGED = "E4"


class DiseqcCommands:
    """Settings of the bus, questions and packets."""

    def __init__(self, menu: G2Menu) -> None:
        self._menu = menu
        self._board = menu.board
        self.commands: dict[str, Command] = {
            "di2conf": self._config,
            "di2cs": self._choose,
            "di2id": self._ask("LNB Hardware ID: 0x41"),
            "di2rcs": self._committed,
            "di2sc": self._ask("Short circuit: 0"),
            "di2stat": self._ask("LNB Status: 0x00"),
            "ovraddr": self._override,
            "pretx": self._figure("pretx", "Pre-Tx delay: {} ms", 1000),
            "rrto": self._figure("rrto", "Rx reply timeout: {} ms", 10_000),
            "send": self._send,
            "tdthresh": self._figure("tdthresh", "Tone detect threshold: {} (0.16 counts/mV)", 1023),
        }
        self.restore()
        menu.board.at_power_on.append(self.restore)

    def restore(self) -> None:
        """Put the bus back to the factory's."""
        self._address = 0x11
        self._figures = {"pretx": 15, "rrto": 210, "tdthresh": 110}

    def _figure(self, name: str, line: str, highest: int) -> Command:
        def run(args: list[str]) -> Script:
            value = whole(args[0]) if len(args) == 1 else self._figures[name] if not args else None
            if value is None or not 0 <= value <= highest:
                yield from self._menu.bad_parameter()
                return
            self._figures[name] = value
            yield line.format(value) + "\n"

        return run

    def _override(self, args: list[str]) -> Script:
        value = _byte(args[0].lower().removeprefix("0x")) if len(args) == 1 else self._address if not args else None
        if value is None:
            yield from self._menu.bad_parameter()
            return
        self._address = value
        yield f"Override address: 0x{value:02X}\n"

    def _ask(self, answer: str) -> Command:
        def run(args: list[str]) -> Script:  # noqa: ARG001
            yield from self._exchange(3, answer)

        return run

    def _exchange(self, length: int, answer: str) -> Script:
        """Put a packet on the bus and wait for what comes: nothing without a switch."""
        yield Pause(self._figures["pretx"] / 1000.0 + length * BYTE_S)
        if self._board.tuner.switch_port:
            yield Pause(2 * BYTE_S)
            yield f"{answer}\n"
        else:
            yield Pause(self._figures["rrto"] / 1000.0)
            yield f"{TIMED_OUT}\n"

    def _config(self, args: list[str]) -> Script:
        if self._board.tuner.switch_port or self._board.settings.di2conf == "raw":
            yield f"{RAW_CONFIG}\n"
        else:
            yield from self._ask("")(args)

    def _committed(self, args: list[str]) -> Script:  # noqa: ARG002
        yield from self._exchange(3, self._stands())

    def _stands(self) -> str:
        """Return how the committed switch stands."""
        return f"Committed switch: 0xF{max(self._board.tuner.switch_port - 1, 0) << 2:X}"

    def _choose(self, args: list[str]) -> Script:
        port = whole(args[0]) if len(args) == 1 else None
        if (port is None or not 1 <= port <= PORTS) if args else self._board.settings.di2cs_bare == "parameter":
            yield from self._menu.bad_parameter()
        else:
            self._switch_to(port)
            yield from self._exchange(4, self._stands())

    def _switch_to(self, port: int | None) -> None:
        if port is not None and self._board.tuner.switch_port:
            self._board.tuner.switch_port = port

    def _send(self, args: list[str]) -> Script:
        packet = [_byte(text) for text in args]
        sent = [byte for byte in packet if byte is not None]
        if not 1 <= len(packet) <= LONGEST or len(sent) != len(packet):
            yield from self._menu.bad_parameter()
            return
        yield "Tx: " + " ".join(f"{byte:02X}" for byte in sent) + "\n"
        if len(sent) == 4 and sent[2] == COMMITTED:
            self._switch_to(self._port_by(sent[3]))
        if sent[0] in WANTS_REPLY:
            yield from self._exchange(len(sent), f"Rx: {ACKNOWLEDGED}")
        else:
            yield Pause(self._figures["pretx"] / 1000.0 + len(sent) * BYTE_S)

    def _port_by(self, byte: int) -> int:
        """Return the port that a byte makes of the present one: bits 2 and 3 set a flag, bits 6 and 7 clear it."""
        port = self._board.tuner.switch_port - 1
        for bit, weight in ((2, 1), (3, 2)):
            if byte >> bit & 1:
                port |= weight
            elif byte >> bit + 4 & 1:
                port &= ~weight
        return port + 1


def _byte(text: str) -> int | None:
    return int(text, 16) if re.fullmatch("[0-9A-Fa-f]{1,2}", text) else None
