"""DiSEqC 2.x, in the tuner's menu (docs/reference/g2-signal.md, *DiSEqC*): LNB and switches on the coax."""

from __future__ import annotations

import re
from typing import ClassVar

from birdcage.coax.messages import LONGEST, read_message
from birdcage.protocol.trk.reading import END, START, find, only_whole, search
from birdcage.protocol.trk.room import Room

_HEX = re.compile(rf"{START}0x([0-9A-Fa-f]{{1,2}}){END}")
_MS = re.compile(rf"{START}(\d+)\s*ms{END}", re.IGNORECASE)
_REPLY = re.compile(r"\bRx:?\s+((?:[0-9A-Fa-f]{2}(?:\s+|$))+)")
_TIMEOUT = re.compile("RxReplyTimeout", re.IGNORECASE)
_BUS_S = 2.0
"""How long a message and its answer may take beside the time for replies; only a deadline depends on it."""


class Diseqc(Room):
    """Settings of the bus, questions to an LNB, and messages of one's own.

    What an LNB or switch answers is handed on as printed: no source documents its fields. None: nothing that speaks
    DiSEqC 2.x has answered (`RxReplyTimeout`).

    A message moves nothing but a switch, an LNB or a positioner on that coax.
    """

    menu: ClassVar[str] = "dvb"

    def address(self) -> str:
        """Read whom it talks to (`ovraddr`): `0x11` is the first LNB."""
        return find(self._run("ovraddr"), _HEX)[0]

    def pre_transmit_ms(self) -> int:
        """Read the silence before a message in ms (`pretx`: 15)."""
        return self._milliseconds("pretx")

    def reply_timeout_ms(self) -> int:
        """Read how long it waits for an answer in ms (`rrto`: 210)."""
        return self._milliseconds("rrto")

    def tone_threshold_counts(self) -> int:
        """Read from which level on 22 kHz counts as a tone (`tdthresh`: 110 counts, of 0.16 a millivolt)."""
        return only_whole(self._run("tdthresh"))

    def lnb_config(self) -> tuple[str, ...] | None:
        """Ask the LNB for its configuration (`di2conf`); it has shown `3 21180544 238 <4.5`."""
        return self._ask("di2conf")

    def lnb_identity(self) -> tuple[str, ...] | None:
        """Ask the LNB what it is (`di2id`)."""
        return self._ask("di2id")

    def lnb_status(self) -> tuple[str, ...] | None:
        """Ask the LNB for its status flags (`di2stat`)."""
        return self._ask("di2stat")

    def switch_status(self) -> tuple[str, ...] | None:
        """Ask for the state of the committed switch (`di2rcs`)."""
        return self._ask("di2rcs")

    def send(self, message: bytes) -> tuple[str, ...] | None:
        """Send 1 to 6 bytes: `E0 10 38 F4` chooses the second port of a switch. ValueError for more, or none.

        Polarisation or input may change.
        """
        if not 1 <= len(message) <= LONGEST:
            raise ValueError(f"a DiSEqC message has 1 to {LONGEST} bytes, not {len(message)}")
        return self._ask(f"send {message.hex(' ').upper()}")

    def _ask(self, line: str) -> tuple[str, ...] | None:
        reply = self._run(line, takes_s=_BUS_S)
        return None if search(reply, _TIMEOUT) else reply.lines

    def _milliseconds(self, line: str) -> int:
        reply = self._run(line)
        named = search(reply, _MS)
        return int(named[1]) if named else only_whole(reply)


def answer_in_words(message: bytes, printed: tuple[str, ...] | None) -> str:
    """Return how a message went, in a line: what was answered, or printed; `printed` is what `Diseqc.send` returns."""
    sent = f"{message.hex(' ').upper()} sent"
    if printed is None:
        return f"{sent}; no answer (RxReplyTimeout)"
    replies = (match[1] for line in printed if (match := _REPLY.search(line)))
    reply = next(replies, None)
    if reply is not None:
        return f"{sent}; {read_message(bytes.fromhex(reply), message)}"
    if printed:
        return f"{sent}; the dish printed: {' / '.join(printed)}"
    return f"{sent}; nothing was printed" if read_message(message).wants_reply else f"{sent}; no reply wanted"
