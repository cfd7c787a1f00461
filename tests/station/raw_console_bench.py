"""A bench at which somebody types."""

from __future__ import annotations

from birdcage.station.raw import CONSOLE, Grade
from birdcage.station.requests import Goto, Home, Raw, ReleaseLease

from .conftest import Bench


class TalkBench(Bench):
    def __init__(self, address="g2?seed=1", **options):
        self.remarks = []
        super().__init__(address, {"remark": self.remarks.append, **options})
        self.connect()
        self.watch("position")
        self.step(6)  # identity and limits are read by then

    def type(self, line, *, confirmed=Grade.HARMLESS, seconds=30.0):
        return self.do(Raw(line, CONSOLE, confirmed), seconds)

    def begin(self, line, *, confirmed=Grade.HARMLESS):
        return self.station.submit(Raw(line, CONSOLE, confirmed))

    def counted(self):
        """The turn of the cable is known, and the dish stands at 300 degrees."""
        self.do(Home("you"))
        self.do(Goto(300, 45, "you"))
        self.do(ReleaseLease("you"))
        return self

    def in_raw_motion(self, line="a 0 100", seconds=0.7):
        """A raw motion, counterclockwise, that takes seconds is under way."""
        self.type(line, confirmed=Grade.RUINS)
        self.step(seconds)
        assert self.device.truth().moving
        return self.device.truth().az_deg

    def at_rest(self):
        return not self.device.truth().moving


def lines_since(bench, time):
    return [line for at, line in bench.received() if at > time]
