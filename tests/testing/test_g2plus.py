"""The contract, kept by the Carryout G2+: whether it tells its position only the first look shows."""

from __future__ import annotations

import pytest
from birdcage.rotator.verdict import Grade
from birdcage.testing import ConsoleScene, Contract, Golden, MachineBench, StopScene

from .simulated import sim


def home_both(rotator):
    rotator.make_ready()
    typed = rotator.raw.type_line("h *", "mot", takes_s=30.0, confirmed=Grade.MOVES, permit=lambda: None)
    return typed.wait(30.0).lines


HOME = Golden(
    "T-G2PLUS-HOME",
    (
        (b"\r", b"\r\nTRK>"),
        (b"mot\r", b"mot\r\nMOT>"),
        (b"h *\r", b"h *\r\nAZ - Angle: 1 Wrap: 0\r\nMOT>"),
    ),
    home_both,
    ("AZ - Angle: 1 Wrap: 0",),
)


def go_both(rotator):
    rotator.make_ready()
    taken = rotator.send({"azimuth": 90.0}), rotator.send({"elevation": 45.0})
    return [each.sure for each in taken]


FOX = Golden(
    "T-FOX",
    (
        (b"\r", b"\r\nMOT>"),
        (b"a 0 90.00\r", b"a 0 90.00\r\nAngle = 90.00\r\nMOT>"),
        (b"a 1 45.00\r", b"a 1 45.00\r\nAngle = 45.00\r\nMOT>"),
    ),
    go_both,
    [True, True],
)
"""Tokens as docs/reference/g2-kin.md has them, *Conversations*; lines around them are assumed."""
CONSOLE = ConsoleScene("?", "a <motor> <angle>", "a 0 200", ends=("q", "q"))


@pytest.fixture(params=["angles", "error", "nothing", "target"])
def bench(request):
    tells = request.param == "angles"
    still = StopScene("retarget", (100.0, 20.0), 0.7) if tells else StopScene(
        "none", (100.0, 20.0), 0.7, reaches_target=True
    )  # fmt: skip
    return MachineBench(
        "g2plus",
        sim(f"g2plus?seed=1&bare_a={request.param}"),
        stops=(still,),
        console=CONSOLE,
        frail=sim("g2plus?seed=1&root_q=kill"),
        goldens=(HOME, FOX),
    )


class TestG2Plus(Contract):
    pass
