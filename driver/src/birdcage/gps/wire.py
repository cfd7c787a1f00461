"""Reading lines from a port until a deadline."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterator

from birdcage.base.clock import Clock, WaitOutcome
from birdcage.base.wake import Wake
from birdcage.link.link import Link

OpenLink = Callable[[str, int], Link]
"""Opens a port by its name at a baud rate. LinkError says what is wrong."""

LONGEST_LINE = 16_384
"""What goes on for longer without an end of line is noise; gpsd's longest report is shorter."""
NOISE = b"(noise)"
"""Stands for it; neither a sentence nor JSON."""


class Lines:
    """Cuts what comes into lines. Noise without an end of line is handed out as a line that says so."""

    def __init__(self, link: Link, clock: Clock, wake: Wake | None = None) -> None:
        self._link, self._clock, self._wake = link, clock, wake
        self._rest = b""
        self._whole: deque[bytes] = deque()

    def until(self, deadline: float) -> Iterator[bytes]:
        """Yield lines until a deadline (monotonic seconds), or until `wake` is set. LinkError when the port is gone.

        It can be left and called again: no line is lost in between.
        """
        while True:
            while self._whole:
                yield self._whole.popleft()
            # A stream that never pauses has to end as well.
            if self._clock.monotonic() >= deadline:
                return
            if self._clock.wait(self._link, deadline, self._wake) is not WaitOutcome.READY:
                return
            *whole, self._rest = (self._rest + self._link.read()).split(b"\n")
            self._whole.extend(line.strip() for line in whole)
            if len(self._rest) > LONGEST_LINE:
                self._rest = b""
                self._whole.append(NOISE)


def opener(clock: Clock) -> OpenLink:
    """Return what opens real ports."""
    from birdcage.link.opening import open_link

    return lambda url, baud: open_link(url, baud=baud, clock=clock)
