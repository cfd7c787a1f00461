"""The contract, kept by the Carryout G2."""

from __future__ import annotations

import pytest
from birdcage.rotator.values import Look
from birdcage.testing import ConsoleScene, Contract, Golden, MachineBench, StopScene

from .simulated import sim


def home_go_and_look(rotator):
    rotator.make_ready()
    rotator.home("azimuth")
    rotator.home("elevation")
    rotator.send({"azimuth": 180.0})
    rotator.send({"elevation": 45.0})
    return rotator.look()


MOVE = Golden(
    "T-G2-MOVE",
    (
        (b"\r", b"\r\nTRK>"),
        (b"mot\r", b"mot\r\nMOT>"),
        (b"h 0\r", b"h 0\r\nwrap_min:-42333 wrap_max:2333\r\nMOT>"),
        (b"h 1\r", b"h 1\r\nMOT>"),
        (b"a 0 180.00\r", b"a 0 180.00\r\nAngle = 180.00\r\nMOT>"),
        (b"a 1 45.00\r", b"a 1 45.00\r\nAngle = 45.00\r\nMOT>"),
        (b"a\r", b"a\r\nAngle[0] = 180.01\r\nAngle[1] = 45.02\r\nMOT>"),
    ),
    home_go_and_look,
    Look({"azimuth": 180.01, "elevation": 45.02}),
)
"""The record that tests/protocol/test_golden_g2.py plays to the dialect."""
STUBBORN = sim("g2?seed=1&second_move=queue&az_speed=10")


@pytest.fixture
def bench():
    return MachineBench(
        "g2",
        sim("g2?seed=1"),
        stops=(
            StopScene("retarget", (100.0, 20.0), 0.7),
            StopScene(
                "release", (140.0, 0.0), 0.5, confirmed=None, twin=STUBBORN,
                settings={"stop_releases_motors": True}, begin=(340.0, 45.0),
            ),
        ),
        console=ConsoleScene("a", "Angle[0]", "a 0 200", ends=("q", "q")),
        frail=sim("g2?seed=1&root_q=kill"),
        goldens=(MOVE,),
    )  # fmt: skip


class TestG2(Contract):
    pass
