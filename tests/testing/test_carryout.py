"""The contract, kept by the Carryout of 2003: a dish that does not tell its position."""

from __future__ import annotations

import pytest
from birdcage.testing import ConsoleScene, Contract, MachineBench, StopScene

from .simulated import sim


@pytest.fixture(params=["", "&prompt_when=at_once", "&second_move=abort"])
def bench(request):
    return MachineBench(
        "carryout",
        sim(f"carryout?seed=1{request.param}"),
        stops=(StopScene("none", (100.0, 20.0), 2.0, reaches_target="abort" not in request.param),),
        console=ConsoleScene("?", "g <az> <el>", "g 100 40"),
    )


class TestCarryout(Contract):
    pass
