"""A dish that does not tell where it rests: its first way, no-go sectors, and what a step of the clock leaves of it."""

from __future__ import annotations

import pytest
from birdcage.base.config import MotionSettings, Settings
from birdcage.base.errors import MotionRefused, Stopped
from birdcage.base.no_go import NoGoSector
from birdcage.station.requests import ApplySettings, Goto, Release
from birdcage.station.state import Activity

from .conftest import Bench
from .pursuit_bench import PursuitBench, at, plan_of

QUEUES = "carryout?seed=1&second_move=queue"
MAST = NoGoSector(90.0, 100.0, 60.0, "mast")


def met(*, sectors=()):
    return PursuitBench(QUEUES, {"sectors": sectors}, "carryout").connect(8.0)


def moves(bench):
    return [line for line in bench.lines() if line.startswith("g")]


def test_a_first_way_is_given_the_time_of_the_longest_there_is():
    bench = Bench(f"{QUEUES}&record=moving", firmware="carryout").connect(8.0)  # it stands at 180°/45° already
    began, future = bench.clock.monotonic(), bench.station.submit(Goto(180, 45, "you"))
    while not future.done():
        bench.step(0.5)
    speed_deg_s = bench.state.dish.azimuth.speed_deg_s
    assert bench.clock.monotonic() - began > 180.0 / speed_deg_s + (73.0 - 45.0) / speed_deg_s


@pytest.mark.parametrize("target", [(180, 45), (120, 70), (95, 30)])
def test_with_a_no_go_sector_a_way_from_nowhere_known_is_refused_and_nothing_is_sent(target):
    bench = met(sectors=(MAST,))
    with pytest.raises(MotionRefused, match=r"may pass through a no-go sector\. Nothing was sent") as refused:
        bench.do(Goto(*target, "you"), 200)
    assert refused.value.reason == "sector"
    assert moves(bench) == []


def test_known_by_its_move_it_is_judged_by_its_way_and_after_stop_it_is_sent_nowhere():
    bench = met()
    bench.do(Goto(180, 45, "you"), 200)
    bench.do(ApplySettings(Settings(motion=MotionSettings(no_go_sectors=(MAST,))), "you"))
    with pytest.raises(MotionRefused, match="no-go sector from azimuth 90° to 100° below 60°"):
        bench.do(Goto(50, 45, "you"))
    bench.do(Goto(200, 45, "you"), 200)
    bench.station.submit(Goto(110, 45, "you"))
    bench.step(1)
    bench.station.stop("you")
    bench.step(90)
    bench.do(Release("you"))
    before = moves(bench)
    with pytest.raises(MotionRefused, match="may pass through a no-go sector"):
        bench.do(Goto(200, 45, "you"))
    assert moves(bench) == before


@pytest.mark.parametrize("seconds", [-60.0, 3.0, 3600.0])
@pytest.mark.parametrize("when", ["at rest", "under way", "on its first way", "in a pass"])
def test_a_step_of_the_clock_leaves_no_position(seconds, when):
    bench, future = met(), None
    if when != "on its first way":
        bench.do(Goto(180, 45, "you"), 200)
    if when in ("under way", "on its first way"):
        future = bench.station.submit(Goto(20, 70, "you"))
        bench.step(2)
    if when == "in a pass":
        bench.pursue(plan_of(at(bench) + 60.0, from_az=170.0, lasts_s=200.0, az_rate=0.2))
        bench.step(90)
    bench.clock.step_utc(seconds)
    bench.step(60)
    assert "clock step" in bench.state.held.detail
    assert (bench.state.position, bench.state.position_lost) == (None, "untold")
    assert bench.state.activity is Activity.IDLE
    if future is not None:
        assert isinstance(future.exception(0), Stopped)
    before = moves(bench)
    bench.step(60)
    assert moves(bench) == before
