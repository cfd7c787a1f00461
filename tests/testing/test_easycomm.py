"""The contract, kept by both firmwares that speak EasyComm."""

from __future__ import annotations

import pytest
from birdcage.testing import ConsoleScene, Contract, Golden, MachineBench, StopScene

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


def met_and_looked(rotator):
    rotator.meet()
    return rotator.look().angles


def met_and_sent(rotator):
    rotator.meet()
    rotator.send({"azimuth": 60.0})
    rotator.send({"azimuth": -12.25, "elevation": 0.0})
    return rotator.kind.query


GOLDENS = (
    Golden(
        "RP2040, README of the base station",
        (
            (b"\n", b""),
            (b"VE\n", b"VESatNOGS-RP2040-v0.2\n"),
            (b"EL\n", b"AZ45.0 EL30.0\n"),
            (b"EL\n", b"AZ45.0 EL30.0\n"),
            (b"EL\n", b"AZ45.0 EL30.0\n"),
        ),
        met_and_looked,
        {"azimuth": 45.0, "elevation": 30.0},
    ),
    Golden(
        "RP2040 that answers each axis by itself",
        (
            (b"\n", b""),
            (b"VE\n", b"VESatNOGS-RP2040-v0.2\r\n"),
            (b"EL\n", b"EL-0.3\r\n"),
            (b"EL\n", b"EL-0.3\r\n"),
            (b"AZ EL\n", b"AZ45.0\r\nEL-0.3\r\n"),
            (b"AZ EL\n", b"AZ45.1 EL-0.3\r\n"),
        ),
        met_and_looked,
        {"azimuth": 45.1, "elevation": -0.3},
    ),
    Golden(
        "stock firmware, which is never asked by AZ alone, and always sent both axes",
        (
            (b"\n", b""),
            (b"VE\n", b"VESatNOGS-v2.2\n"),
            (b"AZ EL\n", b"AZ10.0 EL20.0\n"),
            (b"AZ EL\n", b"AZ10.0 EL20.0\n"),
            (b"GE\n", b"GE1\n"),
            (b"AZ EL\n", b"AZ10.0 EL20.0\n"),
            (b"AZ60.00 EL20.00\n", b""),
            (b"AZ EL\n", b"AZ10.4 EL20.0\n"),
            (b"AZ-12.25 EL0.00\n", b""),
            (b"AZ EL\n", b"AZ12.0 EL20.0\n"),
        ),
        met_and_sent,
        "AZ EL",
    ),
    Golden(
        "another firmware: one decimal, and its lines come twice",
        (
            (b"\n", b""),
            (b"VE\n", b"VEAcme 1\n"),
            (b"VE\n", b"VEAcme 1\n"),
            (b"AZ EL\n", b"AZ10.0 EL20.0\nAZ10.0 EL20.0\n"),
            (b"AZ EL\n", b"AZ10.0 EL20.0\nAZ10.0 EL20.0\n"),
            (b"AZ EL\n", b"AZ10.0 EL20.0\nAZ10.0 EL20.0\n"),
            (b"AZ60.0 EL20.0\n", b""),
            (b"AZ EL\n", b"AZ10.4 EL20.0\nAZ10.4 EL20.0\n"),
            (b"AZ-12.2 EL0.0\n", b""),
            (b"AZ EL\n", b"AZ12.0 EL20.0\n"),
        ),
        met_and_sent,
        "AZ EL",
    ),
)
"""The answers as docs/reference/easycomm.md has them."""


def rotator(options):
    return lambda clock: RotatorTwin(clock, f"easycomm?seed=1{options}")


@pytest.fixture(params=["&az=90&el=30", "&az=90&el=30&replies=apart", "&az=90&el=30&kind=stock"])
def bench(request):
    return MachineBench(
        "easycomm",
        rotator(request.param),
        stops=(StopScene("command", (90.0, 30.0), 1.5),),
        console=ConsoleScene("GS", "GS1", "AZ100 EL20"),
        goldens=GOLDENS,
        near_deg=0.15,
        follows_deg=0.3,
    )


class TestEasycomm(Contract):
    pass
