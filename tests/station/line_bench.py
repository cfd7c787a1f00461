"""A station whose machine speaks in plain lines, on a virtual clock: its console has no prompt, echo or menus."""

from __future__ import annotations

import re
from dataclasses import replace

from birdcage.base.errors import LinkError
from birdcage.console.line_session import LineDialect, LineSession
from birdcage.link.link import Link
from birdcage.protocol.g2.model import CARRYOUT_G2
from birdcage.protocol.hazard import Hazard, HazardTable
from birdcage.protocol.line_raw import LineRaw
from birdcage.rotator import machines
from birdcage.rotator.raw import CommandDoc
from birdcage.rotator.values import Look, Survey
from birdcage.rotator.verdict import Grade
from birdcage.station.raw import CONSOLE
from birdcage.station.requests import Raw
from line_machine import LineMachine

from .conftest import Bench

EVERYWHERE = frozenset()
HAZARDS = HazardTable(
    rows=(
        Hazard(EVERYWHERE, re.compile("az el|ve|gs|")),
        Hazard(EVERYWHERE, re.compile("sa se"), Grade.SETTING, "Stops both axes."),
        Hazard(
            EVERYWHERE,
            re.compile(r"az(?P<az>\d\S*)|el(?P<el>\d\S*)"),
            Grade.MOVES,
            "Turns an axis at once.",
            frozenset({"position"}),
        ),
    ),
    unlisted={"": "Undocumented command."},
)
BOOT_MARKS = ("READY",)
COMMANDS = (CommandDoc(None, "AZ", "AZ<deg>", "turns to an azimuth"), CommandDoc(None, "VE", "VE", "version"))
POSITION = re.compile(r"AZ([\d.]+) EL([\d.]+)")


class LineWire(LineSession):
    """A `Line` on which nothing but lines passes."""

    place, is_settled, last_reply, round_trip_s, took_s, answered = None, True, None, 0.02, 0.02, 0
    asked = unanswered = late = 0

    def unanswered_s(self):
        return 0.0


class LineRotator:
    """The language of `LineMachine`: what the raw console needs of a `Rotator`, and what a station asks at rest."""

    facts = replace(CARRYOUT_G2, name="line machine", features={})
    printed_deg = 0.1
    is_simulated = True

    def __init__(self):
        self._wire = None
        self.raw = LineRaw(lambda: self.line, HAZARDS, COMMANDS, BOOT_MARKS)

    @property
    def is_open(self):
        return self._wire is not None

    @property
    def line(self):
        if self._wire is None:
            raise LinkError("not open", reason="closed")
        return self._wire

    @property
    def clock(self):
        return self.line.clock

    def open(self, address, baud, clock, hooks):
        def hear(line):
            (hooks.on_restart if line.text.startswith(BOOT_MARKS) else hooks.on_line)(line.text)

        dialect = LineDialect(b"\n", ((re.compile("^ERR"), "unknown_command"),))
        self._wire = LineWire(
            hooks.dial(address, baud or self.facts.baud), clock, dialect, delay_s=hooks.delay_s, wake=hooks.wake,
            on_wake=hooks.on_wake, on_line=hear,
        )  # fmt: skip

    def close(self, _within_s):
        wire, self._wire = self._wire, None
        if wire is not None:
            wire.link.close()

    def meet(self):
        self.look()

    def make_ready(self):
        pass

    def catch_up(self):
        pass

    def survey(self):
        return Survey()

    def look(self, *, hurry=False, busy_s=0.0):
        az_deg, el_deg = map(float, self.line.ask("AZ EL", POSITION).match.groups())
        return Look({"azimuth": az_deg, "elevation": el_deg})

    def stop_now(self, _order):
        self.line.interject(["SA SE"])

    def settle(self, _within_s):
        return (None,)  # what stops it is not answered; positions tell whether it stands

    def listen(self, until):
        self.line.listen(until)

    def is_answer(self, _text):
        return False


class LineBench(Bench):
    def __init__(self, monkeypatch, line_end=b"\r\n"):
        monkeypatch.setattr(machines, "make", lambda _name: LineRotator())
        self.remarks, self.line_end = [], line_end
        super().__init__("g2", {"remark": self.remarks.append, "survey": False}, "lines")
        self.machine = LineMachine(self.clock, line_end)
        self.connect()
        self.watch("position")
        self.step(3)

    def _open(self, port, baud):
        if self.machine.gone:
            raise LinkError("unplugged", reason="missing")
        self.opened.append(self.machine)
        return Link(self.machine, self.clock)

    def type(self, line, *, confirmed=Grade.HARMLESS, seconds=30.0):
        return self.do(Raw(line, CONSOLE, confirmed), seconds)

    def received(self):
        return self.machine.heard
