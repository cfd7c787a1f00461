"""What the machines behind a library share: no line of bytes; a call brings an answer, or an error."""

from __future__ import annotations

import threading

from birdcage.base.clock import WaitOutcome
from birdcage.base.errors import LinkError, NoReply
from birdcage.base.reason import Reason
from birdcage.rotator.plain import PlainLine, PlainRotator

CALL_S = 0.02
"""How long a call takes that is answered."""


class LibraryRotator(PlainRotator):
    """Finds its end of the library in `machines`, by address. ConnectionError there means gone, TimeoutError silent."""

    machines: dict[str, object] = {}  # noqa: RUF012 - each machine has its own

    def __init__(self):
        self.line, self._machine, self._clock = PlainLine(), None, None
        self._writing = threading.RLock()

    @property
    def is_open(self):
        return self._machine is not None

    @property
    def clock(self):
        if self._clock is None:
            raise LinkError(f"{self.facts.name} is not open.", reason=Reason.LOST)
        return self._clock

    def open(self, address, baud, clock, hooks):
        machine = self.machines.get(address)
        if machine is None or not machine.plugged:
            raise LinkError(f"There is no {self.facts.name} at {address}.", reason=Reason.MISSING)
        self._machine, self._clock, self._hooks = machine, clock, hooks
        self.line, self.is_simulated = PlainLine(hooks.delay_s), True

    def close(self, within_s):
        self._machine = self._clock = None

    def _gone(self):
        return LinkError(f"{self.facts.name} is gone.", reason=Reason.LOST)

    def _pause(self, until):
        while self.clock.wait(None, until, self._hooks.wake) is WaitOutcome.INTERRUPTED and self._hooks.on_wake:
            self._hooks.on_wake()

    def _call(self, function, *given, permit=None):
        clock = self.clock
        asked = clock.monotonic()
        try:
            with self._writing:
                if permit is not None:
                    permit()
                result = function(*given)
        except ConnectionError as gone:
            raise self._gone() from gone
        except TimeoutError as silence:
            self._pause(asked + self.line.delay_s)
            self.line.note_silence()
            raise NoReply(f"{self.facts.name} is silent.", reason=Reason.SILENT) from silence
        self._pause(asked + CALL_S)
        self.line.note(asked, clock.monotonic())
        return result

    def _stop_answers(self, within_s, answers):
        """Take the time that STOP takes, and return what `settle` does; `answers`: whether each of them came."""
        self._pause(self.clock.monotonic() + (CALL_S if all(answers) else within_s))
        if not all(answers):
            raise NoReply(f"{self.facts.name} did not answer STOP.", reason=Reason.SILENT)
        return (None,) * len(answers)

    def listen(self, until):
        if self.clock.wait(None, until, self._hooks.wake) is WaitOutcome.INTERRUPTED and self._hooks.on_wake:
            self._hooks.on_wake()
        if not self._machine.plugged:
            raise self._gone()
