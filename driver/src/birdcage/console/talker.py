"""How a session finds its feet: what is missing, how quiet the line is, which menu a fresh prompt shows."""

from __future__ import annotations

from collections.abc import Callable

from birdcage.base.clock import Clock
from birdcage.base.errors import CommandRefused, NoReply
from birdcage.base.reason import Reason
from birdcage.base.wake import Wake
from birdcage.console.diagnosis import no_reply, stranger
from birdcage.console.dialect import ConsoleDialect
from birdcage.console.events import LineSink, Reply
from birdcage.console.late import LATE, LateLines
from birdcage.console.learner import Learner
from birdcage.console.places import SUBMENU, MenuPlaces
from birdcage.console.wire import Wire
from birdcage.link.port import Port

HELP = "?"
"""Lists the commands of a menu, on all of these consoles, and does nothing else (docs/reference/consoles.md,
*Shell*)."""
_LOOKS = 4
"""How often help is asked for in a row: a menu that was not seen before takes two."""
LATE_S = 0.3
"""A dish that is free answers a short line sooner than this: an older one may be read much later, or was lost."""
MARK_S = 0.5
"""How much longer than a usual answer that of a mark is waited for: without it the line must fall quiet."""
_MOST_MARKS_LOST = 2
"""A console that does not echo blanks is not asked again."""
_PROOFS = 3
"""How often a submenu is looked for before `leave` gives up."""


class Talker:
    """The part of a `Console` that its public methods stand on; nothing here is called from outside."""

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
        self._late = LateLines(self._wire)
        self._learner = Learner(self._wire, delay_s, on_line)
        self._places = MenuPlaces(dialect)
        self._new = True
        self._marks_lost = 0
        self._limit: float | None = None
        self._round_trip_s: float | None = None
        self.took_s = 0.0
        """How long the last line that was answered took, from its first byte out to its prompt."""
        self.answered = 0
        """How many lines in a row, up to the last one, were answered in time."""
        self.on_busy: Callable[[], None] = lambda: None
        """Told, once a line, that the dish is still busy with what came before it."""

    @property
    def menu(self) -> str | None:
        """The menu that the last fresh prompt named; None when it is not known."""
        return self._wire.menu

    @property
    def prompt(self) -> str:
        """The prompt that last answered, as the dish shows it; empty before the first."""
        return self._wire.token

    @property
    def in_step(self) -> bool:
        """Whether all that was sent is accounted for and nothing came unasked since the last proof."""
        wire = self._wire
        return not wire.lost and wire.doubt_until is None and not wire.owed and wire.menu is not None

    def refusal(self, reply: Reply) -> CommandRefused | None:
        """Return what the firmware's error in `reply` means, or None when it holds none."""
        for line in reply.lines:
            for pattern, reason in self.dialect.refusals:
                if pattern.search(line):
                    return CommandRefused(
                        f"The dish refused `{reply.command}` in menu `{reply.menu}`: {line.strip()}",
                        reason=reason,
                        trouble=self.dialect.trouble_in(line),
                    )
        return None

    def _root_hazard(self, line: str) -> CommandRefused:
        return CommandRefused(
            f"`{line}` was not sent: the dish is at its root menu, where a `{self.dialect.leave}` may end "
            "its shell until a power cycle.",
            reason=Reason.WRONG_MENU,
        )

    def _check(self, line: str) -> None:
        if not (line.isascii() and line.isprintable()):
            raise ValueError(f"a console line holds printable ASCII only, not {line!r}")

    def _resume(self) -> None:
        """Make sure that nothing is missing, so that a reply can be told from an older one."""
        self._wire.take_in()
        self._late.end(self._limit)
        if self._wire.lost or self.menu is None:
            self._resynchronize()

    def _resynchronize(self) -> str:
        if self._new:
            # Nothing of ours is under way yet: look at once. A `q` waits until `doubt_until` all the same.
            self._new = False
        elif self.dialect.learnt and not self._wire.lost:
            pass  # no reply is missing: only the menu is in doubt
        elif not self._quiet(strictly=False):
            # It talks on: perhaps a stream, which any key ends.
            self._wire.press_enter()
            self._quiet(strictly=False)
        return self._probe(wakes=True)

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

    def _probe(self, *, wakes: bool = False) -> str:
        """Ask for the menu and return it: by a bare Enter and the prompt that it brings, or by help.

        Lines before the prompt answer nothing: boot text. `wakes`: Enter is pressed once more where no byte comes.
        """
        if not self.dialect.learnt:
            return self._transact("", on_line=self._on_line, wakes=wakes).menu
        if self._wire.lost:
            self._wire.codec.unlearn()  # a prompt learnt wrong may be why a reply is missing
        if not self._wire.codec.knows_prompts or self._wire.codec.unfinished:
            self._learner.ask("", self._limit)
        return self._look()

    def _look(self) -> str:
        """Return the menu that the dish's help tells."""
        wire, places = self._wire, self._places
        for _ in range(_LOOKS):
            reply = self._learner.ask(HELP, self._limit)
            menu = places.judge(reply.lines)
            if menu is None and places.is_stranger(reply.lines):
                raise NoReply(self.dialect.stranger.format(prompt=reply.token), reason=Reason.WRONG_FIRMWARE)
            if menu is not None:
                if menu == self.dialect.root:
                    places.at_root(reply.token)
                wire.menu = menu
                return menu
        raise NoReply(
            f"The dish answers (prompt `{wire.token}`), but `{HELP}` does not tell which menu it is in: it is another "
            "firmware, or bytes are lost. Nothing else was sent.",
            reason=Reason.GARBAGE,
        )

    def _go(self, menu: str) -> None:
        """Go from the menu above it to a submenu, and make sure of it."""
        reply = self._learner.ask(menu, self._limit) if self.dialect.learnt else self._transact(menu)
        refusal = self.refusal(reply)
        if refusal is not None:
            raise refusal
        now = reply.menu
        if self.dialect.learnt:
            if not self._places.is_told_by(reply.token, menu):
                self._wire.menu = None
                now = self._look()
                if self._places.was_entered(menu, now):
                    self._places.entered(menu, reply.token)
                    now = menu
            else:
                now = menu
            self._wire.menu = now
        if now != menu:
            raise CommandRefused(f"The dish did not go to menu `{menu}`; it is in `{now}`.", reason=Reason.WRONG_MENU)

    def _is_proven(self, menu: str) -> bool:
        """Return whether the submenu that the dish was found in is `menu`, by what only that one answers."""
        proof = self.dialect.proofs.get(menu)
        if proof is None or self.menu != SUBMENU or not self._places.may_be(menu):
            return False
        reply = self._transact(proof[0])
        if not any(proof[1].search(line) for line in reply.lines):
            return False
        self._places.entered(menu, reply.token)
        self._wire.menu = menu
        return True

    def _leave_one(self) -> str:
        """Leave the present submenu, proven first, and return the menu that the dish is in then."""
        dialect, menu = self.dialect, self._prove_submenu()
        if menu == dialect.root:
            return menu
        before = self._wire.doubt_until
        now = self._quit()
        if now in (dialect.root, dialect.parent(menu)):
            self._wire.trust_left(before)  # only a `q` leads there: it was carried out
        elif menu in dialect.prompts or not dialect.parents:
            self._wire.lost = True
            raise NoReply(f"The dish answered `{dialect.leave}` but stayed in menu `{now}`.", reason=Reason.BLOCKED)
        return now

    def _quit(self) -> str:
        """Leave a proven submenu, and return the menu that the dish is in then."""
        if not self.dialect.learnt:
            return self._transact(self.dialect.leave).menu
        self._learner.ask(self.dialect.leave, self._limit)
        self._wire.menu = None
        return self._look()

    def _may_change_menu(self, line: str) -> bool:
        """Return whether after this line only help tells the menu, as prompts may be alike."""
        if not self.dialect.learnt:
            return False
        return self.dialect.may_leave(line) or (
            self.menu is not None and self.dialect.may_hold_menus(self.menu) and line.strip() not in ("", HELP)
        )

    def _clear_up(self) -> bool:
        """Have all that is under way accounted for at once, by a mark; return whether that went well (decision 0026).

        Nothing is sent where a command still has its time: a byte could end it.
        """
        wire = self._wire
        if not self.dialect.echo or self._marks_lost >= _MOST_MARKS_LOST or self.clock.monotonic() < wire.busy_until:
            return False
        if self.dialect.learnt and not wire.codec.knows_prompts:
            return False
        ticket = wire.send_mark()
        try:
            self._await("", ticket, min(self.delay_s, MARK_S + 2 * (self._round_trip_s or 0.0)), None)
        except NoReply:
            self._marks_lost += 1
            return False
        self._marks_lost = 0
        return wire.doubt_until is None

    def _prove_submenu(self) -> str:
        """Return the menu that a fresh prompt names, with nothing unaccounted for under way, either way."""
        root = self.dialect.root
        self._resume()
        for _ in range(_PROOFS):
            before = self.menu
            if not self.in_step and not self._clear_up() and not self._quiet(strictly=True):
                break
            now = self._probe()
            if now == root or (now == before and self.in_step):
                return now
        raise NoReply(
            f"The line to the dish does not go quiet, so `{self.dialect.leave}` was not sent: it could reach the "
            "root menu. Check the cable; a power cycle brings the dish back to its root menu.",
            reason=Reason.GARBAGE,
        )

    def _transact(
        self,
        line: str,
        takes_s: float = 0.0,
        on_line: LineSink | None = None,
        permit: Callable[[], None] | None = None,
        busy_s: float = 0.0,
        *,
        wakes: bool = False,
    ) -> Reply:
        sent = self.clock.monotonic()
        ticket = self._wire.send(line, takes_s + busy_s, permit)
        reply = self._await(line, ticket, takes_s + self.delay_s, on_line, busy_s, wakes=wakes)
        self.took_s = self.clock.monotonic() - sent
        if not takes_s and not busy_s:
            self._round_trip_s = self.took_s
        return reply

    def _transact_soon(self, line: str, permit: Callable[[], None] | None) -> Reply:
        """Send one line of a stream; NoReply (`late`) when its reply does not come as soon as the others did."""
        wire, clock, late = self._wire, self.clock, self._late
        proves = late.proves(line)
        patience_s = late.pace.patience_s(self._round_trip_s or self.delay_s, self.delay_s)
        sent = clock.monotonic()
        ticket = wire.send(line, 0.0, permit)
        try:
            while (reply := wire.taken(ticket)) is None and wire.pump(sent + patience_s, ticket):
                pass
        except BaseException:
            wire.forget(ticket)
            late.drop()
            raise
        if reply is None:
            self.answered = 0
            late.add(ticket, line, sent, proves=proves)
            raise NoReply(f"No answer to `{line}` on {wire.link.name} within {patience_s:.2f} s.", reason=LATE)
        self._round_trip_s = self.took_s = clock.monotonic() - sent
        self.answered += 1
        late.answered(ticket, line, sent, proves=proves)
        return reply

    def _await(
        self, line: str, ticket: int, timeout_s: float, on_line: LineSink | None, busy_s: float = 0.0, *,
        wakes: bool = False,
    ) -> Reply:  # fmt: skip
        wire, timeout_s = self._wire, timeout_s + busy_s
        deadline = self.clock.monotonic() + timeout_s
        if self._limit is not None:
            deadline = min(deadline, self._limit)
        try:
            soon = min(deadline, self.clock.monotonic() + timeout_s / 2)
            if wakes and not self._is_answered_by(soon, ticket, on_line) and not wire.seen:
                wire.press_enter()  # a dish that sleeps (NVS 38) may lose the line that wakes it
            if busy_s and not self._is_answered_by(min(deadline, self.clock.monotonic() + LATE_S), ticket, on_line):
                self.on_busy()
            while (reply := wire.taken(ticket)) is None and wire.pump(deadline, ticket, on_line):
                pass
            if reply is None:
                wire.idle(ticket, on_line)
                reply = wire.taken(ticket)
        except BaseException:
            wire.forget(ticket)
            raise
        self.answered = 0 if reply is None else self.answered + 1
        if reply is None:
            strange = None if wire.token else stranger(self.dialect, wire.codec.unfinished)
            wire.forget(ticket)
            if strange is not None:
                raise strange
            raise no_reply(wire.link.name, line, bytes(wire.seen), timeout_s, busy=busy_s > 0.0)
        return reply

    def _is_answered_by(self, until: float, ticket: int, on_line: LineSink | None) -> bool:
        while self._wire.codec.owes(ticket):
            if not self._wire.pump(until, ticket, on_line):
                return False
        return True
