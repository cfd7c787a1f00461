"""A machine that says where it is whenever it likes, and takes the turn of its cable for an azimuth.

Its wire: `P <turn> <el>` comes five times a second, unasked; `G <axis> <deg>` sends one axis and is answered `K`;
`T <turn> <el>` sends both at once, ahead of whatever it does, and is answered `S`.
"""

from __future__ import annotations

import re

from birdcage.base.errors import LinkError, NoReply
from birdcage.base.reason import Reason
from birdcage.console.line_session import LineDialect, LineSession
from birdcage.link.opening import open_link
from birdcage.rotator.axis import Axis, CableRange, Role, TurnBy
from birdcage.rotator.facts import CableTurn, Facts, Readback, SearchSwitch, SecondMove
from birdcage.rotator.feature import Cost, Feature, FeatureKind, Range, Writer
from birdcage.rotator.feature_table import FeatureRow, FeatureTable
from birdcage.rotator.ladder import POWER_SWITCH, MoveKind, Rung, StopMeans
from birdcage.rotator.plain import PlainLine, PlainRotator
from birdcage.rotator.values import Look, Taken

SPEED_DEG_S = 12.0
LAMP = r"L (\d+)"
FEATURES = FeatureTable(
    FeatureRow(
        Feature("supply", "Supply voltage", "V", FeatureKind.NUMBER, Range(0.0, 30.0), cost=Cost(while_moving=True)),
        lambda pushy: {"supply": float(pushy.ask("V", r"V (\S+)"))},
    ),
    FeatureRow(
        Feature("lamp", "Lamp at its foot", "%", FeatureKind.NUMBER, Range(0.0, 100.0), Writer.UNTIL_RESTART),
        lambda pushy: {"lamp": float(pushy.ask("L", LAMP))},
        lambda pushy, bright: {"lamp": float(pushy.ask(f"L {bright:.0f}", LAMP))},
    ),
)
AXES = "pan", "tilt"
FACTS = Facts(
    name="Pushy",
    firmware="pushy",
    baud=9600,
    axes=(
        Axis("pan", Role.AZ, 0.0, 360.0, SPEED_DEG_S, 400.0, 0.1, turn_by=TurnBy.HOST),
        Axis("tilt", Role.EL, 0.0, 85.0, SPEED_DEG_S, 400.0, 0.1),
    ),
    cable=CableRange(-270.0, 270.0),
    turn=CableTurn.REPORTED,
    second_same=SecondMove.RETARGET,
    second_other=SecondMove.RETARGET,
    stop_ladder=(
        Rung(
            means=StopMeans.RETARGET,
            ends=frozenset({MoveKind.SINGLE}),
            proven=True,
            sentence="a new target just ahead of it",
        ),
        POWER_SWITCH,
    ),
    slew=None,
    search_switch=SearchSwitch.NEVER_SEARCHES,
    homing_s=None,
    never_homes=True,
    boot_s=1.0,
    readback=Readback.ALWAYS,
    power_switch="plug",
    features=FEATURES.features,
)
PUSHED = re.compile(r"P (\S+) (\S+)")


class Pushy(PlainRotator):
    facts = FACTS
    feature_table = FEATURES

    def __init__(self):
        self.line = PlainLine()
        self._link = self._session = None
        self._told, self._told_at, self._stops = None, -1.0, 0

    @property
    def is_open(self):
        return self._session is not None

    @property
    def clock(self):
        return self._open_session().clock

    def _open_session(self):
        if self._session is None:
            raise LinkError("Pushy is not open.", reason=Reason.LOST)
        return self._session

    def open(self, address, baud, clock, hooks):
        dial = hooks.dial or (lambda name, rate: open_link(name, baud=rate, clock=clock))
        self._link, self._hooks = dial(address, baud or self.facts.baud), hooks
        self.is_simulated = self._link.demo
        self.line, self._told_at, self._stops = PlainLine(hooks.delay_s), -1.0, 0
        self._session = LineSession(
            self._link, clock, LineDialect(b"\n"), delay_s=hooks.delay_s, wake=hooks.wake, on_wake=hooks.on_wake,
            on_line=self._hear,
        )  # fmt: skip

    def close(self, within_s):
        link, self._link, self._session = self._link, None, None
        if link is not None:
            link.close()

    def _hear(self, line):
        if (pushed := PUSHED.fullmatch(line.text)) is not None:
            self._told, self._told_at = Look({"pan": float(pushed[1]), "tilt": float(pushed[2])}), line.at
        elif line.text == "S":
            self._stops = max(0, self._stops - 1)
        else:
            self._hooks.on_line(line.text)

    def meet(self):
        self.look()

    def look(self, *, hurry=False, busy_s=0.0):
        session = self._open_session()
        asked = session.clock.monotonic()
        while self._told_at <= asked:
            if not session.listen(asked + self.line.delay_s):
                self.line.note_silence()
                raise NoReply("Pushy says nothing.", reason=Reason.SILENT)
        self.line.note(asked, session.clock.monotonic())
        return self._told

    def ask(self, line, answer):
        session = self._open_session()
        sent = session.clock.monotonic()
        told = session.ask(line, re.compile(answer))
        self.line.note(sent, session.clock.monotonic())
        return told.match[1]

    def send(self, to, *, hurry=False, busy_s=0.0):
        ((axis, deg),) = to.items()
        session = self._open_session()
        sent = session.clock.monotonic()
        session.ask(f"G {AXES.index(axis)} {deg:.2f}", re.compile("K"), permit=self._hooks.permit)
        self.line.note(sent, session.clock.monotonic())
        return Taken(True, "K", self.line.took_s)

    def stop_now(self, order):
        session = self._open_session()
        self._stops += 1
        session.interject(["T {pan:.2f} {tilt:.2f}".format(**order.aim_deg)] if order.aim_deg else ["T"])

    def settle(self, within_s):
        session, due = self._open_session(), self._stops
        until = session.clock.monotonic() + within_s
        while self._stops:
            if not session.listen(until):
                self._stops = 0
                raise NoReply("Pushy did not answer STOP.", reason=Reason.SILENT)
        return (None,) * due

    def listen(self, until):
        before = self._told_at
        self._open_session().listen(until)
        if self._told_at > before:
            self._hooks.on_look(self._told)  # only now: whoever hears it may ask
