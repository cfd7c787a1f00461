"""A move names the axes that change, and no others: the rest of the dish is not told again where it stands."""

from __future__ import annotations

import pytest
from birdcage.station.requests import Goto, Jog, Release

from .conftest import Bench


@pytest.fixture
def bench():
    bench = Bench("g2?seed=1").connect()
    bench.do(Goto(100, 40, "you"))
    return bench


def moves_of(bench, request):
    """The moves that a request sends until it is done."""
    since = bench.clock.monotonic()
    bench.do(request)
    return bench.moves_since(since)


def test_a_jog_names_the_axis_that_it_steps(bench):
    assert [line for line in moves_of(bench, Jog(5.0, 0.0, "you")) if line != "a"] == ["a 0 105.00"]
    assert moves_of(bench, Jog(0.0, 2.0, "you"))[-1:] == ["a 1 42.00"]
    bench.step(2)
    assert bench.state.position.az_deg == pytest.approx(105.0, abs=0.1)
    assert bench.state.position.el_deg == pytest.approx(42.0, abs=0.1)


def test_ten_quick_jogs_are_ten_steps_of_one_axis(bench):
    since = bench.clock.monotonic()
    for _ in range(10):
        future = bench.station.submit(Jog(1.0, 0.0, "you"))
        bench.step(0.05)
    while not future.done():
        bench.step(0.1)
    assert {line.split()[1] for line in bench.moves_since(since) if line.startswith("a ")} == {"0"}
    assert bench.state.position.az_deg == pytest.approx(110.0, abs=0.1)


def test_after_stop_both_axes_are_named(bench):
    bench.station.submit(Goto(250, 60, "you"))
    bench.step(0.6)
    bench.station.stop("you")
    bench.step(3)
    bench.do(Release("you"))
    here = bench.state.position
    since = bench.clock.monotonic()
    bench.do(Goto(here.az_deg + 20.0, 60.0, "you"))
    assert {line.split()[1] for line in bench.moves_since(since) if line.startswith("a ")} == {"0", "1"}


def test_an_axis_that_somebody_has_moved_is_named_again(bench):
    bench.sim.write(b"a 1 43\r")
    bench.step(6)
    assert "a 1 40.00" in moves_of(bench, Goto(120, 40, "you", take_over=True))
