"""The contract, kept by both firmwares that speak EasyComm."""

from __future__ import annotations

import pytest
from birdcage.testing import ConsoleScene, Contract, MachineBench, StopScene

from .simulated import SimTwin


class RotatorTwin(SimTwin):
    """One of them; of the stock one only an axis whose target changes counts as sent."""

    def __init__(self, clock, address):
        super().__init__(clock, address, self._named)
        self._last = {}

    def _named(self, line):
        named = set()
        for word in line.split():
            axis = {"AZ": 0, "EL": 1}.get(word[:2])
            if axis is not None and word[2:]:
                named |= {axis} if self._last.get(axis) != word else set()
                self._last[axis] = word
        return {0, 1} if line in ("PARK", "RESET") else named

    def taken(self):
        self._last = {}
        return super().taken()


def rotator(options):
    return lambda clock: RotatorTwin(clock, f"easycomm?seed=1{options}")


@pytest.fixture(params=["&az=90&el=30", "&az=90&el=30&replies=apart", "&az=90&el=30&kind=stock"])
def bench(request):
    return MachineBench(
        "easycomm",
        rotator(request.param),
        stops=(StopScene("command", (90.0, 30.0), 1.5),),
        console=ConsoleScene("GS", "GS1", "AZ100 EL20"),
        near_deg=0.15,
        follows_deg=0.3,
    )


class TestEasycomm(Contract):
    pass
