r"""Which program a client seems to be, by how it talks: for people who look at a list of clients, and for nothing else.

    Hamlib      asks `\dump_state` first
    SatNOGS     is Hamlib, and asks `p` every three seconds
    Gpredict    `p` a tenth of a second after a `P`, and on target every 0.8 s
    SatDump     `P` as soon as `p` was answered, again and again
    SDRangel    writes angles with six significant digits, `P 123.457 45.6781`
    Look4Sat    wishes once a second, and never asks

The first four were seen on the wire; the last two are read in their sources.
"""

from __future__ import annotations

import re
from dataclasses import dataclass

from birdcage.station.network_state import NetworkProgram

WISH = re.compile(r"(?:P|\\?set_pos) *(\S+)\s+(\S+)")
SIX_DIGITS = re.compile(r"-?(?:\d{3}\.\d{3}|\d{2}\.\d{4}|\d\.\d{5})")
AT_ONCE_S = 0.06
"""A `P` that follows its `p` so soon was made from the answer."""
AFTER_WISH_S = (0.08, 0.3)
ON_TARGET_S = (0.7, 1.0)
SATNOGS_S = (2.5, 3.8)
"""How long after the command before these programs ask again."""


@dataclass(slots=True)
class _Counts:
    """How often each sign was seen."""

    asked: int = 0
    wished: int = 0
    at_once: int = 0
    after_wish: int = 0
    on_target: int = 0
    every_three_s: int = 0
    six_digits: int = 0


class ProgramGuess:
    """Hears the commands of one client."""

    def __init__(self) -> None:
        self.program = NetworkProgram.UNKNOWN
        self._counts = _Counts()
        self._dumped = False
        self._last, self._last_at = "", 0.0

    def hear(self, command: str, at: float) -> None:
        """Take in a command, and when it came, in monotonic seconds."""
        gap_s, before = at - self._last_at, self._last
        wish = None if command == "p" else WISH.fullmatch(command)
        kind = "P" if wish else command
        counts = self._counts
        if wish is not None:
            counts.wished += 1
            counts.at_once += before == "p" and gap_s < AT_ONCE_S
            counts.six_digits += any(SIX_DIGITS.fullmatch(each) is not None for each in wish.groups())
        elif kind == "p":
            counts.asked += 1
            counts.after_wish += before == "P" and AFTER_WISH_S[0] < gap_s < AFTER_WISH_S[1]
            counts.on_target += before == "p" and ON_TARGET_S[0] < gap_s < ON_TARGET_S[1]
            counts.every_three_s += before == "p" and SATNOGS_S[0] < gap_s < SATNOGS_S[1]
        self._dumped |= command == "\\dump_state"
        self._last, self._last_at = kind, at
        self.program = self._judge()

    def _judge(self) -> NetworkProgram:
        counts = self._counts
        if self._dumped:
            return NetworkProgram.SATNOGS if counts.every_three_s >= 2 else NetworkProgram.HAMLIB
        if counts.six_digits and counts.asked:
            return NetworkProgram.SDRANGEL
        if counts.at_once >= 2:
            return NetworkProgram.SATDUMP
        if counts.after_wish or counts.on_target >= 3:
            return NetworkProgram.GPREDICT
        if counts.wished >= 3 and not counts.asked:
            return NetworkProgram.LOOK4SAT
        return NetworkProgram.UNKNOWN
