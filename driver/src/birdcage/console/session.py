"""One console, one owner: asks, waits with a deadline, and knows which menu the dish is in by looking.

Why a `q` can't reach a root prompt is argued in `docs/decisions/0003-q-in-step.md`.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import suppress

from birdcage.base.clock import Clock
from birdcage.base.errors import CommandRefused, LinkError, NoReply
from birdcage.base.wake import Wake
from birdcage.console.diagnosis import no_reply
from birdcage.console.dialect import ConsoleDialect
from birdcage.console.events import Reply
from birdcage.console.raw import Typed
from birdcage.console.wire import LineSink, Wire
from birdcage.link.port import Port

_PROOFS = 3
"""How often a submenu is looked for before `leave` gives up."""


class Console:
    """A session with a text console. Synchronous; one thread, except for `interject`.

    `delay_s` (D) is the longest that a byte may be on its way, in each direction; every answer has that long beyond
    what its command takes. `wake` ends waits early and then calls `on_wake`, which must clear it, and may raise to
    abandon the exchange. `on_line` hears lines that no command asked for (boot texts).

    Every method that talks raises `LinkError` when the port is gone and `NoReply` when the dish does not answer.
    """

    def __init__(
        self,
        link: Port,
        clock: Clock,
        dialect: ConsoleDialect,
        *,
        delay_s: float = 2.0,
        wake: Wake | None = None,
        on_wake: Callable[[], None] | None = None,
        on_line: LineSink | None = None,
    ) -> None:
        self.clock = clock
        self.dialect = dialect
        self.delay_s = delay_s
        self._on_line = on_line
        self._wire = Wire(link, clock, dialect, delay_s, wake, on_wake, on_line)
        self._new = True
        self._limit: float | None = None
        self._round_trip_s: float | None = None

    @property
    def menu(self) -> str | None:
        """The menu that the last fresh prompt named; None when it is not known."""
        return self._wire.menu

    @property
    def owed(self) -> int:
        """How many lines still lack their prompt."""
        return self._wire.owed

    @property
    def in_step(self) -> bool:
        """Whether all that was sent is accounted for and nothing came unasked since the last proof."""
        wire = self._wire
        return not wire.lost and wire.doubt_until is None and not wire.owed and wire.menu is not None

    @property
    def last_reply(self) -> float | None:
        """When something that made sense last came, in monotonic seconds."""
        return self._wire.last_reply

    @property
    def round_trip_s(self) -> float | None:
        """How long the last short command took, from its first byte out to its prompt."""
        return self._round_trip_s

    @property
    def stray_bytes(self) -> int:
        """How many bytes came that no command asked for, or that could not be read."""
        return self._wire.stray_bytes

    def synchronize(self) -> str:
        """Find out which menu the dish is in, by a bare Enter, and return its name.

        NoReply reasons: `silent`, `garbage`, `echo` (only our own bytes came back), `blocked` (text, but no prompt).
        """
        self._wire.take_in()
        if self._wire.lost:
            return self._resynchronize()
        return self._probe()

    def exchange(
        self,
        command: str,
        *,
        takes_s: float = 0.0,
        on_line: LineSink | None = None,
        permit: Callable[[], None] | None = None,
    ) -> Reply:
        """Send `command` in the present menu and return its reply.

        The prompt is due within `takes_s` + `delay_s` in total, however much is printed. `on_line` hears each line
        of the reply as it comes. `permit` is called just before the line goes out and may raise to hold it back.
        Raises NoReply (the next exchange then begins by finding its feet), CommandRefused when the firmware says so.
        """
        self._check(command)
        if self._wire.is_hazard(command):
            if self._prove_submenu() == self.dialect.root:
                raise self._root_hazard(command)
        else:
            self._resume()
        reply = self._transact(command.strip(), takes_s, on_line, permit)
        refusal = self.refusal(reply)
        if refusal is not None:
            raise refusal
        return reply

    def type_line(
        self, line: str, *, takes_s: float = 0.0, permit: Callable[[], None] | None = None, at_root: bool = False
    ) -> Typed:
        """Send a line that a person typed, as it is; the owner goes on, and collects the reply.

        A line that could leave a menu goes out from a proven submenu only, unless a person wants it `at_root` too.
        """
        self._check(line)
        if not self._wire.is_hazard(line):
            self._resume()
        elif self._prove_submenu() == self.dialect.root and not at_root:
            raise self._root_hazard(line)
        return Typed(self._wire, line, takes_s, permit)

    def find_menu(self) -> str:
        """Return the menu that the dish is in; asked by a bare Enter only when it is not known."""
        self._resume()
        assert self.menu is not None, "a prompt named it"
        return self.menu

    def refusal(self, reply: Reply) -> CommandRefused | None:
        """Return what the firmware's error in `reply` means, or None when it holds none."""
        for line in reply.lines:
            for pattern, reason in self.dialect.refusals:
                if pattern.search(line):
                    return CommandRefused(
                        f"The dish refused `{reply.command}` in menu `{reply.menu}`: {line.strip()}", reason=reason
                    )
        return None

    def run(
        self,
        menu: str,
        command: str,
        *,
        takes_s: float = 0.0,
        on_line: LineSink | None = None,
        permit: Callable[[], None] | None = None,
    ) -> Reply:
        """Send `command` in `menu`, going there first if need be; see `exchange`."""
        self.enter(menu)
        reply = self.exchange(command, takes_s=takes_s, on_line=on_line, permit=permit)
        if reply.menu != menu and not self._wire.is_hazard(command):
            raise CommandRefused(
                f"`{command}` was meant for menu `{menu}`, but the dish answered from `{reply.menu}`.",
                reason="wrong_menu",
            )
        return reply

    def enter(self, menu: str) -> None:
        """Go to `menu`, by way of the root when the dish is in another; nothing is sent when it is there already."""
        if menu not in self.dialect.prompts:
            raise CommandRefused(f"This firmware has no menu `{menu}`.", reason="wrong_menu")
        self._resume()
        if self.menu == menu:
            return
        if self.menu != self.dialect.root:
            self.leave()
        if menu == self.dialect.root:
            return
        reply = self.exchange(menu)
        if reply.menu != menu:
            raise CommandRefused(f"The dish did not go to menu `{menu}`; it is in `{reply.menu}`.", reason="wrong_menu")

    def leave(self) -> None:
        """Go back to the root menu; nothing happens when the dish is there.

        `q` goes out only after a bare Enter has shown a submenu, with everything sent before accounted for.
        """
        self._resume()
        if self.menu == self.dialect.root or self._prove_submenu() == self.dialect.root:
            return
        before = self._wire.doubt_until
        reply = self._transact(self.dialect.leave)
        if reply.menu != self.dialect.root:
            self._wire.lost = True
            raise NoReply(
                f"The dish answered `{self.dialect.leave}` but stayed in menu `{reply.menu}`.", reason="blocked"
            )
        self._wire.trust_root(before)

    def leave_all(self, within_s: float = 2.0) -> bool:
        """Go back to the root if that can be done safely within `within_s`; return whether the dish is there.

        For the moment before the port closes. A dish that stays in its menu is found there next time.
        """
        wire = self._wire
        self._limit = self.clock.monotonic() + within_s
        if not self.in_step and wire.quiet_at(strictly=True) >= self._limit:
            self._limit = None
            return False
        try:
            self.leave()
        except (NoReply, CommandRefused, LinkError):
            return False
        finally:
            self._limit = None
        return True

    def interject(self, lines: Sequence[str]) -> None:
        """Write `lines` at once, from any thread, also in the middle of an exchange; `settle` collects the replies.

        For STOP. ValueError for a line that could leave a menu.
        """
        for line in lines:
            self._check(line)
            if self._wire.is_hazard(line):
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
            if not waiting or not wire.pump(deadline):
                break
        wire.idle()
        _, replies = wire.interjected()
        if wire.close_interjected() > len(replies):
            wire.lost = True
            raise no_reply(wire.link.name, "STOP", bytes(wire.seen), self.clock.monotonic() - began)
        return replies

    def stream(self, command: str, on_line: LineSink, until: float) -> Reply:
        """Run a command that prints until a key comes; `on_line` hears its lines up to `until` (monotonic seconds).

        It is ended by a bare Enter, never by `q` (reference section 7.8), also when the wait is abandoned.
        """
        self._check(command)
        if self._wire.is_hazard(command):
            raise ValueError(f"`{command}` could leave the menu and can't be streamed")
        self._resume()
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
            reply = self._await(command, ticket, self.delay_s, on_line)
        refusal = self.refusal(reply)
        if refusal is not None:
            raise refusal
        return reply

    def listen(self, until: float) -> bool:
        """Take in what comes unasked (it goes to the session's `on_line`); False when nothing did before `until`."""
        return self._wire.pump(until)

    # How it is done: nothing below is called from outside.

    def _root_hazard(self, line: str) -> CommandRefused:
        return CommandRefused(
            f"`{line}` was not sent: the dish is at its root menu, where a `{self.dialect.leave}` may end "
            "its shell until a power cycle.",
            reason="wrong_menu",
        )

    def _check(self, line: str) -> None:
        if not (line.isascii() and line.isprintable()):
            raise ValueError(f"a console line holds printable ASCII only, not {line!r}")

    def _resume(self) -> None:
        """Make sure that nothing is missing, so that a reply can be told from an older one."""
        self._wire.take_in()
        if self._wire.lost or self.menu is None:
            self._resynchronize()

    def _resynchronize(self) -> str:
        if self._new:
            # Nothing of ours is under way yet: look at once. A `q` waits until `doubt_until` all the same.
            self._new = False
        elif not self._quiet(strictly=False):
            # It talks on: perhaps a stream, which any key ends.
            self._wire.press_enter()
            self._quiet(strictly=False)
        return self._probe()

    def _quiet(self, *, strictly: bool) -> bool:
        """Wait until all that was sent has had its time, both ways, and D passed without a byte.

        Not `strictly`, a prompt that came late counts as the end of what kept the dish busy. False when it never
        fell quiet.
        """
        wire, delay = self._wire, self.delay_s
        give_up = max(wire.quiet_at(strictly=strictly), self.clock.monotonic()) + 4 * delay
        if self._limit is not None:
            give_up = min(give_up, self._limit)
        while True:
            goal = wire.quiet_at(strictly=strictly)
            now = self.clock.monotonic()
            if now >= goal:
                wire.forget_all()
                return True
            if now >= give_up:
                return False
            wire.pump(min(goal, give_up))

    def _probe(self) -> str:
        """Send a bare Enter and return the menu that the next prompt names. Lines before it are nobody's: boot text."""
        return self._transact("", on_line=self._on_line).menu

    def _prove_submenu(self) -> str:
        """Return the menu that a fresh prompt names, with nothing unaccounted for under way, either way."""
        root = self.dialect.root
        self._resume()
        for _ in range(_PROOFS):
            before = self.menu
            if not self.in_step and not self._quiet(strictly=True):
                break
            now = self._probe()
            if now == root or (now == before and self.in_step):
                return now
        raise NoReply(
            f"The line to the dish does not fall quiet, so `{self.dialect.leave}` was not sent: it could reach the "
            "root menu. Check the cable; a power cycle brings the dish back to its root menu.",
            reason="garbage",
        )

    def _transact(
        self,
        line: str,
        takes_s: float = 0.0,
        on_line: LineSink | None = None,
        permit: Callable[[], None] | None = None,
    ) -> Reply:
        sent = self.clock.monotonic()
        ticket = self._wire.send(line, takes_s, permit)
        reply = self._await(line, ticket, takes_s + self.delay_s, on_line)
        if not takes_s:
            self._round_trip_s = self.clock.monotonic() - sent
        return reply

    def _await(self, line: str, ticket: int, timeout_s: float, on_line: LineSink | None) -> Reply:
        wire = self._wire
        deadline = self.clock.monotonic() + timeout_s
        if self._limit is not None:
            deadline = min(deadline, self._limit)
        try:
            while (reply := wire.taken(ticket)) is None and wire.pump(deadline, ticket, on_line):
                pass
            if reply is None:
                wire.idle(ticket, on_line)
                reply = wire.taken(ticket)
        except BaseException:
            wire.forget(ticket)
            raise
        if reply is None:
            wire.forget(ticket)
            raise no_reply(wire.link.name, line, bytes(wire.seen), timeout_s)
        return reply
