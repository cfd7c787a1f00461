"""A whole pass, from waiting to parked."""

from __future__ import annotations

from birdcage.base.geometry import separation
from birdcage.station.events import TaskChanged
from birdcage.station.pursuit_state import Phase
from birdcage.station.requests import EndPursuit, Pursue
from birdcage.station.state import Activity

from .pursuit_bench import PARK, at, g2, plan_of


def test_a_whole_pass_from_waiting_to_parked():
    bench = g2()
    changes = []
    bench.station.subscribe(changes.append, TaskChanged)
    start = at(bench) + 100.0
    assert bench.pursue(plan_of(start), **PARK) == 1
    assert bench.pursuit.phase is Phase.WAITING
    assert bench.state.holder is None, "a plan that waits leaves the dish to others"
    bench.until(Phase.FOLLOWING)
    assert bench.state.holder == "you"
    assert bench.state.activity is Activity.FOLLOWING
    bench.step(60)
    assert bench.state.motion is not None
    assert bench.state.motion.stop_means == "retarget"
    assert bench.clock.monotonic() - bench.state.position.at < 1.5
    bench.until(Phase.OVER)
    assert bench.phases == [
        Phase.WAITING, Phase.COUNTDOWN, Phase.PREPOSITIONING, Phase.READY, Phase.FOLLOWING, Phase.COUNTDOWN,
        Phase.PARKING, Phase.OVER,
    ]  # fmt: skip
    truth = bench.device.truth()
    assert separation(truth.az_deg, truth.el_deg, 180.0, 45.0) < 0.1
    assert bench.state.holder is None
    assert bench.state.activity is Activity.IDLE
    assert bench.pursuit.rms_error_deg < 0.1
    assert bench.pursuit.max_error_deg < 0.3
    assert 100 < len(bench.samples) < 130
    assert len(changes) < 30, "of each stage, not of each command"
    assert bench.state.fault is None


def test_a_better_plan_for_a_pursuit_that_is_over_begins_nothing():
    bench = g2()
    plan = plan_of(at(bench) + 30.0)
    number = bench.pursue(plan, **PARK)
    bench.until(Phase.FOLLOWING).step(2)
    bench.do(EndPursuit("you"))
    bench.step(3)
    since = bench.clock.monotonic()
    assert bench.do(Pursue(plan, "you", renews=number)) == number
    bench.step(20)
    assert bench.pursuit.phase is Phase.OVER
    assert bench.moves_since(since) == []


def test_steering_without_readings_says_so_and_reads_nothing():
    bench = g2()
    bench.pursue(plan_of(at(bench) + 30.0), controller="modelled", **PARK)
    bench.until(Phase.FOLLOWING).step(2)
    assert bench.pursuit.controller == "modelled"
    assert "The dish does not tell where it rests" in bench.pursuit.why
    since = bench.clock.monotonic()
    bench.step(20)
    assert not [line for when, line in bench.received() if when > since and line.strip() == "a"]
    assert len(bench.moves_since(since)) > 20
