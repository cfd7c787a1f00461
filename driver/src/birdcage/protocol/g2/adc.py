"""The analogue menu, `ADC>`: levels before the tuner, and which board it is (docs/reference/g2-commands.md, *ADC>*)."""

from __future__ import annotations

import re
from typing import ClassVar

from birdcage.console.events import Reply
from birdcage.protocol.trk.reading import END, garbage, only_whole, search
from birdcage.protocol.trk.room import Room

_RSSI = re.compile(rf"\bRSSI\s*[:=]?\s*(\d+){END}", re.IGNORECASE)
_BARE = re.compile(r"\s*(\d+)\s*")
_WORD = re.compile(r"(?:[\w ]+[:=]\s*)?(\w+)")
_STREAM_S = 3.0


class Adc(Room):
    """Raw counts. Its `scan` moves the dish and is not here; `parse_scan_point` reads its lines."""

    menu: ClassVar[str] = "adc"

    def board_id(self) -> str:
        """Read `bdid`: `STATIONARY` on a Carryout G2."""
        return _word(self._run("bdid"))

    def board_revision(self) -> str:
        """Read `bdrevid`: `A`."""
        return _word(self._run("bdrevid"))

    def rssi_counts(self) -> int:
        """Read the raw level once; an empty sky has shown 233 to 238."""
        reply = self._run("rssi")
        named = search(reply, _RSSI)
        return int(named[1]) if named else only_whole(reply)

    def monitor(self, samples: int = 5) -> tuple[int, ...]:
        """Read the raw level so often (`m`, a stream that overwrites its line); fewer when they come slowly."""
        return self._sample("m", _count, samples, _STREAM_S + samples)


def _count(line: str) -> int | None:
    match = _RSSI.search(line) or _BARE.fullmatch(line)
    return int(match[1]) if match else None


def _word(reply: Reply) -> str:
    if len(reply.lines) != 1 or (match := _WORD.fullmatch(reply.lines[0].strip())) is None:
        raise garbage(reply)
    return match[1]
