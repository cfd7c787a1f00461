"""Control for a while: it ends by itself, and asking again begins anew."""

from __future__ import annotations

from datetime import timedelta

import pytest
from birdcage.base.errors import LeaseDenied
from birdcage.station.events import LeaseChanged
from birdcage.station.requests import AcquireLease, Goto, ReleaseLease


def test_it_ends_by_itself_and_is_told(bench):
    bench.do(AcquireLease("you", take_over=True, for_s=900.0))
    assert abs(bench.state.holder_until - bench.clock.utc() - timedelta(seconds=900)) < timedelta(seconds=1)
    with pytest.raises(LeaseDenied):
        bench.do(Goto(190.0, 40.0, "client"))
    bench.step(895.0)
    assert bench.state.holder == "you"
    bench.step(6.0)
    assert bench.state.holder is None
    assert bench.state.holder_until is None
    last = [each for each in bench.events if isinstance(each, LeaseChanged)][-1]
    assert (last.holder, last.previous) == (None, "you")
    bench.do(Goto(190.0, 40.0, "client"), 60.0)


def test_asking_again_begins_anew_and_without_a_time_it_lasts(bench):
    bench.do(AcquireLease("you", for_s=60.0))
    bench.step(50.0)
    bench.do(AcquireLease("you", for_s=60.0))
    bench.step(50.0)
    assert bench.state.holder == "you"
    bench.do(AcquireLease("you"))
    bench.step(300.0)
    assert bench.state.holder == "you"
    assert bench.state.holder_until is None


def test_given_back_or_stopped_earlier_the_time_ends_nobody_elses_control(bench):
    bench.do(AcquireLease("you", for_s=60.0))
    bench.do(ReleaseLease("you"))
    bench.do(AcquireLease("map"))
    bench.step(120.0)
    assert bench.state.holder == "map"


def test_a_motion_under_way_at_its_end_goes_on(bench):
    bench.do(AcquireLease("you", for_s=1.0))
    going = bench.station.submit(Goto(100.0, 40.0, "you"))
    bench.step(60.0)
    assert going.exception(0) is None
    assert abs(bench.state.position.az_deg - 100.0) < 0.2
