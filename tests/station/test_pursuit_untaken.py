"""A pursuit with a dish that answers its commands with nothing known."""

from __future__ import annotations

from birdcage.station.pursuit_state import Phase

from .pursuit_bench import PARK, PursuitBench, at, plan_of
from .test_untaken import refuse


def following(address="g2?seed=1"):
    bench = PursuitBench(address).connect()
    bench.pursue(plan_of(at(bench) + 30.0), **PARK)
    return bench.until(Phase.FOLLOWING)


def test_it_ends_where_the_dish_does_not_move_and_that_is_no_fault():
    bench = following()
    bench.step(5.0)
    refuse(bench, (0, 1), "Invalid parameter.\n")
    bench.step(6.0)
    assert bench.pursuit.phase is Phase.OVER
    assert bench.pursuit.why == "The dish answers 'Invalid parameter.' to its commands, and does not move."
    assert bench.state.fault is None
    assert bench.state.held is None


def test_it_goes_on_where_the_dish_follows():
    bench = following("g2?seed=1&move_reply=none")
    bench.step(30.0)
    assert bench.pursuit.phase is Phase.FOLLOWING
    assert bench.pursuit.rms_error_deg < 0.1
