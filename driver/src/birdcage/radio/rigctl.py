"""A client of Hamlib's network protocol, as rigctld, SDR++, gqrx and SDRangel speak it.

Requests are plain: SDR++ takes `+f` apart into two commands. Answers are taken in the plain form (values only, or
`RPRT n`) and in the extended one (a header, values, `RPRT n` at the end), in case something in between adds it.
Frequencies go out as whole hertz: SDR++ does not survive a number that it cannot read.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from typing import Literal

from birdcage.base.reason import Reason
from birdcage.base.text import clean
from birdcage.radio.errors import RadioLost, RadioRefused
from birdcage.radio.wire import RadioWire

REPLY_S = 2.0
LONGEST = 4096
"""Bytes of an answer; whoever says more than that is no receiver."""
RPRT = re.compile(r"RPRT (-?\d{1,4})")
HEADER = re.compile(r"[a-z_]+:( .*)?")
"""How an extended answer begins: `get_freq:`, `set_freq: 137912500`."""


class RigctlClient:
    """One connection. After a RadioLost it is of no more use: close it and open another."""

    def __init__(self, wire: RadioWire, monotonic: Callable[[], float], *, reply_s: float = REPLY_S) -> None:
        self._wire, self._monotonic, self._reply_s = wire, monotonic, reply_s
        self._buffer = b""

    def tune(self, freq_hz: int) -> None:
        """Tune to `freq_hz`, above 0. RadioRefused, RadioLost."""
        if freq_hz <= 0:
            # Hamlib's dummy takes it, and a radio may do anything.
            raise ValueError(f"a receiver cannot be tuned to {freq_hz} Hz")
        self._ask(f"F {freq_hz}", wants_value=False)

    def frequency_hz(self) -> float:
        """Return what it is tuned to. RadioRefused, RadioLost."""
        return self._number("f")

    def strength_db(self) -> float:
        """Return `l STRENGTH`: dB over S9 of a real radio, over full scale of an SDR. RadioRefused, RadioLost."""
        return self._number("l STRENGTH")

    def modes(self) -> tuple[str, ...]:
        """Return what `M ?` lists: it asks and sets nothing. RadioRefused, RadioLost."""
        return tuple(self._ask("M ?", wants_value=True).split())

    def word(self, word: Literal["AOS", "LOS"]) -> None:
        """Say that a recording is to begin or to end. RadioRefused where it does not know these words, RadioLost.

        LOS is for whoever took AOS: Hamlib's own rigctld reads it as `L OS`, waits for a value, and takes the next
        command for it.
        """
        self._ask(word, wants_value=False)

    def close(self) -> None:
        """Hang up. `q` is left out: rigctld answers it with a line, SDR++ not at all."""
        self._wire.close()

    def _number(self, command: str) -> float:
        text = self._ask(command, wants_value=True)
        try:
            value = float(text)
        except ValueError:
            raise _garbage(command, text) from None
        if not math.isfinite(value):
            raise _garbage(command, text)
        return value

    def _ask(self, command: str, *, wants_value: bool) -> str:
        """Send `command`, return its value, or nothing where it has none."""
        self._forget_leftovers()
        self._wire.send(command.encode() + b"\n")
        until = self._monotonic() + self._reply_s
        extended, value = False, None
        while True:
            line = self._line(command, until)
            code = RPRT.fullmatch(line)
            if code is not None:
                if int(code[1]):
                    raise RadioRefused(command, int(code[1]))
                if value is not None or not wants_value:
                    return value or ""
                # The end of an answer to something before: what was asked for has yet to come.
            elif value is None and not extended and HEADER.fullmatch(line):
                extended = True
            elif not extended and not wants_value:
                raise _garbage(command, line)
            else:
                value = line.rpartition(": ")[2]
                if not extended:
                    return value

    def _forget_leftovers(self) -> None:
        seen = len(self._buffer)
        self._buffer = b""
        while seen <= LONGEST:
            data = self._wire.receive(0.0)
            if not data:
                return
            seen += len(data)
        raise RadioLost("It sends unasked: that is not rigctld.", reason=Reason.GARBAGE)

    def _line(self, command: str, until: float) -> str:
        """Return the next line that is not empty."""
        while True:
            line, end, rest = self._buffer.partition(b"\n")
            if end:
                self._buffer = rest
                if line.strip():
                    return clean(line.decode("utf-8", "replace")).strip()
                continue
            if len(self._buffer) > LONGEST:
                raise _garbage(command, self._buffer[:40].decode("utf-8", "replace"))
            left_s = until - self._monotonic()
            data = self._wire.receive(left_s) if left_s > 0.0 else b""
            if not data:
                told = f", only {self._buffer[:40].decode('utf-8', 'replace')!r}" if self._buffer else ""
                raise RadioLost(f"No answer to {command!r} within {self._reply_s:g} s{told}.", reason=Reason.SILENT)
            self._buffer += data


def _garbage(command: str, line: str) -> RadioLost:
    shown = "".join(each if each.isprintable() else "?" for each in line[:40])
    return RadioLost(f"It answers {command!r} with {shown!r}: that is not rigctld.", reason=Reason.GARBAGE)
