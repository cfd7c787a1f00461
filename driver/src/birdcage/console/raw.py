"""A line that a person typed: sent once, its reply collected while the owner of the console goes on."""

from __future__ import annotations

from collections.abc import Callable

from birdcage.base.errors import NoReply
from birdcage.console.diagnosis import no_reply
from birdcage.console.events import Reply
from birdcage.console.learner import learn_standing
from birdcage.console.wire import Wire


class Typed:
    """One line under way. Somebody must keep listening (`Console.listen`), or the reply is never heard."""

    def __init__(self, wire: Wire, line: str, takes_s: float, permit: Callable[[], None] | None) -> None:
        """Send it, unless `permit` raises; its prompt is due in `takes_s` plus the delay of the wire."""
        self._wire, self.line = wire, line
        self._ticket = wire.send(line, takes_s, permit)
        self._reply: Reply | None = None
        self.sent = wire.clock.monotonic()
        self.due = self.sent + takes_s + wire.delay_s

    @property
    def heard_at(self) -> float:
        """When anything last arrived, in monotonic seconds; before `sent` when nothing did since."""
        return self._wire.last_received

    @property
    def reply(self) -> Reply | None:
        """The reply, when it has come."""
        if self._reply is None:
            # A line that a person typed may lead to a menu whose prompt is not known yet.
            learn_standing(self._wire, self._wire.delay_s)
            self._reply = self._wire.taken(self._ticket)
        return self._reply

    @property
    def is_over(self) -> bool:
        """Whether no reply is awaited any more. Takes in what is there, and does not wait."""
        self._wire.take_in(self._ticket)
        return self.reply is not None or not self._wire.codec.owes(self._ticket)

    def press_enter(self) -> None:
        """Send the key that ends what prints on: a bare line end, never a `q` (docs/reference/consoles.md, *Shell*)."""
        self._wire.press_enter()

    def wait(self, timeout_s: float) -> Reply | None:
        """Wait for the reply, listening; None when it did not come within a time."""
        wire = self._wire
        deadline = wire.clock.monotonic() + timeout_s
        while self.reply is None and wire.pump(deadline, self._ticket):
            pass
        if self.reply is None:
            wire.idle(self._ticket)
        return self.reply

    def give_up(self) -> NoReply:
        """Expect no reply any more, and return why there may be none."""
        wire = self._wire
        wire.forget(self._ticket)
        return no_reply(wire.link.name, self.line.strip(), bytes(wire.seen), wire.clock.monotonic() - self.sent)
