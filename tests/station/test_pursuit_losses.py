"""A pass is followed through lost answers; where moves queue, they are waited for in full."""

from __future__ import annotations

from itertools import pairwise

import pytest
from birdcage.sim.wire import DROP, PASS
from birdcage.station.pursuit_state import Phase
from birdcage.station.requests import Goto, Stop

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


def following_travler(*, seconds=5.0, **plan):
    bench = travler()
    start = at(bench) + 60.0
    plan = {"lasts_s": 120.0, "from_az": 180.0, "az_rate": 0.5, "leave_s": start - 59, **plan}
    bench.pursue(plan_of(start, **plan), **PARK)
    bench.until(Phase.FOLLOWING).step(seconds)
    return bench


def is_move(line):
    """Whether it moves the dish: of one axis, or combined."""
    return line.startswith(("a ", "g "))


def errors_since(bench, time):
    return [sample.error_deg for sample in bench.samples if sample.at > time]


def went_on_from(bench, lost_at):
    """Return what went out after a loss, having seen that it was looked at twice before the next move, and went on."""
    after = [(when, line) for when, line in bench.received() if when > lost_at]
    first = next(index for index, (_when, line) in enumerate(after) if is_move(line))
    reads = [when for when, line in after[:first] if line == "a"]
    assert any(b - a > 0.25 for a, b in pairwise(reads)), "it was not seen at rest before the next move"
    assert bench.state.fault is None
    assert bench.state.held is None
    assert bench.phases[-1] is Phase.FOLLOWING
    assert Phase.INTERRUPTED not in bench.phases
    assert bench.pursuit.phase is Phase.FOLLOWING
    assert bench.samples[-1].at > bench.clock.monotonic() - 3.0
    return after


def test_where_moves_queue_a_lost_answer_is_waited_for():
    bench = following_travler()
    bench.device.wire.to_host.set_plan(lambda _value: DROP)
    count, end = len(bench.moves_since(0.0)), bench.clock.monotonic() + 10.0
    while len(bench.moves_since(0.0)) == count and bench.clock.monotonic() < end:
        bench.step(0.02)
    lost_at = bench.clock.monotonic()
    assert len(bench.moves_since(0.0)) == count + 1
    bench.device.wire.to_host.set_plan(None)
    bench.step(60.0)
    after = went_on_from(bench, lost_at)
    assert after[0][0] - lost_at > 1.9
    assert max(errors_since(bench, lost_at + 30.0)) < 0.2, "it does not come back to its target"


@pytest.mark.parametrize("whole", [True, False])
@pytest.mark.parametrize("nth", range(4, 8))
def test_where_moves_queue_one_lost_answer_ends_nothing(nth, whole):
    """Be it that of an azimuth, of an elevation or of a reading."""
    bench = following_travler()
    seen = [0]

    def fate(value):
        lost = seen[0] == nth and (whole or value == ord(">"))
        seen[0] += value == ord(">")
        return DROP if lost else PASS

    lost_at = bench.clock.monotonic()
    bench.device.wire.to_host.set_plan(fate)
    bench.step(60.0)
    sent = [when for when, line in bench.received() if when > lost_at]
    assert max(b - a for a, b in pairwise(sent)) > 1.9, "nothing was lost"
    assert bench.state.fault is None
    assert bench.phases[-1] is Phase.FOLLOWING
    assert len(errors_since(bench, lost_at + 50.0)) > 5
    assert max(errors_since(bench, lost_at + 50.0)) < 0.2, "it does not come back to its target"


def test_where_moves_queue_a_command_that_never_came_is_given_up():
    bench = following_travler()
    wire = bench.device.wire
    before, end = bench.clock.monotonic(), bench.clock.monotonic() + 10.0
    eaten = bytearray()

    def fate(value):
        """Lose one whole line."""
        if eaten.endswith(b"\r"):
            return PASS
        if eaten or value == ord("a"):
            eaten.append(value)
            return DROP
        return PASS

    wire.to_dish.set_plan(fate)
    while not eaten.endswith(b"\r") and bench.clock.monotonic() < end:
        bench.step(0.02)
    assert is_move(eaten.decode())
    stood = bench.device.truth()
    bench.step(60.0)
    went_on_from(bench, before)
    now = bench.device.truth()
    assert (now.az_deg, now.el_deg) != (stood.az_deg, stood.el_deg)


def test_where_moves_queue_a_slew_may_follow_long_after_the_last_command():
    """Of an axis that stands for long, and of one that moves: neither is taken for a dish that has gone astray."""
    bench = following_travler(seconds=35.0, lasts_s=100.0, az_rate=0.0)
    assert {line[:3] for line in bench.moves_since(bench.clock.monotonic() - 30.0)} == {"a 1"}
    bench.do(Goto(150.0, 40.0, "you"), seconds=60.0)
    assert bench.state.fault is None
    assert bench.device.truth().az_deg == pytest.approx(150.0, abs=0.1)


def on_its_long_way():
    """A bench whose stream has fallen back, and goes a way that any byte would abort."""
    bench = following_travler()
    bench.device.wire.to_host.set_plan(lambda _value: DROP)
    bench.step(1.0)
    bench.device.wire.to_host.set_plan(None)
    since, end = bench.clock.monotonic(), bench.clock.monotonic() + 40.0
    while not any(line.startswith("g ") for line in bench.moves_since(since)) and bench.clock.monotonic() < end:
        bench.step(0.05)
    bench.step(1.0)
    assert bench.device.truth().moving
    return bench, max(when for when, line in bench.received() if line.startswith("g "))


def test_nothing_is_said_while_a_stream_goes_a_long_way():
    bench, began = on_its_long_way()
    bench.step(4.0)
    assert bench.device.truth().moving
    assert not [line for when, line in bench.received() if when > began]


def test_stop_ends_a_stream_on_its_long_way():
    bench, began = on_its_long_way()
    future = bench.station.submit(Stop("you"))
    bench.step(3.0)
    assert future.done()
    assert future.exception() is None
    assert not bench.device.truth().moving
    assert bench.pursuit.phase is Phase.OVER
    bench.step(20.0)
    assert bench.moves_since(began) == []


def test_a_stall_on_its_long_way_ends_a_stream():
    bench, began = on_its_long_way()
    bench.device.stall(1)
    bench.step(20.0)
    assert bench.state.fault.reason == "stall"
    assert bench.pursuit.phase is Phase.OVER
    assert bench.moves_since(began) == []
