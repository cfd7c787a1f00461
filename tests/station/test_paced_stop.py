"""STOP of a dish that loses what comes too fast: it goes out at once, and again until the dish has heard it."""

from __future__ import annotations

from dataclasses import replace

import pytest
from birdcage.station.requests import Goto
from birdcage.station.state import Activity, LinkPhase, TvSearch
from birdcage.station.stop_words import stop_line

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


def test_what_was_written_of_its_kin_alone_is_not_promised(bench):
    bench.station.submit(Goto(330, 60, "you"))
    while bench.state.motion is None or not bench.device.truth().moving:
        bench.step(0.1)
    assert stop_line(bench.state, bench.clock.monotonic()).startswith("STOP should take")
    bench.station.stop("you")
    bench.step(0.05)
    assert bench.state.last_stop.sentence.startswith("A byte that should end the slew was sent.")


def test_nor_is_it_that_its_tv_search_ends():
    bench = Bench("pro?seed=1&search_finds=0&boot_home_s=20", {}, firmware="pro")
    bench.connect(40.0)
    bench.watch("position", rate_hz=1.0)
    bench.device.reboot()
    for _ in range(4000):
        bench.step(0.1)
        if bench.device.truth().moving and bench.state.activity is Activity.MOVING_UNASKED:
            break
    state = replace(bench.state, held=None, search=TvSearch.RUNNING)
    assert stop_line(state, bench.clock.monotonic()).startswith("STOP may not hold the dish.")
    bench.station.stop("you")
    bench.step(0.05)
    assert bench.state.last_stop.sentence.startswith(
        "A bare Enter was sent, and the line that may end a TV search follows."
    )
    bench.step(20.0)
    assert "whether it did is not known" in bench.state.last_stop.sentence
    assert not bench.device.truth().moving
