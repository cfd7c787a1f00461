"""How the stand-in dish's text becomes bytes on the wire, and when they arrive."""

from __future__ import annotations

import math
import random
import re
from collections import deque

from .habits import LOG_LINES, Habits

BYTE_S = 10 / 115200
NUMBER = re.compile(r"-?\d+(?:\.\d+)?")


class Voice:
    """Says things, one byte after the other."""

    def __init__(self, habits: Habits, rng: random.Random) -> None:
        self._habits, self._rng = habits, rng
        self._outbox: deque[tuple[float, bytes]] = deque()
        self._spoken: deque[tuple[float, float]] = deque(maxlen=200)
        self._ends = 0.0
        self._new = bytearray()

    def say(self, now: float, text: str, *, plain: bool = False) -> None:
        """Say text; each newline as this dish writes it. `plain`: as an echo, without colours or chatter."""
        if not plain and self._rng.random() < self._habits.chatter_in_reply:
            lines = text.splitlines(keepends=True)
            lines.insert(self._rng.randint(0, len(lines)), f"{self._rng.choice(LOG_LINES)}\n")
            text = "".join(lines)
        if self._habits.colour and not plain:
            text = NUMBER.sub("\x1b[1;33m\\g<0>\x1b[0m", text)
        self.put(now, text.replace("\n", self._habits.eol).encode("latin-1"))

    def prompt(self, now: float, text: str) -> None:
        """Print a prompt: nothing follows it."""
        coloured = f"\x1b[2K\r\x1b[32m{text}\x1b[0m" if self._habits.colour else text
        self.put(now, coloured.encode())

    def put(self, now: float, data: bytes) -> None:
        """Put bytes on the wire."""
        self._new += data
        kept = bytes(byte for byte in data if self._rng.random() >= self._habits.loss) if self._habits.loss else data
        while kept:
            size = self._rng.randint(1, 5) if self._habits.pieces else len(kept)
            begins = max(now + self._habits.wire_s, self._ends)
            if self._habits.pieces:
                begins += self._rng.uniform(0.0, 0.01)
            self._ends = begins + min(size, len(kept)) * BYTE_S
            self._spoken.append((begins, self._ends))
            self._outbox.append((self._ends, kept[:size]))
            kept = kept[size:]

    def speaks(self, at: float) -> bool:
        """Return whether bytes of its own are on the wire then."""
        return any(begins <= at <= ends for begins, ends in self._spoken)

    def next_event(self) -> float:
        """Return when the next bytes arrive."""
        return self._outbox[0][0] if self._outbox else math.inf

    def take(self, now: float) -> bytes:
        """Return what has arrived."""
        data = b""
        while self._outbox and self._outbox[0][0] <= now:
            data += self._outbox.popleft()[1]
        return data

    def new(self) -> bytes:
        """Return what was put on the wire since the last call."""
        data, self._new = bytes(self._new), bytearray()
        return data
