"""A pass is followed through lost answers; where moves queue, they are waited for in full."""

from __future__ import annotations

from itertools import pairwise

import pytest
from birdcage.sim.wire import DROP, PASS
from birdcage.station.pursuit import Phase
from birdcage.station.requests import Stop

from .pursuit_bench import PARK, at, g2, plan_of, travler


def lose_answers(bench, one_in, *, whole=True):
    """Lose every so many answers: whole, or their prompts."""
    seen = [0]

    def fate(value):
        lost = seen[0] % one_in == one_in - 1 and (whole or chr(value) in "MOT>")
        seen[0] += value == ord(">")
        return DROP if lost else PASS

    bench.device.wire.to_host.set_plan(fate)


@pytest.mark.parametrize("whole", [True, False])
def test_a_lost_answer_holds_up_a_stream_for_a_moment_only(whole):
    bench = g2()
    start = at(bench) + 20.0
    bench.pursue(plan_of(start, lasts_s=60.0, az_rate=2.0, leave_s=start - 19), **PARK)
    bench.until(Phase.FOLLOWING).step(2.0)
    lose_answers(bench, 25, whole=whole)
    since = bench.clock.monotonic()
    bench.step(50)
    sent = [when for when, line in bench.received() if when > since and line.startswith("a ")]
    assert max(b - a for a, b in pairwise(sent)) < 0.7
    reads = [when for when, line in bench.received() if when > since and line.strip() == "a"]
    assert len(reads) > 35
    assert bench.pursuit.max_error_deg < 0.6
    assert bench.pursuit.phase is Phase.FOLLOWING
    assert bench.state.fault is None


def test_stop_is_confirmed_in_a_stream_whose_answers_get_lost():
    bench = g2()
    start = at(bench) + 20.0
    bench.pursue(plan_of(start, lasts_s=60.0, az_rate=2.0, leave_s=start - 19), **PARK)
    bench.until(Phase.FOLLOWING).step(2.0)
    bench.device.wire.to_host.set_plan(lambda _value: DROP)
    bench.step(0.3)
    bench.device.wire.to_host.set_plan(None)
    future = bench.station.submit(Stop("you"))
    bench.step(2.0)
    assert future.done()
    assert future.exception() is None
    assert not bench.device.truth().moving
    assert bench.pursuit.phase is Phase.OVER


def test_a_dish_that_no_longer_answers_interrupts_it():
    bench = g2()
    start = at(bench) + 20.0
    bench.pursue(plan_of(start, lasts_s=120.0, az_rate=1.0, leave_s=start - 19), **PARK)
    bench.until(Phase.FOLLOWING).step(2.0)
    bench.device.wire.to_host.set_plan(lambda _value: DROP)
    bench.step(60.0)
    assert bench.pursuit.phase is Phase.INTERRUPTED


def test_where_moves_queue_a_lost_answer_is_waited_for():
    bench = travler()
    start = at(bench) + 60.0
    bench.pursue(plan_of(start, lasts_s=120.0, from_az=180.0, az_rate=0.5, leave_s=start - 59), **PARK)
    bench.until(Phase.FOLLOWING).step(5.0)
    bench.device.wire.to_host.set_plan(lambda _value: DROP)
    count, end = len(bench.moves_since(0.0)), bench.clock.monotonic() + 10.0
    while len(bench.moves_since(0.0)) == count and bench.clock.monotonic() < end:
        bench.step(0.02)
    lost_at = bench.clock.monotonic()
    assert len(bench.moves_since(0.0)) == count + 1
    bench.device.wire.to_host.set_plan(None)
    bench.step(60.0)
    after = [when for when, _line in bench.received() if when > lost_at]
    assert after[0] - lost_at > 1.9
