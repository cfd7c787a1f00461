"""A rotator behind a rotctld: Hamlib's own, or whatever else speaks its protocol (`docs/reference/rotctl.md`)."""

from __future__ import annotations

import math
import threading
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from typing import Any

from birdcage.base.clock import Clock
from birdcage.base.errors import CommandRefused, LinkError, NoReply
from birdcage.base.reason import Reason
from birdcage.console.line_splitter import HeardLine
from birdcage.hamlib.address import dialled
from birdcage.hamlib.aims import AxisAims
from birdcage.hamlib.commands import COMMANDS
from birdcage.hamlib.features import FEATURES, INFO
from birdcage.hamlib.hazards import HAZARDS
from birdcage.hamlib.model import FACTS, facts_of, on_cable
from birdcage.hamlib.replies import (
    CodeReply,
    PositionReply,
    ServerReply,
    ServerState,
    StateReply,
    read_state,
    reason_of,
    words_of,
)
from birdcage.hamlib.session import AnyReply, RotctldSession
from birdcage.link.opening import open_link
from birdcage.protocol.line_raw import LineRaw
from birdcage.rotator.facts import CableTurn
from birdcage.rotator.hooks import Hooks
from birdcage.rotator.ladder import StopBy, StopOrder
from birdcage.rotator.plain import PlainLine, PlainRotator
from birdcage.rotator.readings import UnreadablePosition
from birdcage.rotator.values import Look, Survey, Taken

AZ, EL = "azimuth", "elevation"
HURRY_S, HURRY_SHARE = 0.5, 2.5
"""How long a stream of targets waits for a reply: so many seconds, or times the last reply's where that is longer."""
QUIET_S = 0.5
"""After so long without another line the old form of `\\dump_state`, which has no end, is over."""
SERIAL_BAUD = 9600
"""At a serial port, where somebody has put the protocol on one."""
LOST_ITS_ROTATOR = frozenset({-5, -6, -8, -13, -20})
"""Codes of a server that cannot reach its rotator: nothing is known then, as of one that is silent."""


class HamlibRotator(PlainRotator):
    """Implements `Rotator`. `P` names both axes: the one that stays is sent where it was sent last."""

    facts = FACTS
    feature_table = FEATURES
    line: PlainLine

    def __init__(self) -> None:
        self.line = PlainLine()
        self.raw = LineRaw(lambda: self.session, HAZARDS, COMMANDS)
        self._hooks, self._dial = Hooks(), _closed
        self._lock = threading.RLock()
        self._session: RotctldSession | None = None
        self._clock: Clock | None = None
        self._stops: list[ServerReply] = []
        self._late: list[ServerReply] = []
        """Replies that a stream did not wait for and that are still to come."""
        self._tells_state: bool | None = None
        """Whether it knows `\\dump_state`; None before it was asked."""
        self._answers_stop = True
        self._lacks_commands: set[str] = set()
        """Those that this server leaves unanswered."""
        self._doubtful = False
        """Whether a reply is missing: it may still come, and be taken for another's."""
        self._aims = AxisAims()

    @property
    def is_open(self) -> bool:
        """See `Rotator`."""
        return self._session is not None

    @property
    def session(self) -> RotctldSession:
        """The conversation; LinkError while there is none."""
        session = self._session
        if session is None:
            raise LinkError("The rotctld is not connected.", reason=Reason.LOST)
        return session

    @property
    def clock(self) -> Clock:  # type: ignore[override]
        """See `Rotator`."""
        return self.session.clock

    def open(self, address: str, baud: int | None, clock: Clock, hooks: Hooks) -> None:
        """See `Rotator`."""
        dial = hooks.dial or (lambda name, rate: open_link(name, baud=rate, clock=clock))
        where = dialled(address)
        rate = baud or (0 if "://" in where else SERIAL_BAUD)
        self._hooks, self._clock, self._dial = hooks, clock, lambda: dial(where, rate)
        self.line = PlainLine(hooks.delay_s)
        self._tells_state, self._answers_stop, self._lacks_commands = None, True, set()
        self._connect(clock)

    def _connect(self, clock: Clock) -> None:
        link = self._dial()
        with self._lock:
            before, self._session = self._session, RotctldSession(link, clock, self._hooks, self._hear)
            self._stops, self._late, self._doubtful = [], [], False
            self._aims.forget()
        self.is_simulated = link.demo
        if before is not None:
            before.link.close()

    def close(self, within_s: float) -> None:  # noqa: ARG002 - hanging up is all there is to do
        """See `Rotator`."""
        with self._lock:
            session, self._session = self._session, None
        if session is not None:
            session.link.close()

    def _hear(self, line: HeardLine) -> None:
        self._hooks.on_line(line.text)

    def ask(self, reply: AnyReply, **how: Any) -> AnyReply:  # noqa: ANN401 - as `RotctldSession.exchange` takes it
        """Send a command and return its reply; raises as `RotctldSession.exchange`, NoReply of a lost rotator, too."""
        session = self.session
        try:
            session.exchange(reply, **how)
        except NoReply:
            self.line.note_silence()
            self._doubtful = True
            raise
        except CommandRefused as refused:
            self.line.note(reply.sent_at, session.clock.monotonic())
            if reply.code in LOST_ITS_ROTATOR:
                raise NoReply(f"{refused} Check the rotator, its power and its cable, and the server.") from refused
            raise
        self.line.note(reply.sent_at, session.clock.monotonic())
        self.line.stray_bytes = session.stray_bytes
        return reply

    def ask_if_known(self, reply: AnyReply) -> AnyReply:
        """Send a command that not every server knows; CommandRefused (`unsupported`) where it is left unanswered.

        Then the connection is a new one: what may still come to that must not be taken for another's reply.
        """
        word = reply.command.split()[0]
        if word in self._lacks_commands:
            raise self._unknown(reply)
        try:
            return self.ask(reply)
        except NoReply:
            if reply.code in LOST_ITS_ROTATOR:
                raise
            self._connect_anew()
            self._ask_position(within_s=None)
            self._lacks_commands.add(word)
            raise self._unknown(reply) from None

    @staticmethod
    def _unknown(reply: ServerReply) -> CommandRefused:
        return CommandRefused(
            f"This server does not know `{reply.command}`: it left that unanswered.", reason=Reason.UNSUPPORTED
        )

    def _connect_anew(self) -> None:
        assert self._clock is not None, "it was open"
        self._connect(self._clock)

    def meet(self) -> None:
        """See `Rotator`. Its server tells its ranges, if it does; else that it answers is told by a position."""
        if self._doubtful:
            self._connect_anew()
        state = self._ask_state() if self._tells_state is not False else None
        if state is None:
            self._ask_position(within_s=None)
        self._tells_state = state is not None
        self.facts = facts_of(state)
        self._hooks.on_facts(self.facts)

    def _ask_state(self) -> ServerState | None:
        try:
            return read_state(self.ask(StateReply("\\dump_state"), quiet_s=QUIET_S).lines)
        except CommandRefused:
            return None
        except NoReply:
            if self._tells_state:
                raise
            self._connect_anew()  # what it may still say to that must not be taken for a position
            return None

    def survey(self) -> Survey:
        """See `Rotator`."""
        if not self._tells_state:
            return Survey()
        state = read_state(self.ask(StateReply("\\dump_state"), quiet_s=QUIET_S).lines)
        told = {"model": state.model, "rot_type": state.kind}
        if state.south_zero is not None:
            told["south_zero"] = "1" if state.south_zero else "0"
        elevation = facts_of(state).elevation
        low, high = (elevation.min_deg, elevation.max_deg) if state.has_elevations else (None, None)
        try:
            features = FEATURES.read(self, self.facts.name, [INFO], self._stamp)
        except CommandRefused:
            features = {}
        return Survey(
            {name: text for name, text in told.items() if text is not None},
            {name: reading.value for name, reading in features.items()},
            el_min_deg=low, el_max_deg=high,
        )  # fmt: skip

    def look(self, *, hurry: bool = False, busy_s: float = 0.0) -> Look:  # noqa: ARG002 - it answers while it turns
        """See `Rotator`."""
        return Look(self._ask_position(within_s=self._patience_s() if hurry else None))

    def _patience_s(self) -> float:
        """Return how long a stream waits for a reply. How long this server takes, late replies tell, too."""
        self.session.take_in()
        for reply in self._late:
            if reply.done:
                self.line.note_late(reply.sent_at, reply.at)
        self._late = [reply for reply in self._late if not reply.is_over]
        usual_s = self.line.round_trip_s or 0.0
        return min(max(HURRY_S, HURRY_SHARE * usual_s), self.line.delay_s)

    def _ask_position(self, within_s: float | None) -> dict[str, float]:
        reply, era = PositionReply("p"), self._aims.era
        with self._lateness(reply, within_s):
            self.ask(reply, within_s=within_s)
        az_deg, el_deg = reply.angles
        if not (math.isfinite(az_deg) and math.isfinite(el_deg)):
            raise UnreadablePosition(f"The server told {' and '.join(reply.lines)}: no position.", reply.lines)
        self.printed_deg = max(PRINTED_LEAST_DEG, *map(_printed_deg, reply.lines))
        tells_turn = self._tells_turn
        if tells_turn:
            az_deg = on_cable(az_deg, self.facts.cable)
        # As it is told, as that is what an axis that stays is sent: a whole turn off it may go round once.
        self._aims.see({AZ: az_deg, EL: el_deg}, self.clock.monotonic(), era, circle=not tells_turn)
        return {AZ: az_deg if tells_turn else az_deg % 360.0, EL: el_deg}

    @property
    def _tells_turn(self) -> bool:
        return self.facts.turn is CableTurn.REPORTED

    @contextmanager
    def _lateness(self, reply: ServerReply, within_s: float | None) -> Iterator[None]:
        """Call a reply late that a stream did not wait for; silent, once one may no longer be on its way."""
        try:
            yield
        except NoReply as error:
            oldest, now = self.session.oldest_due, self.clock.monotonic()
            young = oldest is not None and now - oldest < self.line.delay_s
            if within_s is None or reply.is_over or not young:
                raise
            self._doubtful = False
            self._late.append(reply)
            self.line.late += 1
            raise NoReply(str(error), reason=Reason.LATE) from error

    def send(self, to: Mapping[str, float], *, hurry: bool = False, busy_s: float = 0.0) -> Taken:  # noqa: ARG002
        """See `Rotator`."""
        if any(axis not in to and not self._aims.knows(axis) for axis in (AZ, EL)):
            self.look()
        before, aims = self._aims.known, self._aims.with_(to, circle=not self._tells_turn)
        reply, within_s = CodeReply(_to(aims)), self._patience_s() if hurry else None

        def permit() -> None:
            if self._hooks.permit is not None:
                self._hooks.permit()
            self._aims.sent(aims, self.clock.monotonic())

        try:
            with self._lateness(reply, within_s):
                self.ask(reply, within_s=within_s, permit=permit)
        finally:
            if reply.is_refused:
                self._aims.back_to(before)
        return Taken(sure=reply.code == 0, said=f"RPRT {reply.code}", took_s=self.line.took_s)

    def stop_now(self, order: StopOrder) -> None:
        """See `Rotator`. `S` goes out alone: some servers take what they read at once for a single command."""
        with self._lock:
            if order.by is StopBy.COMMAND:
                reply: ServerReply = CodeReply("S")
            elif order.by is StopBy.RETARGET:
                reply = CodeReply(_to(self._aims.with_(order.aim_deg, circle=not self._tells_turn)))
            else:
                reply = PositionReply("p")
            stops = isinstance(reply, CodeReply)
            try:
                self._stops.append(self.session.post(reply))
            finally:
                if stops:
                    self._aims.forget()  # what went out until now: `P` notes that as it goes out

    def settle(self, within_s: float) -> tuple[CommandRefused | None, ...]:
        """See `Rotator`. Where `S` brings no reply, that of a `p` sent behind it tells that it was read."""
        stops, self._stops = self._stops, []
        if not stops:
            return ()
        session, begun = self.session, self.clock.monotonic()
        waited_s = within_s / 2.0 if self._answers_stop else 0.0
        if not self._await_all(stops, begun + waited_s):
            session.post(PositionReply("p"))
            self._await_all(stops, begun + within_s)
        if not all(reply.is_over for reply in stops):
            raise NoReply("The server did not answer `S`.")
        self._answers_stop = not any(reply.skipped for reply in stops)
        return tuple(_refusal(reply) for reply in stops)

    def _await_all(self, replies: list[ServerReply], until: float) -> bool:
        for reply in replies:
            self.session.await_reply(reply, until)
        return all(reply.is_over for reply in replies)

    def listen(self, until: float) -> None:
        """See `Rotator`."""
        self.session.listen(until)


PRINTED_LEAST_DEG = 0.01
"""Hamlib prints hundredths, and sends no finer ones."""


def _printed_deg(text: str) -> float:
    _whole, point, decimals = text.replace(",", ".").partition(".")
    return 10.0 ** -len(decimals) if point else 1.0


def _to(aims: Mapping[str, float]) -> str:
    return f"P {aims[AZ]:z.2f} {aims[EL]:z.2f}"


def _refusal(reply: ServerReply) -> CommandRefused | None:
    if reply.skipped:
        return CommandRefused(f"The server left `{reply.command}` unanswered.", reason=Reason.UNSUPPORTED)
    if not reply.is_refused:
        return None
    assert reply.code is not None
    return CommandRefused(
        f"The server answered `{reply.command}` with {words_of(reply.code)}.", reason=reason_of(reply.code)
    )


def _closed() -> Any:  # noqa: ANN401 - a line, were there one
    raise LinkError("The rotctld is not connected.", reason=Reason.LOST)
