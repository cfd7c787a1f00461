"""A port that plays one conversation: it expects exact bytes, and answers each line with what a dish printed."""

from __future__ import annotations

import math
from collections import deque

from birdcage.base.clock import VirtualClock


class ScriptedPort:
    """`steps` are (line with its CR, answer), or (line, seconds, answer); anything else written fails the test."""

    name = "scripted"
    demo = True

    def __init__(self, clock: VirtualClock, steps) -> None:
        self.clock = clock
        self.steps = deque(step if len(step) == 3 else (step[0], 0.0, step[1]) for step in steps)
        self.out: deque[tuple[float, bytes]] = deque()
        self.written = b""

    def fileno(self):
        return None

    def pending(self) -> bool:
        return bool(self.out) and self.out[0][0] <= self.clock.monotonic()

    def next_event(self) -> float:
        return self.out[0][0] if self.out else math.inf

    def read(self) -> bytes:
        data = b""
        while self.pending():
            data += self.out.popleft()[1]
        return data

    def write(self, data: bytes) -> None:
        self.written += data
        assert self.steps, f"nothing more was expected, and {data!r} came"
        line, seconds, answer = self.steps.popleft()
        assert data == line
        self.out.append((self.clock.monotonic() + seconds, answer))

    def discard(self) -> None:
        self.out.clear()

    def close(self) -> None:
        pass


def dialogue(text: str, line_end: str = "\r\n", *, echo: bool = True):
    """Read `TRK>mot` / `MOT>a` / `Angle[0] = 1.00` … as it stands in a terminal, as (sent, answered) pairs.

    The first line sent is a bare Enter, which the driver begins with; the last prompt stands alone.
    """
    steps, sent, answer = [], "", ""
    first = True
    for line in text.strip("\n").splitlines():
        prompt, mark, command = line.partition(">")
        if not mark or not prompt.isalnum() or not prompt.isupper():
            answer += line + line_end
            continue
        echoed = (sent if echo else "") + line_end
        steps.append((sent.encode() + b"\r", (echoed + answer + prompt + ">").encode()))
        assert sent or first
        first, sent, answer = False, command, ""
    assert not sent, "the last prompt stands alone"
    assert not answer
    return steps
