"""The contract, kept by the Pathway X1: what it answers is open, so it keeps it whatever that is."""

from __future__ import annotations

import pytest
from birdcage.testing import ConsoleScene, Contract, MachineBench, StopScene

from .simulated import sim

TELLS, SILENT = "bare_a=angles", "bare_a=nothing&move_reply=none"


@pytest.fixture(params=["bare_a=error", TELLS, SILENT])
def bench(request):
    stop = StopScene("none", (100.0, 20.0), 0.7, reaches_target=True)
    if request.param == TELLS:
        stop = StopScene("retarget", (100.0, 20.0), 0.7)
    return MachineBench(
        "pathway-x1",
        sim(f"pathway-x1?seed=1&{request.param}"),
        stops=(stop,),
        console=ConsoleScene("?", "a <motor> <angle>", "a 0 200", ends=("q", "q")),
        frail=sim("pathway-x1?seed=1&root_q=kill"),
    )


class TestPathwayX1(Contract):
    pass
