"""Says to a server what Gpredict, SatNOGS and others say, and judges the answers as they would."""

from __future__ import annotations

import socket
import time
from collections.abc import Iterator
from dataclasses import dataclass
from enum import Enum

from birdcage.rotctld.recorded_session import Exchange, packaged_sessions

PATIENCE_S = 2.0
"""How long Hamlib's clients wait for a line (docs/reference/rotctld.md)."""
RECEIVED_AT_ONCE = 128
"""Bytes that Gpredict takes with one `recv`."""
SLOW_S = 0.5
"""Gpredict and SatNOGS go on with a slower answer, and follow worse."""


class AnswerReading(Enum):
    """How a program takes its answers."""

    LINES = "line by line"
    ONE_RECEIVE = "with one recv"
    NOT_AT_ALL = "not at all"


READS = {
    "hamlib": AnswerReading.LINES, "gpredict": AnswerReading.ONE_RECEIVE, "satnogs": AnswerReading.LINES,
    "satdump": AnswerReading.ONE_RECEIVE, "sdrangel": AnswerReading.LINES, "look4sat": AnswerReading.NOT_AT_ALL,
}  # fmt: skip
LABELS = {
    "hamlib": "Hamlib", "gpredict": "Gpredict", "satnogs": "SatNOGS", "satdump": "SatDump", "sdrangel": "SDRangel",
    "look4sat": "Look4Sat",
}  # fmt: skip


class SelfTestVerdict(Enum):
    """What became of one exchange."""

    GOOD = "good"
    SLOW = "slow"
    TORN = "torn"
    """In several pieces, for a program that takes the first for the whole."""
    WRONG = "wrong"
    SILENT = "silent"
    UNREACHED = "no connection"


@dataclass(frozen=True, slots=True)
class SelfTestResult:
    """One exchange: what was sent, what came, and how long that took."""

    program: str
    """As in `LABELS`."""
    sent: bytes
    came: bytes
    verdict: SelfTestVerdict
    took_s: float

    @property
    def good(self) -> bool:
        """Whether the program goes on with it."""
        return self.verdict is SelfTestVerdict.GOOD

    @property
    def code(self) -> int | None:
        """The code of an answer that is an error, None of any other: -6 of `RPRT -6`."""
        words = self.came.split()
        return int(words[1]) if len(words) == 2 and words[0] == b"RPRT" and words[1] != b"0" else None


def self_test(address: tuple[str, int], name: str) -> Iterator[SelfTestResult]:
    """Say the sessions of a program (`recorded_session.NAMES`) to a server; yield what came of each exchange.

    A session ends at the first exchange that is not good.
    """
    for session in packaged_sessions(name):
        began = time.monotonic()
        try:
            line = socket.create_connection(address, PATIENCE_S)
        except OSError:
            yield SelfTestResult(LABELS[name], b"", b"", SelfTestVerdict.UNREACHED, time.monotonic() - began)
            return
        with line:
            for exchange in session:
                result = _say(line, exchange, name)
                if exchange.answer:
                    yield result
                if not result.good:
                    break


def _say(line: socket.socket, exchange: Exchange, name: str) -> SelfTestResult:
    began, came, pieces = time.monotonic(), b"", 0
    try:
        line.sendall(exchange.sent)
        while not _is_whole(came, exchange) and (left := began + PATIENCE_S - time.monotonic()) > 0.0:
            line.settimeout(left)
            piece = line.recv(RECEIVED_AT_ONCE)
            if not piece:
                break
            came, pieces = came + piece, pieces + 1
    except OSError:
        pass  # what came until then is judged
    took_s = time.monotonic() - began
    torn = pieces > 1 and READS[name] is AnswerReading.ONE_RECEIVE
    verdict = SelfTestVerdict.GOOD
    if not exchange.fits(came):
        verdict = SelfTestVerdict.WRONG if came else SelfTestVerdict.SILENT
    elif torn:
        verdict = SelfTestVerdict.TORN
    elif took_s > SLOW_S and READS[name] is not AnswerReading.NOT_AT_ALL:
        verdict = SelfTestVerdict.SLOW
    return SelfTestResult(LABELS[name], exchange.sent, came, verdict, took_s)


def _is_whole(came: bytes, exchange: Exchange) -> bool:
    """Return whether no more is to come: as many lines as were recorded, or an error."""
    return came.count(b"\n") >= exchange.lines or (came.startswith(b"RPRT") and came.endswith(b"\n"))
