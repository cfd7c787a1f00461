"""A twin of a machine that is spoken to in lines: its end of the wire is here, its mechanics are its author's."""

from __future__ import annotations

import math
from abc import abstractmethod
from collections import deque

from birdcage.base.clock import VirtualClock
from birdcage.base.errors import LinkError
from birdcage.base.reason import Reason
from birdcage.link.link import Link
from birdcage.testing.twin import Twin


class LineTwin(Twin):
    """What is left to write are `hear`, `truth` and `taken`."""

    line_end = b"\n"
    """Ends the lines of both sides."""
    answer_end: bytes | None = None
    """Ends its answers, where that is not `line_end`: nothing (`b""`) on a console, whose prompt is their last word."""
    latency_s = 0.01
    """How long an answer is on its way."""

    def __init__(self, clock: VirtualClock) -> None:
        self.clock = clock
        self._heard, self._muted = 0, False
        self._line: _TwinLine | None = None
        self._plugged = True

    @abstractmethod
    def hear(self, line: str) -> str | None:
        """Do what a line says, which comes without its end, and return the answer; None for none."""

    def received(self) -> int:
        """Return how many lines were heard."""
        return self._heard

    def unplug(self) -> None:
        """Break the line; what comes of a new one, `dial` says."""
        self._plugged = False
        if self._line is not None:
            self._line.close()

    def plug(self) -> None:
        """Let a new line be opened."""
        self._plugged = True

    def mute(self) -> None:
        """Hear nothing, and lose what is not answered yet."""
        self._muted = True
        if self._line is not None:
            self._line.discard()

    def unmute(self) -> None:
        """Hear again what is sent from now on."""
        self._muted = False

    def dial(self, address: str, baud: int) -> Link:  # noqa: ARG002
        """Open a line; LinkError while it is unplugged."""
        if not self._plugged:
            raise LinkError(f"{address} is not plugged in.", reason=Reason.MISSING)
        self._line = _TwinLine(self, address)
        return Link(self._line, self.clock)

    def answer(self, line: str) -> str | None:
        """Count a line that has reached the machine, and hear it, unless it is muted."""
        if self._muted:
            return None
        self._heard += 1
        return self.hear(line)


class _TwinLine:
    """One line to it: a `Port`."""

    demo = True

    def __init__(self, twin: LineTwin, name: str) -> None:
        self._twin, self.name = twin, name
        self._coming = deque[tuple[float, bytes]]()
        self._begun, self._open = b"", True

    def fileno(self) -> None:
        """Nothing to select on."""

    def next_event(self) -> float:
        """Return when the next answer is there; at once where the line is gone."""
        if not self._open:
            return -math.inf
        return self._coming[0][0] if self._coming else math.inf

    def pending(self) -> bool:
        """Return whether an answer is there, or the line is gone."""
        return self.next_event() <= self._twin.clock.monotonic()

    def read(self) -> bytes:
        """Return the answers that are there."""
        self._check()
        data = b""
        while self._coming and self.pending():
            data += self._coming.popleft()[1]
        return data

    def write(self, data: bytes) -> None:
        """Have the machine hear each line that is whole."""
        self._check()
        twin = self._twin
        end = twin.line_end if twin.answer_end is None else twin.answer_end
        *lines, self._begun = (self._begun + data).split(twin.line_end)
        for line in lines:
            answer = twin.answer(line.decode("ascii"))
            if answer is not None:
                self._coming.append((twin.clock.monotonic() + twin.latency_s, answer.encode("ascii") + end))

    def discard(self) -> None:
        """Lose what is on its way."""
        self._coming.clear()
        self._begun = b""

    def close(self) -> None:
        """Break it."""
        self._open = False

    def _check(self) -> None:
        if not self._open:
            raise LinkError(f"{self.name} is gone.", reason=Reason.LOST)
