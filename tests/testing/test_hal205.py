"""The contract, kept by the Trav'ler."""

from __future__ import annotations

import pytest
from birdcage.testing import Bench, ConsoleScene, Contract, StopScene

from .simulated import sim


@pytest.fixture
def bench():
    return Bench(
        "hal205",
        sim("hal205?seed=1"),
        stops=(
            StopScene("abort", (60.0, 15.0), 2.0),
            StopScene("end of move", (4.0, 0.0), 0.8, reaches_target=True),
        ),
        console=ConsoleScene("a", "AZ", "a 0 200", ends=("q", "q")),
        frail=sim("hal205?seed=1&root_q=kill"),
        ready_s=60.0,
        follows_deg=0.3,
    )


class TestHal205(Contract):
    pass
