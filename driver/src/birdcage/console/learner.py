"""Learns prompts that no source tells: what stands without a line end, twice the same (decision 0010)."""

from __future__ import annotations

from birdcage.console.diagnosis import looks_like_prompt, no_reply
from birdcage.console.events import LineSink, Reply
from birdcage.console.wire import Wire

SETTLE_S = 0.3
"""How long the line must be quiet for what stands there to count as a prompt. Too short only costs another look."""
_SHOWS = 4
"""How often Enter is pressed for the same prompt to show twice in a row."""


class Learner:
    """Sends lines after which an unknown prompt may stand, and learns it. The owner's thread only."""

    def __init__(self, wire: Wire, delay_s: float, on_line: LineSink | None) -> None:
        self._wire, self._delay_s, self._on_line = wire, delay_s, on_line

    def ask(self, line: str) -> Reply:
        """Send a line and return its reply, which a known prompt ends at once, and a new one when it showed twice.

        Nothing is waited for beyond `Wire.limit`. NoReply when no prompt came.
        """
        wire, began = self._wire, self._wire.clock.monotonic()
        tickets, shown = [wire.send(line)], [""]

        def hear(text: str) -> None:
            if not line and self._on_line is not None and text not in shown:
                self._on_line(text)

        try:
            while (stands := self._await(tickets, hear)) is not None:
                if stands and stands == shown[-1]:
                    wire.learn(stands)
                    wire.idle()
                    break
                if not stands or len(tickets) > _SHOWS:
                    raise no_reply(wire.link.name, line, bytes(wire.seen), wire.clock.monotonic() - began)
                shown.append(stands)
                tickets.append(wire.send(""))
            reply, *_ = [wire.taken(ticket) for ticket in tickets]
            if reply is None:
                raise no_reply(wire.link.name, line, bytes(wire.seen), wire.clock.monotonic() - began)
        finally:
            for ticket in tickets:
                wire.taken(ticket)
                wire.forget(ticket)
        lines = tuple(text for text in reply.lines if text not in shown)
        return Reply(reply.command, lines, reply.menu, reply.token, reply.ticket)

    def _await(self, tickets: list[int], hear: LineSink) -> str | None:
        """Wait until all is answered (None), or something that looks like a prompt stands; empty when nothing does."""
        wire, codec = self._wire, self._wire.codec
        deadline = min(wire.clock.monotonic() + self._delay_s, wire.limit)
        while any(wire.codec.owes(ticket) for ticket in tickets):
            # Nothing of what came before the last Enter counts: `seen` begins with it.
            stands = codec.unfinished if wire.seen and looks_like_prompt(codec.unfinished) else ""
            settled = max(wire.last_received, wire.last_sent) + SETTLE_S
            until = min(deadline, settled) if stands or codec.owes_only_keys else deadline
            if wire.clock.monotonic() >= until:
                wire.idle()
                return stands if any(wire.codec.owes(ticket) for ticket in tickets) else None
            wire.pump(until, tickets[0], hear)
        return None


def learn_standing(wire: Wire, quiet_s: float) -> None:
    """Know what stands as a prompt, when it looks like one and nothing came after it for a time."""
    standing = wire.codec.unfinished if wire.dialect.learnt else ""
    if looks_like_prompt(standing) and wire.clock.monotonic() >= wire.last_received + quiet_s:
        wire.learn(standing)
