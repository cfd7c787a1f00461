"""One console, one owner: asks, waits with a deadline, and knows which menu the dish is in by looking."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from contextlib import suppress
from typing import Unpack

from birdcage.base.clock import Clock
from birdcage.base.errors import CommandRefused, LinkError, NoReply
from birdcage.base.reason import Reason
from birdcage.console.diagnosis import no_reply
from birdcage.console.dialect import ConsoleDialect
from birdcage.console.events import LineSink, Reply
from birdcage.console.exchanges import Exchanges
from birdcage.console.late import LATE, MOST_LATE
from birdcage.console.learner import SETTLE_S
from birdcage.console.menus import Menus
from birdcage.console.raw import Typed
from birdcage.console.session_hooks import SessionHooks
from birdcage.console.wire import Wire
from birdcage.link.port import Port

DELAY_S = 2.0
"""The longest that a byte may be on its way, in each direction, unless somebody knows better."""


class Console:
    """A session with a text console. Synchronous; one thread, except for `interject`.

    Every method that talks raises `LinkError` when the port is gone and `NoReply` when the dish does not answer.
    """

    def __init__(self, link: Port, clock: Clock, dialect: ConsoleDialect, **hooks: Unpack[SessionHooks]) -> None:
        self.clock, self.dialect = clock, dialect
        self.delay_s = hooks.get("delay_s", DELAY_S)
        on_line = hooks.get("on_line")
        wake, on_wake, on_prompt = hooks.get("wake"), hooks.get("on_wake"), hooks.get("on_prompt")
        self._wire = Wire(link, clock, dialect, self.delay_s, wake, on_wake, on_line, on_prompt)
        self._exchanges = Exchanges(self._wire)
        self._menus = Menus(self._wire, self._exchanges, on_line)

    @property
    def place(self) -> str | None:
        """The menu that the last fresh prompt named; None when it is not known."""
        return self._wire.menu

    @property
    def prompt(self) -> str:
        """The prompt that last answered, as the dish shows it; empty before the first."""
        return self._wire.token

    @property
    def is_settled(self) -> bool:
        """See `Exchanges`."""
        return self._exchanges.is_settled

    @property
    def took_s(self) -> float:
        """See `Exchanges`."""
        return self._exchanges.took_s

    @property
    def answered(self) -> int:
        """See `Exchanges`."""
        return self._exchanges.answered

    @property
    def asked(self) -> int:
        """See `Exchanges`, as for the two below."""
        return self._exchanges.asked

    @property
    def unanswered(self) -> int:
        """Lines that were waited for in vain."""
        return self._exchanges.unanswered

    @property
    def late(self) -> int:
        """Lines of a stream whose answer came late, or not at all."""
        return self._exchanges.late_answers

    def hear_busy(self, on_busy: Callable[[], None]) -> None:
        """Have it told, once a line, that the dish is still busy with what came before it."""
        self._exchanges.on_busy = on_busy

    def hear_ends(self, on_end: Callable[[str], None], on_back: Callable[[str], None]) -> None:
        """Have it told, each time, that the dish is at its root, or in a menu that nothing is known to leave.

        `on_back`: where nothing was sent that leads there.
        """
        self._menus.on_end, self._wire.on_back = on_end, on_back

    def refusal(self, reply: Reply) -> CommandRefused | None:
        """Return what the firmware's error in `reply` means, or None when it holds none."""
        return self.dialect.refusal_in(reply)

    @property
    def owed(self) -> int:
        """How many lines still lack their prompt."""
        return self._wire.owed

    @property
    def last_reply(self) -> float | None:
        """When something that made sense last came, in monotonic seconds."""
        return self._wire.last_reply

    @property
    def round_trip_s(self) -> float | None:
        """How long the last short command took, from its first byte out to its prompt."""
        return self._exchanges.round_trip_s

    def unanswered_s(self) -> float:
        """Return for how long the oldest line has had no answer: 0 where none is due, infinite where one is missing.

        Any thread.
        """
        return self._wire.unanswered_s()

    @property
    def stray_bytes(self) -> int:
        """How many bytes came that no command asked for, or that could not be read."""
        return self._wire.stray_bytes

    def synchronize(self) -> str:
        """Find out which menu the dish is in, by a bare Enter, and return its name.

        NoReply reasons: `silent`, `garbage`, `echo` (only our own bytes came back), `blocked` (text, but no prompt).
        """
        return self._menus.synchronize()

    def exchange(
        self,
        command: str,
        *,
        takes_s: float = 0.0,
        busy_s: float = 0.0,
        on_line: LineSink | None = None,
        permit: Callable[[], None] | None = None,
        judged: bool = True,
    ) -> Reply:
        """Send `command` in the present menu and return its reply; else as `run`."""
        return self.run(
            None, command, takes_s=takes_s, busy_s=busy_s, on_line=on_line, permit=permit, judged=judged
        )  # fmt: skip

    def type_line(
        self, line: str, *, takes_s: float = 0.0, permit: Callable[[], None] | None = None, at_root: bool = False
    ) -> Typed:
        """Send a line that a person typed, as it is; the owner goes on, and collects the reply.

        A line that could leave a menu goes out from a proven submenu only, unless a person wants it `at_root` too.
        """
        self._check(line)
        if not self.dialect.leaving.search(line):
            self._menus.resume()
        elif self._menus.prove_submenu() in self.dialect.ends and not at_root:
            raise self._root_hazard(line)
        changes = self.dialect.learnt and self._menus.may_change(line)
        typed = Typed(self._wire, line, takes_s, permit)
        if changes:
            self._wire.menu = None
        return typed

    def find_menu(self) -> str:
        """Return the menu that the dish is in; asked by a bare Enter only when it is not known."""
        return self._menus.find()

    def run(
        self,
        menu: str | None,
        command: str,
        *,
        takes_s: float = 0.0,
        busy_s: float = 0.0,
        on_line: LineSink | None = None,
        permit: Callable[[], None] | None = None,
        judged: bool = True,
    ) -> Reply:
        """Send `command` in `menu`, going there first if need be, and return its reply. None: in the present menu.

        The prompt is due within `busy_s` + `takes_s` + `delay_s` in total, however much is printed: the dish may be
        busy so long with what came before. `on_line` hears each line of the reply as it comes. `permit` is called just
        before the line goes out and may raise to hold it back.
        Raises NoReply (the next exchange then begins by finding its feet; `busy` where it may still be at what came
        before), CommandRefused when the firmware says so, unless the caller judges the reply (`judged` False).
        """
        self._check(command)
        wire, leaves = self._wire, self.dialect.leaving.search(command)
        if menu is None:
            self._exchanges.collect()
        else:
            self.enter(menu)
        if leaves:
            if self._menus.prove_submenu() in self.dialect.ends:
                raise self._root_hazard(command)
        elif wire.lost or wire.menu is None:
            self._menus.resume()
        changes = self.dialect.learnt and self._menus.may_change(command)
        reply = self._exchanges.ask(command.strip(), takes_s, on_line, permit, busy_s)
        if changes:
            wire.menu = None
        refusal = self.dialect.refusal_in(reply) if judged else None
        if refusal is not None:
            raise refusal
        if menu is not None and reply.menu != menu and not leaves:
            raise self._from_elsewhere(menu, reply)
        return reply

    def hurry(
        self, menu: str, command: str, *, asks: bool = False, permit: Callable[[], None] | None = None,
        judged: bool = True,
    ) -> Reply:  # fmt: skip
        """Send one line of a stream, each of which makes the ones before it void; else as `run`.

        Its answer is waited for only a little longer than such answers take now. NoReply (`late`) when it did not come:
        the dish may have taken the line or not, and the next one may go out. A line that `asks` is not sent, and
        NoReply (`late`) raised at once, while an earlier answer that is still due could be taken for its own.
        Where the console does not echo, or its prompts are learnt, it is `run`. ValueError for what could leave a menu.
        """
        self._check(command)
        if self.dialect.leaving.search(command):
            raise ValueError(f"`{command}` could leave the menu and can't be hurried")
        if not self.dialect.echo or self.dialect.learnt:
            return self.run(menu, command, permit=permit, judged=judged)
        self._wire.take_in()
        self._exchanges.late.collect()
        if self._wire.lost or self.place != menu or self._exchanges.late.owed >= MOST_LATE:
            self.enter(menu)
        if asks and self._exchanges.late.lines:
            raise NoReply(f"`{command}` was not sent: an earlier answer is still due.", reason=LATE)
        reply = self._exchanges.ask_soon(command.strip(), permit)
        refusal = self.refusal(reply) if judged else None
        if refusal is not None:
            raise refusal
        if reply.menu != menu:
            raise self._from_elsewhere(menu, reply)
        return reply

    @staticmethod
    def _from_elsewhere(menu: str, reply: Reply) -> CommandRefused:
        return CommandRefused(
            f"`{reply.command}` was meant for menu `{menu}`, but the dish answered from `{reply.menu}`.",
            reason=Reason.WRONG_MENU,
        )

    def enter(self, menu: str) -> None:
        """Go to `menu`, by way of the one that it shares with where the dish is; nothing is sent when it is there."""
        self._exchanges.collect()
        if self._wire.lost or self._wire.menu != menu:
            self._menus.enter(menu)

    def leave(self) -> None:
        """Go back to the root menu, menu by menu, or as far as anything is known to lead there.

        Each `q` goes out only after a bare Enter has shown a submenu, with everything sent before accounted for.
        """
        self._menus.leave_until(tuple(self.dialect.ends))

    def leave_one(self) -> str:
        """Go back to the menu above the present one, as `leave`, and return where the dish is then."""
        return self._menus.leave_one()

    def clear_up(self) -> bool:
        """Account at once for whatever may be under way, where the console allows it; return `is_settled`.

        Without it a new session, or one after a fault, can leave its menu only after some seconds of quiet.
        """
        self._menus.resume()
        return self.is_settled or (self._exchanges.account_by_mark() and self.is_settled)

    def leave_all(self, within_s: float = 2.0) -> bool:
        """Go back as `leave` if that can be done safely within `within_s`; return whether that was done.

        For the moment before the port closes. A dish that stays in its menu is found there next time.
        """
        wire, dialect, place = self._wire, self.dialect, self.place or ""
        until = self.clock.monotonic() + within_s
        # Enter and `q` take a round trip each, or their gap: what is left unanswered would answer the next program's
        # first lines.
        way = dialect.way_out(place) if place in dialect.prompts else dialect.depth
        lines = ("", *("", dialect.leave) * max(way, 1))
        too_slow = wire.lasts_s(lines, self._exchanges.round_trip_s or 0.0) > within_s
        if too_slow or (not self.is_settled and wire.quiet_at(strictly=True) >= until):
            return False
        wire.limit = until
        try:
            self.leave()
        except (NoReply, CommandRefused, LinkError):
            return False
        finally:
            wire.limit = math.inf
        return True

    def mistrust(self) -> None:
        """Take nothing that comes for an answer before the line has been quiet: a reply was another line's."""
        self._wire.lost = True

    def interject(self, lines: Sequence[str]) -> None:
        """Write `lines` at once, from any thread, also in the middle of an exchange; `settle` collects the replies.

        For STOP. ValueError for a line that could leave a menu.
        """
        for line in lines:
            self._check(line)
            if self.dialect.leaving.search(line):
                raise ValueError(f"`{line}` could leave the menu and can't be interjected")
        self._wire.interject(lines)

    def settle(self, timeout_s: float) -> tuple[Reply, ...]:
        """Wait for the replies to all interjected lines and return them, refusals included; empty when none is due.

        NoReply when not all came within `timeout_s`.
        """
        wire = self._wire
        deadline = self.clock.monotonic() + timeout_s
        began = self.clock.monotonic()
        while True:
            waiting, _ = wire.interjected()
            # Bare Enters ask nothing: a dish that stands at a prompt has heard them, though it may have taken one of
            # them as the key that ends a motion.
            until = min(deadline, wire.last_received + SETTLE_S) if wire.codec.owes_only_keys else deadline
            if not waiting or not wire.pump(until):
                break
        wire.idle()
        _, replies = wire.interjected()
        if wire.close_interjected() > len(replies):
            wire.lost = True
            raise no_reply(wire.link.name, "STOP", bytes(wire.seen), self.clock.monotonic() - began)
        return replies

    def stream(self, command: str, on_line: LineSink, until: float) -> Reply:
        """Run a command that prints until a key comes; `on_line` hears its lines up to `until` (monotonic seconds).

        It is ended by a bare Enter, never by `q` (docs/reference/consoles.md, *Shell*), also when the wait is
        abandoned.
        """
        self._check(command)
        if self.dialect.leaving.search(command):
            raise ValueError(f"`{command}` could leave the menu and can't be streamed")
        self._menus.resume()
        wire = self._wire
        ticket = wire.send(command, max(0.0, until - self.clock.monotonic()))
        try:
            while (reply := wire.taken(ticket)) is None and wire.pump(until, ticket, on_line):
                pass
        except BaseException:
            wire.forget(ticket)
            with suppress(LinkError):  # the next exchange says that the port is gone
                wire.press_enter()
            raise
        if reply is None:
            wire.press_enter()
            reply = self._exchanges.wait_for(command, ticket, self.delay_s, on_line)
        refusal = self.refusal(reply)
        if refusal is not None:
            raise refusal
        return reply

    def relay(
        self, menu: str, command: str, on_line: LineSink, quiet_s: float, permit: Callable[[], None] | None = None
    ) -> Reply:
        """Run a command that prints at its own pace, and let `on_line` hear its lines, until it is over.

        However long that takes: NoReply only when nothing came for `quiet_s` and the delay, and nothing more is sent
        then. Else as `run`.
        """
        self._check(command)
        self.enter(menu)
        if self._wire.lost:
            self._menus.resume()
        reply = self._exchanges.relay(command.strip(), on_line, quiet_s, permit)
        if (refusal := self.refusal(reply)) is not None:
            raise refusal
        if reply.menu != menu:
            raise self._from_elsewhere(menu, reply)
        return reply

    def overhear(self, hear: Callable[[bytes], None]) -> None:
        """Have all bytes heard as they come, beside what is made of them here; on the owner's thread."""
        self._wire.on_bytes = hear

    def listen(self, until: float) -> bool:
        """Take in what comes unasked (it goes to the session's `on_line`); False when nothing did before `until`."""
        return self._wire.pump(until)

    def _root_hazard(self, line: str) -> CommandRefused:
        return CommandRefused(
            f"`{line}` was not sent: the dish is at {self._end()}, where a `{self.dialect.leave}` may end "
            "its shell until a power cycle.",
            reason=Reason.WRONG_MENU,
        )

    def _end(self) -> str:
        return f"menu `{self.place}`" if self.place in self.dialect.one_way else "its root menu"

    def _check(self, line: str) -> None:
        if not (line.isascii() and line.isprintable()):
            raise ValueError(f"a console line holds printable ASCII only, not {line!r}")
