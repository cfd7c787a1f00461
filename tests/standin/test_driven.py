"""The station drives a dish that it has never met."""

from __future__ import annotations

import pytest
from birdcage.station.requests import Goto

from .bench import Bench


def test_it_points_a_dish_that_shares_no_code_with_our_simulator():
    bench = Bench().connect()
    bench.do(Goto(200.0, 30.0, "you"))
    bench.step(1.0)
    assert bench.dish.where() == (pytest.approx(200.0), pytest.approx(30.0))
    assert bench.dish.root_q == 0
    position = bench.state.position
    assert (position.az_deg, position.el_deg) == (pytest.approx(200.0), pytest.approx(30.0))
