"""STOP of a dish that loses what comes too fast: it goes out at once, and again until the dish has heard it."""

from __future__ import annotations

import pytest
from birdcage.station.requests import Goto
from birdcage.station.state import Activity, LinkPhase

from .conftest import Bench


@pytest.fixture
def bench():
    bench = Bench("pro?seed=1&search_finds=0", {}, firmware="pro")
    bench.connect(40.0)
    assert bench.state.link.state is LinkPhase.UP
    return bench


@pytest.mark.parametrize("wait_s", [0.05, 0.12, 0.3, 1.0, 4.0])
@pytest.mark.parametrize("gap_s", ["0.15", "0.9"])
def test_however_soon_it_follows_the_move_the_dish_comes_to_rest(bench, wait_s, gap_s):
    object.__setattr__(bench.device.settings, "motor_gap_s", float(gap_s))
    bench.station.submit(Goto(330, 60, "you"))
    for _ in range(200):
        if bench.device.truth().moving:
            break
        bench.step(0.05)
    bench.step(wait_s)
    bench.station.stop("you")
    bench.step(8.0)
    truth = bench.device.truth()
    assert not truth.moving
    assert truth.az_deg < 325.0, "it was stopped, and did not arrive"
    assert bench.state.held is not None
    report = bench.state.last_stop
    assert (report.means, report.confirmed) == ("abort", gap_s == "0.15"), "faster than the dish, no reading comes"
    assert bench.state.activity is Activity.IDLE
