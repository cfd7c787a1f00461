"""The contract, kept by the Pathway X2: instant, and as late as it was seen to be."""

from __future__ import annotations

import pytest
from birdcage.testing import ConsoleScene, Contract, Golden, MachineBench, StopScene

from .simulated import sim


def go_both(rotator):
    rotator.make_ready()
    taken = rotator.send({"azimuth": 170.0}), rotator.send({"elevation": 45.0})
    return [(each.sure, each.said) for each in taken]


GO = Golden(
    "T-X2",
    (
        (b"\r\n", b"\r\nMOT>"),
        (b"\r\n", b"\r\nMOT>"),
        (b"a 0 170.00\r\n", b"a 0 170.00\r\nm 0  a 17000  np 111714\r\nMOT>"),
        (b"\r\n", b"\r\nMOT>"),
        (b"\r\n", b"\r\nMOT>"),
        (b"a 1 45.00\r\n", b"a 1 45.00\r\nm 1  a 4500  np 29571\r\nMOT>"),
        (b"\r\n", b"\r\nMOT>"),
    ),
    go_both,
    [(True, "m 0  a 17000  np 111714"), (True, "m 1  a 4500  np 29571")],
)
"""Tokens as docs/reference/g2-kin.md has them, *Conversations*; lines around them are assumed."""
LATE = "lag_min_s=1.5&lag_max_s=1.5&az_speed=10"


@pytest.fixture(params=["lag_max_s=0", "lag_max_s=0&lf_after_cr=line", LATE, f"{LATE}&lag_ack=at_once"])
def bench(request):
    late = LATE in request.param
    return MachineBench(
        "pathway-x2",
        sim(f"pathway-x2?seed=1&{request.param}"),
        stops=(StopScene("none", (100.0, 20.0), 3.5 if late else 0.7, reaches_target=True),),
        console=ConsoleScene("?", "a <motor> <angle>", "a 0 200", ends=("q", "q")),
        frail=sim("pathway-x2?seed=1&lag_max_s=0&root_q=kill"),
        goldens=(GO,),
        follows_deg=2.5,  # a step takes half a minute: what lies between two of them is foreseen only so well
    )


class TestPathwayX2(Contract):
    pass
