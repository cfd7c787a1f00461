"""Which menu the dish is in, found by looking and never assumed, and the ways from one menu to another.

Why a `q` can't reach a root prompt is argued in `docs/decisions/0003-q-in-step.md`.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

from birdcage.base.errors import CommandRefused, NoReply
from birdcage.base.reason import Reason
from birdcage.console.events import LineSink
from birdcage.console.exchanges import Exchanges
from birdcage.console.learner import Learner
from birdcage.console.places import SUBMENU, MenuPlaces
from birdcage.console.wire import Wire

HELP = "?"
"""Lists the commands of a menu, on all of these consoles, and does nothing else (docs/reference/consoles.md,
*Shell*)."""
_LOOKS = 4
"""How often help is asked for in a row: a menu that was not seen before takes two."""
_PROOFS = 3
"""How often a submenu is looked for before `leave` gives up."""


class Menus:
    """Goes from menu to menu by what the dish shows. The owner's thread only; errors as those of `Exchanges`.

    `on_line` hears lines that no command asked for: boot texts.
    """

    def __init__(self, wire: Wire, exchanges: Exchanges, on_line: LineSink | None) -> None:
        self.dialect = wire.dialect
        self._wire, self._exchanges, self._on_line = wire, exchanges, on_line
        self._learner = Learner(wire, wire.delay_s, on_line)
        self._places = MenuPlaces(wire.dialect)
        self._new = True
        """Whether nothing of ours was ever under way."""
        self.on_end: Callable[[str], None] = lambda _menu: None
        """Told, each time, that the dish showed to be at its root, or in a menu that nothing is known to leave."""

    def synchronize(self) -> str:
        """Find out which menu the dish is in, by a bare Enter, and return its name.

        NoReply reasons: `silent`, `garbage`, `echo` (only our own bytes came back), `blocked` (text, but no prompt).
        """
        self._exchanges.collect()
        if self._wire.lost:
            return self._resynchronize()
        return self._probe()

    def find(self) -> str:
        """Return the menu that the dish is in; asked by a bare Enter only when it is not known."""
        self.resume()
        assert self._wire.menu is not None, "a prompt named it"
        return self._wire.menu

    def resume(self) -> None:
        """Make sure that nothing is missing, so that a reply can be told from an older one."""
        self._exchanges.collect()
        if self._wire.lost or self._wire.menu is None:
            self._resynchronize()

    def _resynchronize(self) -> str:
        if self._new:
            # Nothing of ours is under way yet: look at once. A `q` waits until `doubt_until` all the same.
            self._new = False
        elif self.dialect.learnt and not self._wire.lost:
            pass  # no reply is missing: only the menu is in doubt
        elif not self._exchanges.fall_quiet(strictly=False):
            # It talks on: perhaps a stream, which any key ends.
            self._wire.press_enter()
            self._exchanges.fall_quiet(strictly=False)
        return self._probe(wakes=True)

    def _probe(self, *, wakes: bool = False) -> str:
        """Ask for the menu and return it: by a bare Enter and the prompt that it brings, or by help.

        Lines before the prompt answer nothing: boot text. `wakes`: Enter is pressed once more where no byte comes.
        """
        if not self.dialect.learnt:
            return self._shown(self._exchanges.ask("", on_line=self._on_line, wakes=wakes).menu)
        if self._wire.lost:
            self._wire.codec.unlearn()  # a prompt learnt wrong may be why a reply is missing
        if not self._wire.codec.knows_prompts or self._wire.codec.unfinished:
            self._learner.ask("")
        return self._look()

    def _look(self) -> str:
        """Return the menu that the dish's help tells."""
        wire, places = self._wire, self._places
        for _ in range(_LOOKS):
            reply = self._learner.ask(HELP)
            menu = places.judge(reply.lines)
            if menu is None and places.is_stranger(reply.lines):
                raise NoReply(self.dialect.stranger.format(prompt=reply.token), reason=Reason.WRONG_FIRMWARE)
            if menu is not None:
                if menu in self.dialect.ends:
                    places.at_end(menu, reply.token)
                wire.menu = menu
                return self._shown(menu)
        raise NoReply(
            f"The dish answers (prompt `{wire.token}`), but `{HELP}` does not tell which menu it is in: it is another "
            "firmware, or bytes are lost. Nothing else was sent.",
            reason=Reason.GARBAGE,
        )

    def _shown(self, menu: str) -> str:
        if menu in self.dialect.ends:
            self.on_end(menu)
        return menu

    def _go(self, menu: str) -> None:
        """Go from the menu above it to a submenu, and make sure of it."""
        reply = self._learner.ask(menu) if self.dialect.learnt else self._exchanges.ask(menu)
        refusal = self.dialect.refusal_in(reply)
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
        self._shown(now)
        if now != menu:
            raise CommandRefused(f"The dish did not go to menu `{menu}`; it is in `{now}`.", reason=Reason.WRONG_MENU)

    def _is_proven(self, menu: str) -> bool:
        """Return whether the submenu that the dish was found in is `menu`, by what only that one answers."""
        proof = self.dialect.proofs.get(menu)
        if proof is None or self._wire.menu != SUBMENU or not self._places.may_be(menu):
            return False
        reply = self._exchanges.ask(proof[0])
        if not any(proof[1].search(line) for line in reply.lines):
            return False
        self._places.entered(menu, reply.token)
        self._wire.menu = menu
        return True

    def _leave_one(self) -> str:
        """Leave the present submenu, proven first, and return the menu that the dish is in then."""
        dialect, menu = self.dialect, self.prove_submenu()
        if menu in dialect.ends:
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
            return self._exchanges.ask(self.dialect.leave).menu
        self._wire.menu = None  # also for how long each line after it waits
        self._learner.ask(self.dialect.leave)
        return self._look()

    def prove_submenu(self) -> str:
        """Return the menu that a fresh prompt names, with nothing unaccounted for under way, either way."""
        ends, exchanges = self.dialect.ends, self._exchanges
        self.resume()
        for _ in range(_PROOFS):
            before = self._wire.menu
            if (
                not self._exchanges.is_settled
                and not self._exchanges.account_by_mark()
                and not self._exchanges.fall_quiet(strictly=True)
            ):
                break
            now = self._probe()
            if now in ends or (now == before and exchanges.is_settled):
                return now
        raise NoReply(
            f"The line to the dish does not go quiet, so `{self.dialect.leave}` was not sent: it could reach the "
            "root menu. Check the cable; a power cycle brings the dish back to its root menu.",
            reason=Reason.GARBAGE,
        )

    def enter(self, menu: str) -> None:
        """Go to `menu`, by way of the one that it shares with where the dish is; nothing is sent when it is there."""
        if menu not in self.dialect.prompts:
            raise CommandRefused(f"This firmware has no menu `{menu}`.", reason=Reason.WRONG_MENU)
        self.resume()
        if self._wire.menu == menu or self._is_proven(menu):
            return
        way = (self.dialect.root, *self.dialect.path(menu))
        for step in way[way.index(self.leave_until(way)) + 1 :]:
            self._go(step)

    def leave_until(self, there: Sequence[str]) -> str:
        """Leave menus until the dish is in one of these; return which. CommandRefused where nothing leads there."""
        now = self.find()
        for _ in range(self.dialect.depth + 1):
            if now in there:
                return now
            if now in self.dialect.one_way:
                raise CommandRefused(
                    f"No command is known that leaves menu `{now}`. A power cycle brings the dish back to "
                    f"`{self.dialect.root}`.",
                    reason=Reason.WRONG_MENU,
                )
            now = self._leave_one()
        raise NoReply(f"The dish is still in menu `{now}`, though each above it was left.", reason=Reason.BLOCKED)

    def leave_one(self) -> str:
        """Go back to the menu above the present one, as `leave`, and return where the dish is then."""
        self.resume()
        now = self._wire.menu
        return now if now is not None and now in self.dialect.ends else self._leave_one()

    def may_change(self, line: str) -> bool:
        """Return whether after this line only help tells the menu, where prompts are learnt and may be alike."""
        return self.dialect.leaving.search(line) is not None or (
            self._wire.menu is not None
            and self.dialect.may_hold_menus(self._wire.menu)
            and line.strip() not in ("", HELP)
        )
