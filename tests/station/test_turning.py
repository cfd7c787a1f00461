"""Which way round the azimuth goes is told before it moves, and it goes that way; or both ways are told."""

from __future__ import annotations

import random

import pytest
from birdcage.station.requests import Goto, Home
from birdcage.station.turning import way_to

from .conftest import Bench

CHOICES = ("nearest", "home")
"""How a G2 may choose among the turns of its cable: no source says."""


def went(bench, az_deg):
    """Tell the way to an azimuth, go there, and return both: what was told, and how far the cable has turned."""
    told, before = way_to(bench.state, az_deg), bench.device.truth().cable_deg
    bench.do(Goto(az_deg, 45, "you"))
    return told, bench.device.truth().cable_deg - before


@pytest.mark.parametrize("choice", CHOICES)
def test_with_an_unknown_turn_it_goes_as_told_or_one_of_both_ways(choice):
    rng, sure = random.Random(11), 0
    for _ in range(6):
        bench = Bench(f"g2?seed=1&az_map={choice}&az={rng.uniform(-359, -1):.2f}").connect()
        for _ in range(6):
            told, turned = went(bench, round(rng.uniform(0, 359.9), 2))
            ways = [way for way in (told.deg, told.other_deg) if way is not None]
            assert min(abs(turned - way) for way in ways) < 0.2, (told, turned)
            sure += len(ways) == 1
    assert sure > 6, "a way that is safe for every turn is told as one"


def test_said_clockwise_and_gone_the_other_way_is_no_more():
    """The case that was seen: at 350 of a cable that stands at its end, 170 degrees on lie beyond the stop."""
    bench = Bench("g2?seed=1&az=-10").connect()
    told, turned = went(bench, 160.0)
    assert turned == pytest.approx(-190.0, abs=0.2)
    assert told.deg == pytest.approx(170.0, abs=0.2)
    assert told.other_deg == pytest.approx(-190.0, abs=0.2)


def test_the_way_under_way_is_told_as_soon_as_readings_tell_it():
    bench = Bench("g2?seed=1&az=-10").connect()
    bench.station.submit(Goto(160.0, 45, "you"))
    seen = []
    for _ in range(60):
        bench.step(0.02)
        motion = bench.state.motion
        if motion is not None:
            seen.append(motion.az_way_deg)
    assert seen[0] is None
    assert seen[-1] == pytest.approx(-190.0, abs=0.2)


def test_a_counted_cable_tells_one_way():
    bench = Bench("g2?seed=1&az=-10").connect()
    bench.do(Home("you"), 60)
    for az_deg in (160.0, 350.0, 10.0, 300.0):
        told, turned = went(bench, az_deg)
        assert told.other_deg is None
        assert turned == pytest.approx(told.deg, abs=0.2)
