"""A rotator that speaks EasyComm II or III: asked for both angles, told both, stopped by its own command."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping

from birdcage.base.clock import Clock
from birdcage.base.errors import CommandRefused, LinkError, NoReply, PositionUnknown
from birdcage.base.reason import Reason
from birdcage.base.trouble import MotorTrouble
from birdcage.console.line_session import LineAnswer, LineSession
from birdcage.console.line_splitter import HeardLine
from birdcage.easycomm.commands import DOCUMENTED, HAZARDS
from birdcage.easycomm.facts import FACTS, STOCK_HOMING_S
from birdcage.easycomm.features import FEATURES
from birdcage.easycomm.kinds import OTHER, EasycommKind, kind_of
from birdcage.easycomm.typed_lines import EasycommRaw
from birdcage.easycomm.wire import (
    AXIS_WORDS,
    AZIMUTH,
    BOOT_MARKS,
    ELEVATION,
    ELEVATION_ALONE,
    MONITORED,
    PIECE,
    POSITION,
    PROBE,
    RECALIBRATED,
    SAFE_QUERY,
    TOLD,
    VERSION,
    WIRE,
    ZEROED,
    set_line,
)  # fmt: skip
from birdcage.link.opening import open_link
from birdcage.rotator.facts import Facts
from birdcage.rotator.feature import VERSION as VERSION_FEATURE
from birdcage.rotator.feature_table import FeatureTable
from birdcage.rotator.hooks import Hooks
from birdcage.rotator.ladder import StopBy, StopOrder
from birdcage.rotator.plain import PlainLine, PlainRotator
from birdcage.rotator.raw import RawLines
from birdcage.rotator.readings import UnreadablePosition
from birdcage.rotator.values import Look, Survey, Taken

VERSION_S = 1.0
"""How long a firmware may take to tell its version; one that does not know the question is silent."""
SENSIBLE_DEG = {AZIMUTH: 1000.0, ELEVATION: 400.0}
"""An angle beyond is a damaged line."""
NO_ERROR, NOT_FOUND = "1", "4"
"""What `GE` of the stock firmware tells of its homing."""


class EasycommRotator(PlainRotator):
    """`docs/reference/easycomm.md` has each fact.

    A set is not answered. So it is followed by a question: what answers that has read the set before.
    """

    facts: Facts = FACTS
    feature_table: FeatureTable = FEATURES
    probe = PROBE
    printed_deg = 0.1

    def __init__(self) -> None:
        self.line: PlainLine = PlainLine()
        self.kind: EasycommKind = OTHER
        self.raw: RawLines | None = EasycommRaw(lambda: self.session, HAZARDS, DOCUMENTED, BOOT_MARKS, self._forget)
        self._hooks = Hooks()
        self._session: LineSession | None = None
        self._due = 0
        """Positions that what `stop_now` wrote is still to bring."""
        self._stop_at = -math.inf
        """When it wrote that (monotonic seconds)."""
        self._owed_until = -math.inf
        """Until when a question that was given up may still bring a position of its own."""
        self._stopped = False
        """Whether STOP was written since the last set."""
        self._elevation: HeardLine | None = None
        self._query = SAFE_QUERY
        self._is_met = False
        """Whether `kind` was told since the line was opened."""
        self._in_force: dict[str, float | None] = {}
        """What the firmware's target of an axis is known to be; None: where it stands since STOP."""
        self._version = ""
        self._found: set[str] = set()
        """Axes whose switch the last `RESET` has found, nothing was sent since, and `home` was not asked for yet."""
        self._is_lost = False
        """Whether it said last that it did not find its switches."""

    @property
    def is_open(self) -> bool:
        """See `Rotator`."""
        return self._session is not None

    @property
    def session(self) -> LineSession:
        """The open session; LinkError without one."""
        if self._session is None:
            raise LinkError("The rotator is not open.", reason=Reason.LOST)
        return self._session

    @property
    def clock(self) -> Clock:  # type: ignore[override]
        """See `Rotator`."""
        return self.session.clock

    def open(self, address: str, baud: int | None, clock: Clock, hooks: Hooks) -> None:
        """See `Rotator`."""
        dial = hooks.dial or (lambda name, rate: open_link(name, baud=rate, clock=clock))
        link = dial(address, baud or self.facts.baud)
        self.is_simulated, self._hooks = link.demo, hooks
        self.line, self._due, self._owed_until = PlainLine(hooks.delay_s), 0, -math.inf
        self._is_met = False
        self._forget()
        self._session = LineSession(
            link, clock, WIRE, delay_s=hooks.delay_s, wake=hooks.wake, on_wake=hooks.on_wake, on_line=self._hear
        )

    def close(self, within_s: float) -> None:  # noqa: ARG002 - nothing has to be sent
        """Let go; it goes on to its targets."""
        session, self._session = self._session, None
        if session is not None:
            session.link.close()

    def meet(self) -> None:
        """Ask which firmware it is, then where it points, in the way that no firmware takes for a move."""
        self.session.send("")  # ends what an earlier program may have left unfinished
        version = self._ask_version() or self._ask_version()
        if version is None:
            self._query = self.kind.query  # as it was known before: a stock one does not answer what an RP2040 does
            self._read_position()
            version = self._ask_version() or self._version  # it answers now: it may have been starting before
        self.kind, self._version = kind_of(version), version
        self._query = self.kind.query
        if self.ask(self._query, TOLD)[1] is None and self.ask(self._query, TOLD)[1] is None:
            self._query = SAFE_QUERY  # it answers each axis by itself, and that was no damage
        self._read_position()
        self._is_lost = self.kind.homes and self._error() == NOT_FOUND
        self._is_met = True
        self.facts = self.kind.facts
        self._hooks.on_facts(self.facts)

    def _ask_version(self) -> str | None:
        """Return its version; None from one that does not know the question, or does not answer yet.

        One that is not known is asked for again, and counts when it is told twice: the first may have been damaged.
        """
        try:
            version = self.ask("VE", VERSION, within_s=VERSION_S)[1]
            while kind_of(version) is OTHER and version != (again := self.ask("VE", VERSION, within_s=VERSION_S)[1]):
                version = again
            return version
        except NoReply as error:
            if error.reason not in (Reason.SILENT, Reason.BLOCKED):
                raise
            return None

    def survey(self) -> Survey:
        """Tell the version that it had as it was met."""
        return Survey(features={VERSION_FEATURE: self._version} if self._version else {})

    def look(self, *, hurry: bool = False, busy_s: float = 0.0) -> Look:  # noqa: ARG002 - each is answered at once
        """See `Rotator`: as it counts. Where its zero points a person says (`Facts.zero_at_power_up`).

        PositionUnknown (`unhomed`) while it says that it did not find its switches: it then counts from anywhere.
        """
        if self._is_lost and (code := self._error()) == NOT_FOUND:
            raise PositionUnknown(_lost(code), reason=Reason.UNHOMED)
        self._is_lost = False
        return Look(self._read_position())

    def _error(self, within_s: float | None = None) -> str:
        """Ask for the code of its error."""
        return self.ask("GE", r"GE(\d+)", within_s=within_s)[1]

    def _read_position(self) -> dict[str, float]:
        """Ask once where it is by its own count."""
        self._hear_out(self.clock.monotonic() + self.line.delay_s)
        answer = self._answer(self._query, POSITION)
        match, until = answer.match, self.clock.monotonic() + self.line.delay_s
        elevation = match[2] or self._heard_elevation(answer.at, until)
        told = {AZIMUTH: float(match[1]), ELEVATION: float(elevation)}
        for axis, deg in told.items():
            if abs(deg) > SENSIBLE_DEG[axis]:
                raise UnreadablePosition(f"The rotator tells {axis} {deg:g}°: the line was damaged.", [match[0]])
        return told

    def _heard_elevation(self, since: float, until: float) -> str:
        """Return the elevation of a firmware that answers in two lines: the one behind its azimuth, and none before."""
        while self._elevation is None or self._elevation.at < since:
            if not self.session.listen(until):
                raise NoReply("The rotator told its azimuth, and no elevation.", reason=Reason.BLOCKED)
        match = ELEVATION_ALONE.fullmatch(self._elevation.text)
        assert match is not None, "`_hear` keeps no other"
        return match[1]

    def ask(
        self, line: str, answer: str | re.Pattern[str], *, within_s: float | None = None,
        permit: Callable[[], None] | None = None,
    ) -> re.Match[str]:  # fmt: skip
        """Send a line, and return how its answer matched. NoReply where none came in time."""
        return self._answer(line, answer, within_s, permit).match

    def _answer(
        self, line: str, answer: str | re.Pattern[str], within_s: float | None = None,
        permit: Callable[[], None] | None = None,
    ) -> LineAnswer:  # fmt: skip
        sent = self.clock.monotonic()

        def note() -> None:
            if permit is not None:
                permit()
            if answer in (POSITION, TOLD):
                self._owed_until = self.clock.monotonic() + self.line.delay_s

        try:
            told = self.session.ask(line, re.compile(answer), within_s=within_s, permit=note)
        except NoReply:
            self.line.note_silence()
            raise
        self._owed_until = -math.inf
        self.line.note(sent, self.clock.monotonic())
        return told

    def send(self, to: Mapping[str, float], *, hurry: bool = False, busy_s: float = 0.0) -> Taken:  # noqa: ARG002
        """Send one axis or both; the other one is named, too, where the firmware needs it.

        A number behind AZ or EL ends manual mode on both axes: an axis whose target is not known to be ours is sent
        where it stands.
        """
        angles = dict(to) | self._others(to)
        self._found.clear()
        self.session.send(set_line(angles, self.kind.decimals), self._hooks.permit)
        self._in_force |= angles
        return Taken(sure=True, said=self.ask(self._query, TOLD)[0], took_s=self.line.took_s)

    def _others(self, to: Mapping[str, float]) -> dict[str, float]:
        """Return the targets that have to be named beside those that change."""
        if self._stopped:
            self._stopped = False
            self._in_force = dict.fromkeys(AXIS_WORDS) if self.kind.stop_snaps else {}
        others = [axis for axis in AXIS_WORDS if axis not in to]
        if not others or (not self.kind.names_both and all(axis in self._in_force for axis in others)):
            return {}
        known = {axis: deg for axis in others if (deg := self._in_force.get(axis)) is not None}
        if len(known) < len(others):
            known = self._read_position() | known
        return {axis: known[axis] for axis in others}

    def _forget(self) -> None:
        """Count on no target any more, nor on that of a STOP before: somebody else may have set another."""
        self._in_force, self._stopped = {}, False
        self._found.clear()

    def _recounted(self) -> None:
        self._forget()
        self._hooks.on_recount()

    def stop_now(self, order: StopOrder) -> None:
        """See `Rotator`."""
        if order.by is StopBy.COMMAND:
            self._stopped = True
        kind = self.kind if self._is_met else OTHER
        lines = [kind.stop if order.by is StopBy.COMMAND else self._query] * kind.lines
        self._due += len(lines)
        self._stop_at = self.clock.monotonic()
        self.session.interject(lines)

    def settle(self, within_s: float) -> tuple[None, ...]:
        """See `Rotator`: every answer tells the position, and none refuses."""
        due = self._due
        if not self._hear_out(self.clock.monotonic() + within_s):
            raise NoReply("The rotator did not answer STOP.", reason=Reason.SILENT)
        return (None,) * due

    def _hear_out(self, until: float) -> bool:
        """Hear the answers to STOP, so that none is taken for another's; return whether they came."""
        while self._due:
            if not self.session.listen(until):
                self._due = 0
                return False
        return True

    def listen(self, until: float) -> None:
        """See `Rotator`."""
        self.session.listen(until)

    def is_answer(self, text: str) -> bool:
        """Positions come twice from some firmwares, late from all, and in pieces from a bad line."""
        return PIECE.search(text) is not None

    def _hear(self, line: HeardLine) -> None:
        if self._due and POSITION.fullmatch(line.text) is not None:
            if line.at < self._stop_at or line.at <= self._owed_until:
                self._owed_until = -math.inf  # of a question that went out before STOP
            else:
                self._due -= 1
        elif ELEVATION_ALONE.fullmatch(line.text) is not None:
            self._elevation = line
        elif any(mark in line.text for mark in BOOT_MARKS):
            self._forget()
            self._hooks.on_restart(line.text)
        elif line.text == ZEROED:
            self._recounted()
        elif MONITORED.fullmatch(line.text) is None:
            self._hooks.on_line(line.text)

    def home(self, axis: str) -> None:
        """Run both axes to their switches (`RESET`, the stock firmware alone), which nothing stops.

        CommandRefused (`unsupported`) of any other firmware, for which `RESET` means something else; with the trouble
        of the axis where a switch is not found. The second axis is found with the first one.
        """
        if not self.kind.homes:
            raise self._lacks("homing")
        if axis in self._found:
            self._found.discard(axis)
            return
        self._forget()
        self.ask("RESET", POSITION, permit=self._hooks.permit)
        code = self._error(STOCK_HOMING_S)  # it reads nothing before it has homed
        self._is_lost = code == NOT_FOUND
        if code != NO_ERROR:
            raise CommandRefused(
                _lost(code), reason=Reason.FAILED, trouble=MotorTrouble(axis, homing=True, said=f"GE{code}")
            )
        self._in_force = dict.fromkeys(AXIS_WORDS, 0.0)
        self._found = set(AXIS_WORDS) - {axis}

    def recalibrate(self) -> None:
        """Take the elevation from the accelerometer (`RECAL`). CommandRefused where there is none."""
        self._forget()  # whatever comes of its answer
        told = self.ask("RECAL", RECALIBRATED)
        if told[1] is None:
            raise CommandRefused(
                "No accelerometer is fitted, so the elevation was not changed.", reason=Reason.UNSUPPORTED
            )

    def run(self, axis: str, duty: float) -> float:
        """Give a motor a share of its supply, without end (`DUTY_AZ`, `DUTY_EL`), and return what it took.

        Nothing but STOP and a new target ends that. Raises as `ask`.
        """
        name = AXIS_WORDS[axis]
        self._forget()
        told = self.ask(f"DUTY_{name}{duty:.2f}", rf"{name} duty=(-?[\d.]+)", permit=self._hooks.permit)
        return float(told[1])

    def zero(self) -> None:
        """Count both encoders from here (`ZERO`), with the loop off: it would go on to its targets.

        Raises as `ask`. A sync is void as soon as the line is written: its answer may be lost.
        """
        self._forget()
        for name in ("AZ", "EL"):
            self.ask(f"DUTY_{name}0", rf"{name} duty=.*")
        try:
            self.ask("ZERO", ZEROED)
        finally:
            self._recounted()
        self._read_position()  # the loop has read the new counts before it answers
        self.ask(self.kind.stop, POSITION)


def _lost(code: str) -> str:
    return (
        f"The rotator did not find its switches (GE{code}), so it does not know where it points. Only its power clears "
        "that: switch it off and on."
    )
