"""Somebody talks to the firmware: the console is theirs, and the station sends nothing of its own (SEAMS *F5*)."""

from __future__ import annotations

from concurrent.futures import Future
from dataclasses import dataclass, replace

from birdcage.antenna.antenna import BirdcageAntenna
from birdcage.antenna.motion import DishMotion
from birdcage.base.errors import (
    BirdcageError,
    CommandRefused,
    ConfirmationNeeded,
    Held,
    LinkError,
    NoReply,
    Stopped,
)
from birdcage.console.events import Reply
from birdcage.console.raw import Typed
from birdcage.protocol.hazard import Grade, Verdict
from birdcage.protocol.protocol import FirmwareProtocol
from birdcage.station import requests as ask
from birdcage.station.board import Board
from birdcage.station.control import Control
from birdcage.station.look import Look
from birdcage.station.menu_commands import MenuCommands
from birdcage.station.mover import Mover
from birdcage.station.raw import MenuCommand, RawReply
from birdcage.station.raw_effects import RawEffects
from birdcage.station.state import Activity, Link
from birdcage.station.stopper import Stopper
from birdcage.station.vigil import Vigil
from birdcage.station.watches import Watches

IDLE_S = 30.0
"""After so long without a line the console is given back."""
LONGEST_S = 60.0
"""How long a line may print on before Enter ends it, unless it is known to take longer."""
STREAM_QUIET_S = 5.0
"""How long a stream may pause."""
PROMPT_S = 0.3
"""How long a prompt that is due at once is waited for when somebody else wants the console."""


@dataclass(slots=True)
class Line:
    """A line that was typed and has no prompt yet."""

    typed: Typed
    text: str
    verdict: Verdict
    future: Future[object]
    ends_at: float
    model: DishMotion | None
    model_before: DishMotion | None
    homed_before: bool | None


class Talk:
    """Active from the first raw line, or from the lease taken as `console`, until the lease is gone."""

    def __init__(
        self, board: Board, antenna: BirdcageAntenna, control: Control, mover: Mover, stopper: Stopper, look: Look,
        watches: Watches, vigil: Vigil, effects: RawEffects,
    ) -> None:  # fmt: skip
        self._board, self._antenna, self._control, self._mover = board, antenna, control, mover
        self._stopper, self._look, self._watches, self._vigil = stopper, look, watches, vigil
        self._effects = effects
        self.menus = MenuCommands(antenna.protocol)
        self._holder: str | None = None
        self._line: Line | None = None
        self._last = 0.0
        self._homed: set[int] = set()

    @property
    def _protocol(self) -> FirmwareProtocol:
        return self._antenna.protocol

    def judge(self, line: str) -> Verdict:
        """Say what a line would do in the present menu. Any thread."""
        state = self._board.state
        verdict = self._protocol.judge(line, state.menu, homed=state.homed)
        if verdict.grade >= Grade.MOVES and not verdict.limit and state.motion_refused_because is not None:
            return replace(verdict, limit=state.motion_refused_because)
        return verdict

    def begin(self, holder: str) -> None:
        """The lease is taken: nothing is sent from now on that `holder` did not type."""
        self._last = self._board.clock.monotonic()
        if self._holder is None:
            self._effects.clear()
            self._homed.clear()
            self._end_excursion()
        self._holder = holder
        self._vigil.paused = True

    def due(self) -> float | None:
        """Return when to look at the line under way, or to give the console back; None while nobody talks."""
        if self._is_over:
            return self._last
        if self._line is not None:
            return self._line.typed.sent if self._line.typed.reply is not None else self._patience(self._line)
        return None if self._holder is None else self._last + IDLE_S

    @property
    def _is_over(self) -> bool:
        return self._holder is not None and self._board.state.holder != self._holder

    def _patience(self, line: Line) -> float:
        """Return when to stop waiting: what talks may go on to its end, what is silent had its time."""
        pause_s = STREAM_QUIET_S if line.verdict.streams else self._protocol.console.delay_s
        return min(line.ends_at, max(line.typed.due, line.typed.heard_at + pause_s))

    def tick(self) -> None:
        """Take the reply, or end what has no end, or give the console back."""
        line, now = self._line, self._board.clock.monotonic()
        if self._is_over:
            self.end()
        elif line is not None:
            if (reply := line.typed.reply) is not None:
                self._answered(line, reply)
            elif now >= line.ends_at:
                self._end_by_key(line)
            else:
                raise self._unanswered(line)
        elif self._holder is not None:
            self._control.give_back(self._holder)
            self.end()

    def raw(self, request: ask.Raw, future: Future[object]) -> None:
        """Send one line. Its future is resolved when the prompt came, or when something else ended it."""
        if not (request.line.isascii() and request.line.isprintable()):
            raise CommandRefused("A console line holds printable ASCII only. Nothing was sent.", reason="bad_parameter")
        self._refuse_held(request.line, self.judge(request.line))
        menu = self._take_console(request.holder)
        verdict = self._admitted(request)
        console = self._protocol.console
        self._effects.announce(request.line, verdict, request.holder, confirmed=request.confirmed)
        if request.line.strip().lower() == console.dialect.leave and menu != console.dialect.root:
            self._leave(request.line, future)
            return
        model = self._effects.modelled(verdict) if menu == self._protocol.motor_menu else None
        before, homed = self._antenna.motion, self._board.state.homed
        if verdict.grade >= Grade.MOVES:
            # Before the first byte: a STOP that comes after that byte must know what to stop.
            self._antenna.motion = model
        self._stopper.homing = bool(verdict.homes)
        self._look.elsewhere = menu != self._protocol.motor_menu or verdict.takes_s > 0 or verdict.streams
        try:
            typed = console.type_line(
                request.line, takes_s=verdict.takes_s, permit=lambda: self._permit(verdict),
                at_root=request.confirmed and menu == console.dialect.root,
            )  # fmt: skip
        except BaseException as error:
            if self._antenna.motion is model:
                self._antenna.motion = before
            self._homing_ends()
            self._effects.say(f"not sent: {error}")
            raise
        self._effects.take_in(verdict)
        ends_at = typed.sent + max(LONGEST_S, verdict.takes_s)
        self._line = Line(typed, request.line, verdict, future, ends_at, model, before, homed)

    def list_commands(self, holder: str) -> tuple[MenuCommand, ...]:
        """Ask the dish for the commands of its present menu, once a session, and return them."""
        menu = self._take_console(holder)
        if not self.menus.was_told(menu):
            asks = self.menus.asks(menu)
            told: list[str] = []
            for ask_line in asks:
                self._effects.say(f"raw by {holder}: {ask_line} (HARMLESS)")
                try:
                    told += self._protocol.console.exchange(ask_line, permit=lambda: self._permit(None)).lines
                except CommandRefused:
                    if ask_line is asks[0]:
                        raise
            self.menus.learn(menu, told)
            self._last = self._board.clock.monotonic()
        return self.menus.of(menu)

    def make_way(self) -> None:
        """End a line that prints on, for something else that needs the wire. CommandRefused while it is at work."""
        line = self._line
        if line is None:
            return
        now = self._board.clock.monotonic()
        if line.verdict.takes_s > 0 and not line.verdict.streams and now < line.typed.due:
            raise CommandRefused(f"The dish is still at `{line.text}`. Wait, or STOP.", reason="busy")
        self._come_to_an_end(line)

    def end(self) -> None:
        """The console is the station's again: see where the dish is, and read again what may have changed."""
        holder, self._holder = self._holder, None
        line, effects = self._line, self._effects
        try:
            if line is not None:
                self._come_to_an_end(line)
        finally:
            if holder is not None:
                self._vigil.paused = False
                if self._board.state.position_lost is not None:
                    self._board.change(position=None)
                if effects.resurvey:
                    self._look.forget_survey()
                self._vigil.look_afresh(unsettled=effects.moved)

    def shut(self) -> None:
        """The station ends: nothing that a person started may print on without end."""
        line, self._line = self._line, None
        if line is None:
            return
        if line.typed.reply is None and self._protocol.is_connected and self._board.state.link.state is Link.UP:
            try:
                line.typed.press_enter()
            except LinkError as error:
                line.future.set_exception(error)
                return
        line.future.set_exception(Stopped("The station has ended.", reason="closing"))

    # How it is done: nothing below is called from outside.

    def _end_excursion(self) -> None:
        away = self._watches.excursion is not None
        self._watches.end_excursion()
        if away and self._board.state.link.state is Link.UP and self._look.may_leave:
            self._protocol.enter_motor_menu()  # where a person expects to be

    def _take_console(self, holder: str) -> str:
        """Take the lease and the wire; return the menu that the dish is in."""
        link, state = self._board.state.link, self._board.state
        if link.state is not Link.UP:
            raise LinkError(f"Nothing can be said to the dish without a link ({link.detail}).", reason=link.state.value)
        if self._mover.is_moving or state.activity in (Activity.SLEWING, Activity.STOPPING, Activity.STOWING):
            raise CommandRefused(
                "The dish is on its way for birdcage, which must hear it. Wait until it rests, or STOP. "
                "Nothing was sent.",
                reason="moving",
            )
        self._control.take(holder)
        self.begin(holder)
        self.make_way()
        menu = self._protocol.console.find_menu()
        self._board.change(menu=menu)
        return menu

    def _admitted(self, request: ask.Raw) -> Verdict:
        verdict = self.judge(request.line)
        self._refuse_held(request.line, verdict)
        if verdict.grade > Grade.HARMLESS and not request.confirmed:
            about = " ".join(text for text in (verdict.consequence, verdict.limit) if text)
            raise ConfirmationNeeded(f"`{request.line}` was not sent. {about}")
        return verdict

    def _refuse_held(self, line: str, verdict: Verdict) -> None:
        if verdict.grade >= Grade.MOVES and self._control.latched:
            raise Held(f"STOP is latched: `{line}` was not sent. A person must release it first.")

    def _permit(self, verdict: Verdict | None) -> None:
        if self._board.state.holder != self._holder:
            raise Stopped("Control was taken away before the line went out: it was not sent.")
        permit = self._protocol.permit
        if permit is not None and verdict is not None and verdict.grade >= Grade.MOVES:
            permit()

    def _leave(self, text: str, future: Future[object]) -> None:
        console, began = self._protocol.console, self._board.clock.monotonic()
        self._look.elsewhere = True
        console.leave()
        self._last = self._board.clock.monotonic()
        menu = console.dialect.root
        future.set_result(RawReply(text, (), menu, console.dialect.prompts[menu], self._last - began))

    def _come_to_an_end(self, line: Line) -> None:
        """Have the prompt of a line: by itself where it is due, else by Enter."""
        if not line.verdict.streams:
            left_s = line.typed.due - self._board.clock.monotonic()
            try:
                reply = line.typed.wait(left_s if line.verdict.homes else min(left_s, PROMPT_S))
            except BaseException as error:
                self._failed(line, error)
                raise
            if reply is not None:
                self._answered(line, reply)
                return
        self._end_by_key(line)

    def _end_by_key(self, line: Line) -> None:
        try:
            line.typed.press_enter()
            reply = line.typed.wait(self._protocol.console.delay_s)
        except BaseException as error:
            self._failed(line, error)
            raise
        if reply is None:
            raise self._unanswered(line)
        self._answered(line, reply, by_key=True)

    def _unanswered(self, line: Line) -> NoReply:
        silence = line.typed.give_up()
        self._failed(line, silence)
        return silence

    def _failed(self, line: Line, error: BaseException) -> None:
        self._line = None
        self._homing_ends()
        line.future.set_exception(
            error if isinstance(error, BirdcageError) else Stopped("The station has failed.", reason="closing")
        )

    def _answered(self, line: Line, reply: Reply, *, by_key: bool = False) -> None:
        self._line, self._last = None, self._board.clock.monotonic()
        self._look.elsewhere = reply.menu != self._protocol.motor_menu
        self._homing_ends()
        refused = self._protocol.console.refusal(reply) is not None
        if refused and line.model is not None and self._antenna.motion is line.model:
            self._antenna.motion = line.model_before
        if line.verdict.homes and not refused:
            self._found_references(line)
        took_s = self._last - line.typed.sent
        line.future.set_result(RawReply(line.text, reply.lines, reply.menu, reply.token, took_s, ended_by_key=by_key))

    def _found_references(self, line: Line) -> None:
        gate = self._protocol.gate
        for axis in line.verdict.homes:
            gate.found_reference(axis)
            self._homed.add(axis)
        axes = {gate.model.azimuth.index, gate.model.elevation.index}
        if line.homed_before or axes <= self._homed:
            self._board.change(homed=True)

    def _homing_ends(self) -> None:
        if self._stopper.homing:
            self._stopper.homing = False
            self._stopper.resume()
