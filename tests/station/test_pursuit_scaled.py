"""Everything of a pursuit is told in UTC, so that a clock that runs faster carries it along."""

from __future__ import annotations

import sys
from datetime import timedelta

import pytest
from birdcage.base.clock import VirtualClock
from birdcage.base.geometry import separation
from birdcage.station.pursuit_state import Phase

from .conftest import Bench
from .pursuit_bench import PARK, PursuitBench, at, plan_of


class FastClock(VirtualClock):
    """Virtual, and twenty seconds of UTC and mechanics in one of the wire's, as `ScaledClock`."""

    rate = 20.0

    def utc(self):
        return super().utc() + timedelta(seconds=(self.monotonic() - 1000.0) * (self.rate - 1.0))


@pytest.fixture
def bench(monkeypatch):
    monkeypatch.setattr(sys.modules[Bench.__module__], "VirtualClock", FastClock)
    return PursuitBench("g2?seed=1").connect()


def test_a_whole_pass_twenty_times_as_fast(bench):
    begun, start = bench.clock.monotonic(), at(bench) + 200.0
    bench.pursue(plan_of(start, lasts_s=300.0, az_rate=0.2, leave_s=start - 60.0), **PARK)
    bench.until(Phase.OVER, 60.0)
    assert bench.clock.monotonic() - begun < 30.0
    assert bench.phases == [
        Phase.WAITING, Phase.COUNTDOWN, Phase.PREPOSITIONING, Phase.READY, Phase.FOLLOWING, Phase.COUNTDOWN,
        Phase.PARKING, Phase.OVER,
    ]  # fmt: skip
    assert bench.pursuit.rms_error_deg < 0.3
    assert 200 < len(bench.samples) <= 310
    truth = bench.device.truth()
    assert separation(truth.az_deg, truth.el_deg, 180.0, 45.0) < 0.1
    assert bench.state.fault is None
