"""Cases: recorded conversations, played to the driver word by word."""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Sequence

from birdcage.base.clock import VirtualClock
from birdcage.link.link import Link
from birdcage.rotator import machines
from birdcage.rotator.hooks import Hooks
from birdcage.testing.stage import require
from birdcage.testing.twin import MachineBench


class ScriptedPort:
    """Expects exact bytes, and answers each with what the machine has printed; anything else fails the case."""

    name = "recorded"
    demo = True

    def __init__(self, clock: VirtualClock, exchanges: Sequence[tuple[bytes, bytes]]) -> None:
        self._clock, self.left, self._out = clock, deque(exchanges), bytearray()

    def fileno(self) -> int | None:
        """There is no descriptor."""
        return None

    def pending(self) -> bool:
        """Whether an answer is there."""
        return bool(self._out)

    def next_event(self) -> float | None:
        """Nothing comes by itself."""
        return self._clock.monotonic() if self._out else math.inf

    def read(self) -> bytes:
        """Return what was printed."""
        data = bytes(self._out)
        self._out.clear()
        return data

    def write(self, data: bytes) -> None:
        """Take what is sent."""
        require(self.left, f"nothing more was recorded, and {data!r} was sent")
        sent, printed = self.left.popleft()
        require(data == sent, f"{data!r} was sent, and {sent!r} is on record")
        self._out += printed

    def discard(self) -> None:
        """Throw away what was printed."""
        self._out.clear()

    def close(self) -> None:
        """Nothing is left to let go of."""


class GoldenTranscriptContract:
    """The wire byte for byte, from a record that no simulator has a part in."""

    def test_each_recorded_conversation(self, bench: MachineBench) -> None:
        """Every byte that is sent is on record, every recorded byte is sent, and the answers are understood."""
        for golden in bench.goldens:
            clock = VirtualClock()
            port, rotator = ScriptedPort(clock, golden.exchanges), machines.make(bench.machine)
            link = Link(port, clock)
            rotator.open(port.name, None, clock, Hooks(dial=lambda _address, _baud, link=link: link))  # type: ignore[misc]
            result = golden.act(rotator)
            require(result == golden.result, f"{golden.name}: {result!r} was made of it, and not {golden.result!r}")
            require(not port.left, f"{golden.name}: never sent: {[sent for sent, _ in port.left]}")
