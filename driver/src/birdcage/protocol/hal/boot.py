"""Waits for a Trav'ler that starts: its boot log, the line that ends it, and a shell that answers."""

from __future__ import annotations

import math
from collections.abc import Callable

from birdcage.base.errors import NoReply
from birdcage.base.reason import Reason
from birdcage.console.session import Console

_STILL_S = 10.0
"""A boot that prints nothing for so long is over, or prints nothing at all."""
_ASK_S = 30.0
"""How often a dish that prints on is asked all the same: its search may print too."""


class BootWatch:
    """Hears what the dish prints unasked."""

    def __init__(self, marks: tuple[str, ...]) -> None:
        self._marks = marks
        self._heard_at = -math.inf
        self._ended = False
        self.last = ""
        """The last line heard."""

    def hear(self, text: str, now: float) -> None:
        """Take in an unsolicited line."""
        self._heard_at, self.last = now, text.strip()
        if any(mark in text for mark in self._marks):
            self._ended = True

    def wait(
        self, console: Console, is_homed: Callable[[], bool], tell: Callable[[str], None], timeout_s: float
    ) -> None:
        """Return when the dish answers and its boot is over; `tell` hears how it goes.

        While the log streams little is asked. A dish with a GPS may end its boot with no known line
        (`docs/reference/travler.md`, *Start and search*), so an answer and a position count too. NoReply after
        `timeout_s`, or at once from a dish that is another firmware.
        """
        clock = console.clock
        began = clock.monotonic()
        self._ended = self._ended and self._streams(began)  # else it was another boot that ended
        told = ""
        while True:
            until = min(began + timeout_s, clock.monotonic() + _ASK_S)
            while not self._ended and self._streams(clock.monotonic()) and clock.monotonic() < until:
                if self.last != told:
                    told = self.last
                    tell(f"{clock.monotonic() - began:3.0f} s: {told}")
                console.listen(min(until, clock.monotonic() + 1.0))
            try:
                console.synchronize()
                if self._ended or not self._streams(clock.monotonic()) or is_homed():
                    return
                late = NoReply("The dish answers, but its boot does not end.", reason=Reason.BLOCKED)
            except NoReply as silence:
                late = silence
            elapsed = clock.monotonic() - began
            if elapsed >= timeout_s or late.reason == Reason.WRONG_FIRMWARE:
                raise late
            tell(f"{elapsed:3.0f} s: no prompt yet ({late.reason}). The dish may still be booting.")

    def _streams(self, now: float) -> bool:
        return now - self._heard_at < _STILL_S
