"""A modelled position says within how many degrees it should hold: where the dish really is lies within that."""

from __future__ import annotations

import pytest
from birdcage.base.geometry import shortest_turn
from birdcage.station.report import status_report
from birdcage.station.requests import Goto

from .conftest import Bench

SLEWS = [("hal205?seed=1", "hal205"), ("hal205?seed=7", "hal205"), ("hal205?seed=3&latency_max=0.1", "hal205")]
UNTOLD = [
    ("carryout?seed=1&record=nothing", "carryout"),
    ("carryout?seed=1&record=nothing&speed=6", "carryout"),
    ("carryout?seed=1&record=nothing&speed=60&accel=80", "carryout"),
]


def off_deg(bench):
    here, truth = bench.state.position, bench.device.truth()
    return max(abs(shortest_turn(here.dish_az_deg, truth.az_deg)), abs(here.dish_el_deg - truth.el_deg))


@pytest.mark.parametrize(("address", "firmware"), SLEWS + UNTOLD)
def test_the_dish_is_within_it_all_along(address, firmware):
    bench = Bench(address, firmware=firmware).connect(8.0)
    bench.do(Goto(120, 40, "you"), 200)
    future, modelled = bench.station.submit(Goto(250, 60, "you")), 0
    while not future.done():
        bench.step(0.1)
        here = bench.state.position
        if here.modelled:
            modelled += 1
            assert off_deg(bench) <= here.uncertainty_deg, bench.clock.monotonic()
        else:
            assert here.uncertainty_deg is None
    assert modelled > 20


@pytest.mark.parametrize(("address", "firmware"), UNTOLD)
def test_at_rest_it_is_no_more_than_how_an_axis_comes_to_rest(address, firmware):
    bench = Bench(address, firmware=firmware).connect(8.0)
    bench.do(Goto(120, 40, "you"), 200)
    told = status_report(bench.state, bench.clock.monotonic())
    assert off_deg(bench) <= told["uncertainty_deg"] <= 0.2


def test_what_is_read_has_none():
    bench = Bench().connect()
    assert status_report(bench.state, bench.clock.monotonic())["uncertainty_deg"] is None
