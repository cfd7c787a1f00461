"""The contract, kept by the Trav'ler Pro."""

from __future__ import annotations

import pytest
from birdcage.rotator.values import Look
from birdcage.testing import ConsoleScene, Contract, Golden, MachineBench, StopScene

from .simulated import sim


def look(rotator):
    rotator.make_ready()
    return rotator.look()


ODU = b"mot\r\nnvs\r\nos\r\nstow\r\nreboot\r\nq\r\n"
LOOK = Golden(
    "T-PRO",
    (
        (b"\r", b"\r\nIDU>"),
        (b"\r", b"\r\nIDU>"),
        (b"?\r", b"?\r\nodu\r\nq\r\nIDU>"),
        (b"odu\r", b"odu\r\nODU>"),
        (b"\r", b"\r\nODU>"),
        (b"?\r", b"?\r\n" + ODU + b"ODU>"),
        (b"mot\r", b"mot\r\nMOT>"),
        (b"\r", b"\r\nMOT>"),
        (b"?\r", b"?\r\na\r\ng\r\nq\r\nMOT>"),
        (b"?\r", b"?\r\na\r\ng\r\nq\r\nMOT>"),
        (b"a\r", b"a\r\nAZ = 180.00\r\nEL =  45.00\r\nSK =   0.00\r\nMOT>"),
    ),
    look,
    Look({"azimuth": 180.0, "elevation": 45.0, "skew": 0.0}),
)
"""The answers as docs/reference/travler-pro.md has them; its prompts are one of the ways in which they may look."""


@pytest.fixture
def bench():
    return MachineBench(
        "pro",
        sim("pro?seed=1&odu_gap_s=0.9&motor_gap_s=0.15"),
        stops=(
            StopScene("abort", (60.0, 15.0), 2.0),
            StopScene("end of move", (4.0, 0.0), 0.8, reaches_target=True),
        ),
        console=ConsoleScene("a", "AZ", "a 0 200", ends=("q", "q")),
        frail=sim("pro?seed=1&root_q=kill&odu_q=kill"),
        goldens=(LOOK,),
        ready_s=90.0,
        follows_deg=0.3,
    )


class TestPro(Contract):
    pass
