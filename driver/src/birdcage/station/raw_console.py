"""Somebody talks to the firmware: the console is theirs, and the station sends nothing of its own.

`docs/decisions/0007-raw-lines.md`.
"""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import Future
from dataclasses import replace

from birdcage.antenna.raw_limits import limited
from birdcage.base.errors import CommandRefused, ConfirmationNeeded, Held, Stopped
from birdcage.base.reason import Reason
from birdcage.rotator.ladder import MoveKind
from birdcage.rotator.raw import CommandDoc, RawLines
from birdcage.rotator.verdict import Grade, Verdict
from birdcage.station import requests as ask
from birdcage.station.dish_monitor import DishMonitor
from birdcage.station.line_under_way import LineUnderWay, SentLine
from birdcage.station.menu_commands import MenuCommands
from birdcage.station.parts import Parts
from birdcage.station.raw import IDLE_S, MenuCommand, RawMark, RawReply
from birdcage.station.raw_effects import RawEffects
from birdcage.station.state import Activity, LinkPhase

LONGEST_LINE = 120
BUSY = (
    Activity.SLEWING, Activity.FOLLOWING, Activity.STOWING, Activity.SWEEPING, Activity.HOMING, Activity.MOTOR_RUN,
)  # fmt: skip
"""Characters. No command that is known needs a third of it, and what a firmware does with more is unknown."""


class RawConsole:
    """Active from the first raw line, or from the lease taken as `console`, until the lease is gone."""

    def __init__(self, parts: Parts, monitor: DishMonitor, effects: RawEffects, permit: Callable[[], None]) -> None:
        """`permit` raises to keep a line that moves the dish from going out."""
        self._parts, self._store, self._antenna, self._control = parts, parts.store, parts.antenna, parts.control
        self._mover, self._stopper, self._reader, self._watches = (
            parts.mover,
            parts.stopper,
            parts.reader,
            parts.watches,
        )
        self._monitor, self._effects, self._permit_motion = monitor, effects, permit
        self.line = LineUnderWay(parts.store, parts.antenna, parts.stopper, parts.reader, effects)
        self.menus = MenuCommands(parts.antenna.raw)
        self.holder: str | None = None
        """Who talks; None while no one does."""
        self._last = 0.0

    @property
    def _raw(self) -> RawLines:
        if (raw := self._antenna.raw) is None:
            raise CommandRefused("This machine has no console. Nothing was sent.", reason=Reason.UNSUPPORTED)
        return raw

    def judge(self, line: str) -> Verdict:
        """Say what a line would do in the present menu. Any thread."""
        if self._antenna.raw is None:
            return Verdict(Grade.HARMLESS, "")  # none is ever sent
        state = self._store.state
        verdict = limited(self._raw.judge(line, state.menu, homed=state.homed), self._antenna.gate)
        if verdict.grade >= Grade.MOVES and not verdict.limit and state.motion_refused_because is not None:
            return replace(verdict, limit=state.motion_refused_because)
        return verdict

    def begin(self, holder: str) -> None:
        """The lease is taken: nothing is sent from now on that `holder` did not type."""
        self._last = self._store.clock.monotonic()
        begins, self.holder = self.holder is None, holder
        self._monitor.paused = True
        if begins:
            self._effects.clear()
            self._end_excursion()

    def due(self) -> float | None:
        """Return when to look at the line under way, or to give the console back; None while no one talks."""
        if self._is_over:
            return self._last
        line_due = self.line.due()
        if line_due is not None:
            return line_due
        return None if self.holder is None else max(self._last, self.line.answered_at) + IDLE_S

    @property
    def _is_over(self) -> bool:
        return self.holder is not None and self._store.state.holder != self.holder

    def tick(self) -> None:
        """Look at the line under way, or give the console back."""
        if self._is_over:
            self.end()
        elif self.line.due() is not None:
            self.line.tick()
        elif self.holder is not None:
            self._control.give_back(self.holder)
            self.end()

    def raw(self, request: ask.Raw, future: Future[object]) -> None:
        """Send one line. Its future is resolved when the answer came, or when something else ended it."""
        raw = self._raw
        self._refuse_unsendable(request.line)
        self._refuse_held(request.line, self.judge(request.line))
        menu = self._take_console(request.holder)
        verdict = self._admitted(request)
        self._effects.announce(request.line, verdict, request.holder)
        if raw.leaves(request.line, menu):
            self._leave(request.line, future)
        else:
            self._type(request, verdict, menu, future)

    def list_commands(self, holder: str) -> tuple[MenuCommand, ...]:
        """Ask the dish for the commands of its present menu, once a session, and return them."""
        raw = self._raw
        menu = self._take_console(holder)
        if not self.menus.was_told(menu):
            asks = raw.help_lines(menu)
            told: list[CommandDoc] = []
            for ask_line in asks:
                self._effects.say(RawMark(holder, ask_line, Grade.HARMLESS, "asks for the list of commands").text)
                try:
                    told += raw.ask_commands(ask_line, menu, lambda: self._permit(None))
                except CommandRefused:
                    if ask_line is asks[0]:
                        raise
                    self._effects.say(f"this dish has no `{ask_line}` here: its list ends there")
            self.menus.learn(menu, told)
            self._last = self._store.clock.monotonic()
        return self.menus.of(menu)

    def end(self) -> None:
        """The console is the station's again: see where the dish is, and read again what may have changed."""
        holder, self.holder = self.holder, None
        try:
            self.line.finish()
        finally:
            if holder is not None:
                self._monitor.paused = False
                if self._store.state.position_lost is not None:
                    self._store.change(position=None)
                if self._effects.resurvey:
                    self._reader.forget_survey()
                self._monitor.look_afresh(unsettled=self._effects.moved)

    # How it is done: nothing below is called from outside.

    def _end_excursion(self) -> None:
        watches, rotator, raw = self._watches, self._antenna.rotator, self._antenna.raw
        away, others = watches.excursion is not None, watches.is_away
        watches.end_excursion()
        watches.is_away = False
        if raw is None or self._store.state.link.state is not LinkPhase.UP:
            return
        if others:
            rotator.catch_up()  # a stream may have ended a moment ago
        if (away or others) and self._reader.may_leave:
            raw.go_home()  # where a person expects to be

    def _take_console(self, holder: str) -> str | None:
        """Take the lease and the wire; return the menu that the dish is in, where it has any."""
        self._parts.require_link("nothing is sent")
        state = self._store.state
        busy = state.activity in BUSY
        if busy or self._mover.is_moving or self._stopper.is_pending:
            raise CommandRefused(
                "birdcage is moving the dish and must hear it. Wait until it rests, or STOP. Nothing was sent.",
                reason=Reason.MOVING,
            )
        self._control.take(holder)
        self.begin(holder)
        self.line.make_way()
        menu = self._raw.find_place()
        self._store.change(menu=menu)
        return menu

    def _refuse_unsendable(self, line: str) -> None:
        if not (line.isascii() and line.isprintable()):
            raise CommandRefused(
                "A console line holds printable ASCII only. Nothing was sent.", reason=Reason.BAD_PARAMETER
            )
        if len(line) > LONGEST_LINE:
            raise CommandRefused(
                f"A console line holds {LONGEST_LINE} characters at most, not {len(line)}. Nothing was sent.",
                reason=Reason.BAD_PARAMETER,
            )

    def _admitted(self, request: ask.Raw) -> Verdict:
        verdict = self.judge(request.line)
        self._refuse_held(request.line, verdict)
        if verdict.grade > request.confirmed:
            meanwhile = "The line is more dangerous now than when you confirmed it." if request.confirmed else ""
            about = " ".join(text for text in (meanwhile, verdict.consequence, verdict.limit) if text)
            raise ConfirmationNeeded(f"`{request.line}` was not sent. {about}")
        return verdict

    def _refuse_held(self, line: str, verdict: Verdict) -> None:
        if verdict.grade >= Grade.MOVES and self._control.latched:
            raise Held(f"STOP is latched: `{line}` was not sent. A person must release it first.")

    def _permit(self, verdict: Verdict | None) -> None:
        if self._store.state.holder != self.holder:
            raise Stopped("Control was taken away before the line went out: it was not sent.")
        if verdict is not None and verdict.grade >= Grade.MOVES:
            self._permit_motion()

    def _leave(self, text: str, future: Future[object]) -> None:
        began = self._store.clock.monotonic()
        self._reader.elsewhere = True
        answer = self._raw.leave()
        self._last = self._store.clock.monotonic()
        future.set_result(RawReply(text, answer.lines, answer.place, answer.prompt, self._last - began))

    def _type(self, request: ask.Raw, verdict: Verdict, menu: str | None, future: Future[object]) -> None:
        raw, motors = self._raw, menu == self._raw.home
        model = self._effects.modelled(verdict) if motors else None
        moving = self._antenna.moving
        # Before the first byte: a STOP that comes after that byte must know what to stop.
        before = moving.assume(model) if verdict.grade >= Grade.MOVES else moving.model
        moving.keep_busy(MoveKind.HOME if verdict.homes else None)
        # An undocumented line may lead to another menu.
        self._reader.elsewhere = not motors or verdict.takes_s > 0 or verdict.streams or not verdict.listed
        try:
            typed = raw.type_line(
                request.line, menu, takes_s=verdict.takes_s, confirmed=request.confirmed,
                permit=lambda: self._permit(verdict),
            )  # fmt: skip
        except BaseException as error:
            moving.take_back(model, before)
            self.line.homing_ends()
            self._effects.say(f"not sent: {error}")
            raise
        self._effects.sent(verdict)
        self.line.begin(SentLine(raw, typed, request.line, verdict, future, model, before))
