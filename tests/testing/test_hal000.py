"""The contract, kept by the older Trav'ler."""

from __future__ import annotations

import pytest
from birdcage.rotator.values import Look
from birdcage.testing import ConsoleScene, Contract, Golden, MachineBench, StopScene

from .simulated import sim


def look(rotator):
    rotator.make_ready()
    return rotator.look()


LOOK = Golden(
    "T-HAL000",
    (
        (b"\r", b"\r\n>"),
        (b"\r", b"\r\n>"),
        (b"?\r", b"?\r\nmot\r\nnvs\r\nos\r\nstow\r\nreboot\r\nq\r\n>"),
        (b"mot\r", b"mot\r\nMOT>"),
        (b"\r", b"\r\nMOT>"),
        (b"?\r", b"?\r\na\r\ng\r\nq\r\nMOT>"),
        (b"?\r", b"?\r\na\r\ng\r\nq\r\nMOT>"),
        (b"a\r", b"a\r\nAZ =   8.34\r\nEL =  34.33\r\nSK =   0.00\r\n<wrap info>\r\nMOT>"),
    ),
    look,
    Look({"azimuth": 8.34, "elevation": 34.33, "skew": 0.0}),
)
"""The answers as docs/reference/travler-older.md has them; its prompts are one of the ways in which they may look."""


@pytest.fixture
def bench():
    return MachineBench(
        "hal000",
        sim("hal000?seed=1"),
        stops=(
            StopScene("abort", (60.0, 15.0), 2.0),
            StopScene("end of move", (4.0, 0.0), 0.8, reaches_target=True),
        ),
        console=ConsoleScene("a", "AZ", "a 0 200", ends=("q", "q")),
        frail=sim("hal000?seed=1&root_q=kill"),
        goldens=(LOOK,),
        ready_s=60.0,
        follows_deg=0.3,
    )


class TestHal000(Contract):
    pass
