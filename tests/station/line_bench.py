"""A station whose machine speaks in plain lines, on a virtual clock: its console has no prompt, echo or menus."""

from __future__ import annotations

import re

from birdcage.base.errors import LinkError
from birdcage.console.dialect import ConsoleDialect
from birdcage.console.line_session import LineDialect, LineSession
from birdcage.link.link import Link
from birdcage.protocol.g2 import CarryoutG2Protocol
from birdcage.protocol.hazard import Hazard, HazardTable
from birdcage.protocol.line_raw import LineRaw
from birdcage.protocol.protocol import FirmwareProtocol
from birdcage.protocol.registry import FIRMWARE_REGISTRY
from birdcage.protocol.types import Position
from birdcage.rotator.raw import CommandDoc
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
            EVERYWHERE, re.compile(r"(?:az|el)\d\S*"), Grade.MOVES, "Turns an axis at once.", frozenset({"position"})
        ),
    ),
    unlisted={"": "Undocumented command."},
)
COMMANDS = (CommandDoc(None, "AZ", "AZ<deg>", "turns to an azimuth"), CommandDoc(None, "VE", "VE", "version"))
POSITION = re.compile(r"AZ([\d.]+) EL([\d.]+)")


class LineWire(LineSession):
    """What a station asks of an open console beside lines, answered for a wire on which none of it is needed."""

    menu, owed, answered, took_s, round_trip_s, in_step, last_reply = None, 0, 0, 0.0, 0.02, True, None

    def synchronize(self):
        self.ask("AZ EL", POSITION)

    def clear_up(self):
        return True

    def settle(self, _within_s):
        return ("heard",)  # what stops it is not answered; positions tell whether it stands

    def unanswered_s(self):
        return 0.0


class LineDish(FirmwareProtocol):
    """The language of `LineMachine`."""

    name, model, motor_menu, dialect = "lines", CarryoutG2Protocol.model, "", ConsoleDialect(prompts={})
    boot_marks = ("READY",)

    def __init__(self):
        super().__init__()
        self.raw = LineRaw(self._session, HAZARDS, COMMANDS, self.boot_marks)

    def _session(self):
        return self.console

    def attach(self, link, clock, *, delay_s=2.0, wake=None, on_wake=None, on_line=None):
        self._link = link
        dialect = LineDialect(b"\n", ((re.compile("^ERR"), "unknown_command"),))
        self._console = LineWire(
            link, clock, dialect, delay_s=delay_s, wake=wake, on_wake=on_wake, on_line=lambda line: on_line(line.text)
        )  # fmt: skip

    def disconnect(self, *, within_s=2.0):
        link, self._link, self._console = self._link, None, None
        if link is not None:
            link.close()

    def initialize(self, callback=None, *, timeout_s=0.0):
        pass

    def enter_motor_menu(self):
        pass

    def get_position(self):
        position = Position(*map(float, self.console.ask("AZ EL", POSITION).match.groups()))
        self.gate.see(position)
        return position

    def _send_move(self, motor_id, degrees, busy_s):
        raise NotImplementedError

    def stop_lines(self, az_deg, el_deg):
        return ("SA SE",)

    def kill_search(self):
        pass


class LineBench(Bench):
    def __init__(self, monkeypatch, line_end=b"\r\n"):
        monkeypatch.setitem(FIRMWARE_REGISTRY, "lines", LineDish)
        monkeypatch.setattr("birdcage.antenna.antenna.MenuRaw", lambda protocol: protocol.raw)
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
