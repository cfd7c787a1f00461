"""What goes over the wire while a pass is followed."""

from __future__ import annotations

import pytest
from birdcage.base.geometry import separation
from birdcage.station.pursuit_state import Phase
from birdcage.station.requests import Goto, Watch
from birdcage.tracking.steps import Send

from .pursuit_bench import PARK, PursuitBench, at, g2, plan_of, travler


def test_the_position_is_read_once_a_second_and_every_reading_is_believed_at_once():
    bench = g2()
    start = at(bench) + 20.0
    # Not whole degrees a second: readings that differ by one digit are asked for twice.
    bench.pursue(plan_of(start, lasts_s=40.0, az_rate=3.7, high=60.0, leave_s=start - 19), **PARK)
    bench.until(Phase.FOLLOWING).step(2.0)
    since = bench.clock.monotonic()
    bench.step(35)
    reads = [line for when, line in bench.received() if when > since and line.strip() == "a"]
    sent = bench.moves_since(since)
    assert 33 <= len(reads) <= 36
    assert len(sent) > 100
    assert not any("360.00" in line or " -" in line for line in sent)
    assert bench.pursuit.rms_error_deg < 0.1


def test_the_signal_is_not_read_while_it_follows_nor_does_it_keep_the_console():
    bench = g2()
    bench.station.submit(Watch("test", frozenset({"position", "rssi"}), 1.0))
    bench.pursue(plan_of(at(bench) + 40.0), **PARK)
    bench.until(Phase.FOLLOWING).step(1.0)
    since = bench.clock.monotonic()
    bench.step(20)
    assert not [line for when, line in bench.received() if when > since and not line.startswith("a")]
    assert bench.pursuit.max_error_deg < 0.3


def test_across_north_the_wire_gets_angles_on_the_circle():
    bench = g2()
    start = at(bench) + 30.0
    bench.do(Goto(350, 40, "you"))
    bench.pursue(plan_of(start, lasts_s=40.0, from_az=350.0, az_rate=0.5), **PARK)
    bench.until(Phase.OVER)
    azimuths = [float(line.split()[2]) for line in bench.lines() if line.startswith("a 0 ")]
    assert all(0.0 <= az < 360.0 for az in azimuths)
    assert any(az < 10.0 for az in azimuths)
    assert bench.pursuit.rms_error_deg < 0.1
    assert bench.state.fault is None


def test_requests_are_served_while_it_follows():
    """Also on a slow line, where one command follows the other without a pause."""
    bench = PursuitBench("g2?seed=1&latency_min=0.08&latency_max=0.12").connect()
    bench.pursue(plan_of(at(bench) + 20.0, az_rate=6.0, lasts_s=30.0, leave_s=at(bench)), **PARK)
    bench.until(Phase.FOLLOWING).step(5.0)
    future = bench.station.submit(Watch("late", frozenset({"position"}), 1.0))
    bench.step(0.5)
    assert future.done()


def test_a_dish_whose_moves_queue_gets_one_command_at_a_time():
    bench = travler()
    start = at(bench) + 60.0
    bench.pursue(plan_of(start, lasts_s=60.0, az_rate=0.2, leave_s=start - 50.0), **PARK)
    bench.until(Phase.FOLLOWING).step(3.0)
    backlog = []
    for _ in range(500):
        bench.step(0.1)
        backlog.append(len(bench.device.board.lanes[0]._waiting))
    # One waits at most; a second may overlap with it by the latency of a command, a tenth of a second.
    assert max(backlog) <= 2
    assert not any(backlog[k : k + 3] == [2, 2, 2] for k in range(len(backlog)))
    assert bench.pursuit.rms_error_deg < 0.3
    since = bench.clock.monotonic()
    assert not [line for when, line in bench.received() if when > since - 45 and line.startswith("g ")]
    bench.until(Phase.OVER)
    truth = bench.device.truth()
    assert separation(truth.az_deg, truth.el_deg, 180.0, 45.0) < 0.1
    assert bench.state.fault is None


@pytest.mark.parametrize("rate", [4.0, 12.0])
def test_stop_always_knows_where_to_aim(rate):
    """Whenever STOP comes in a stream, the dish rests ahead of itself and near."""
    for extra in (0.0, 0.13, 0.31, 0.57):
        bench = g2()
        start = at(bench) + 10.0
        bench.pursue(plan_of(start, lasts_s=20.0, az_rate=rate, low=40, high=45, leave_s=start - 9.0))
        bench.until(Phase.FOLLOWING).step(4.0 + extra)
        before = bench.device.truth()
        bench.station.stop("you")
        bench.step(5)
        after = bench.device.truth()
        assert not after.moving
        # A stream turns an axis back now and then, by less than a tenth: ahead of itself is behind it then.
        assert -0.1 <= after.az_deg - before.az_deg < 0.5 * rate
        assert bench.state.last_stop.confirmed is True


def test_however_eager_a_controller_is_nothing_piles_up_on_a_dish_whose_moves_queue(monkeypatch):
    def eager(guide):
        now = guide.now_s
        while now < guide.until_s:
            az_deg, el_deg = guide.course().at(now + 1.0)
            now = (yield Send(0, az_deg)).now_s
            now = (yield Send(1, el_deg)).now_s

    monkeypatch.setattr("birdcage.tracking.steering.choice.controller_for", lambda *_args, **_more: ("eager", eager))
    bench = travler()
    start = at(bench) + 40.0
    bench.pursue(plan_of(start, lasts_s=30.0, az_rate=0.5, leave_s=start - 30.0))
    bench.until(Phase.FOLLOWING).step(2.0)
    backlog = []
    while bench.pursuit.phase is Phase.FOLLOWING:
        bench.step(0.05)
        backlog.append(len(bench.device.board.lanes[0]._waiting))
    # One waits at most; a second may overlap with it by the latency of a command, a tenth of a second.
    assert max(backlog) <= 2
    assert not any(backlog[k : k + 3] == [2, 2, 2] for k in range(len(backlog)))
