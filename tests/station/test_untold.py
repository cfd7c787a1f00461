"""A dish that tells nothing of where it is at rest: driven by time, and nothing of it is called read or confirmed."""

from __future__ import annotations

import pytest
from birdcage.base.errors import Held, MotionRefused, Stopped
from birdcage.station.requests import Goto, Jog, Release
from birdcage.station.state import Activity

from .conftest import Bench
from .pursuit_bench import PursuitBench, at, plan_of


@pytest.fixture(params=["", "&prompt_when=at_once", "&second_move=abort"])
def bench(request):
    return Bench(f"carryout?seed=1{request.param}", firmware="carryout").connect(8.0)


def test_nothing_is_known_before_the_first_move(bench):
    state = bench.state
    assert (state.position, state.homed, state.position_lost) == (None, None, "untold")
    with pytest.raises(MotionRefused):
        bench.do(Jog(1.0, 0.0, "you"))


def test_a_goto_arrives_by_its_time_and_is_called_modelled(bench):
    bench.do(Goto(180, 45, "you"), 200)
    here, truth = bench.state.position, bench.device.truth()
    assert here.modelled
    assert (here.az_deg, here.el_deg) == pytest.approx((180.0, 45.0), abs=0.01)
    assert not truth.moving
    assert (truth.az_deg, truth.el_deg) == pytest.approx((180.0, 45.0), abs=0.1)
    assert bench.state.homed is None
    assert moves(bench)[-1] == "g 180.00 45.00"


def moves(bench, since=0):
    """What it was sent beside its menus and the question that it must answer before a move counts as over."""
    return [line for line in bench.lines()[since:] if line not in ("target", "?")]


def test_what_falls_silent_on_its_way_has_not_arrived(bench):
    bench.do(Goto(180, 45, "you"), 200)
    future = bench.station.submit(Goto(250, 60, "you"))
    bench.step(2)
    for lane in bench.device.wire.lanes:
        lane.silent = True
    with pytest.raises(Stopped, match="link"):
        bench.step(120) or future.result(0)
    assert bench.state.position_lost is not None


def test_its_owner_may_say_how_fast_it_is_and_that_is_what_its_moves_are_timed_by():
    took = {}
    for facts in ({}, {"azimuth.speed_deg_s": 10.0, "elevation.speed_deg_s": 10.0}):
        bench = Bench("carryout?seed=1", {"own_facts": facts}, "carryout").connect(8.0)
        bench.do(Goto(180, 45, "you"), 200)
        bench.station.submit(Goto(240, 45, "you"))
        bench.step(1)
        took[len(facts)] = bench.state.motion.eta - bench.state.motion.started
    assert took[0] == pytest.approx(60 / 5, abs=3)
    assert took[2] == pytest.approx(60 / 10, abs=2)


def test_on_the_first_way_nobody_knows_where_it_is(bench):
    future = bench.station.submit(Goto(180, 45, "you"))
    bench.step(5)
    assert bench.state.activity is Activity.SLEWING
    assert bench.state.position is None
    assert bench.state.motion.stop_means == "none"
    while not future.done():
        bench.step(1)
    assert bench.state.position is not None


def test_a_jog_names_both_axes_as_this_dish_wants(bench):
    bench.do(Goto(180, 45, "you"), 200)
    bench.do(Jog(5.0, 0.0, "you"), 60)
    assert moves(bench)[-1] == "g 185.00 45.00"
    assert bench.device.truth().az_deg == pytest.approx(185.0, abs=0.1)


def test_stop_sends_what_may_help_and_confirms_nothing(bench):
    bench.do(Goto(180, 45, "you"), 200)
    future = bench.station.submit(Goto(250, 60, "you"))
    bench.step(2)
    bench.station.stop("you")
    bench.step(4)
    assert isinstance(future.exception(0), Stopped)
    stop = bench.state.last_stop
    assert stop.confirmed is not True
    assert "No STOP is known" in stop.sentence or "does not tell" in stop.sentence or "not answered" in stop.sentence
    assert bench.state.activity is Activity.UNKNOWN
    assert bench.lines()[-1] == ""
    bench.step(3)
    assert bench.state.position is None
    with pytest.raises(Held):
        bench.do(Goto(100, 45, "you"))
    bench.step(120)
    assert bench.state.activity is Activity.IDLE
    bench.do(Release("you"))
    bench.do(Goto(100, 45, "you"), 200)
    assert bench.device.truth().az_deg == pytest.approx(100.0, abs=0.1)


def test_stop_at_rest_confirms_nothing_either(bench):
    bench.do(Goto(180, 45, "you"), 200)
    bench.station.stop("you")
    bench.step(4)
    stop = bench.state.last_stop
    assert stop.confirmed is None
    assert stop.sentence == "This dish does not tell whether it has stopped. If it moves, cut its power."


def test_a_newer_target_waits_and_nothing_is_sent_to_end_the_one_before(bench):
    bench.station.submit(Goto(180, 45, "you"))
    bench.step(0.5)
    sent = len(bench.lines())
    bench.do(Goto(200, 50, "you"), 300)
    assert moves(bench, sent) == ["g 200.00 50.00"]
    assert (bench.state.position.az_deg, bench.device.truth().az_deg) == pytest.approx((200.0, 200.0), abs=0.1)


def test_a_step_from_nowhere_known_says_what_to_do(bench):
    with pytest.raises(MotionRefused, match="Send it to an azimuth and an elevation first"):
        bench.do(Jog(1.0, 0.0, "you"))
    bench.station.stop("you")
    bench.step(4)
    with pytest.raises(Held):
        bench.do(Jog(1.0, 0.0, "you"))


def test_released_while_it_may_still_be_on_its_way_it_is_sent_nowhere(bench):
    bench.do(Goto(180, 45, "you"), 200)
    bench.station.submit(Goto(250, 60, "you"))
    bench.step(2)
    bench.station.stop("you")
    bench.step(4)
    bench.do(Release("you"))
    before = [line for line in bench.lines() if line.startswith("g")]
    with pytest.raises(MotionRefused, match="may still be on its way") as refused:
        bench.do(Goto(100, 45, "you"))
    assert refused.value.reason == "moving"
    assert [line for line in bench.lines() if line.startswith("g")] == before
    bench.step(60)
    bench.do(Goto(100, 45, "you"), 200)
    assert bench.device.truth().az_deg == pytest.approx(100.0, abs=0.1)


def test_outside_its_limits_nothing_is_sent(bench):
    before = bench.lines()
    with pytest.raises(MotionRefused):
        bench.do(Goto(180, 80, "you"))
    assert bench.lines() == before


def test_a_lost_cable_leaves_no_position_and_no_motion(bench):
    bench.do(Goto(180, 45, "you"), 200)
    bench.sim.unplug() if hasattr(bench.sim, "unplug") else bench.device.unplug()
    bench.step(3)
    assert bench.state.position_lost is not None


def test_a_cable_lost_on_the_way_leaves_no_position_when_it_is_back(bench):
    bench.do(Goto(180, 45, "you"), 200)
    bench.station.submit(Goto(300, 60, "you"))
    bench.step(3)
    bench.device.unplug()
    bench.step(3)
    bench.device.plug()
    moved_at = bench.clock.monotonic()
    for _ in range(300):
        bench.step(0.2)
        here, now = bench.state.position, bench.clock.monotonic()
        moved_at = now if bench.device.truth().moving else moved_at
        if bench.state.position_lost is None:
            assert not here.modelled
            assert now < moved_at + 2.5
    assert (bench.state.position, bench.state.position_lost) == (None, "untold")
    assert bench.state.activity is Activity.IDLE


def test_a_pass_is_followed_by_time():
    bench = PursuitBench("carryout?seed=1", firmware="carryout").connect(8.0)
    bench.do(Goto(100, 30, "you"), 200)
    plan = plan_of(at(bench) + 60.0, lasts_s=200.0, az_rate=0.2, low=30.0, high=45.0)
    bench.pursue(plan)
    offs = []
    while bench.pursuit is not None and at(bench) < plan.legs[-1].end_s + 5.0:
        bench.step(2.0)
        t_s = at(bench)
        if plan.legs[0].start_s + 20.0 < t_s < plan.legs[-1].end_s - 5.0:
            truth, (az, el) = bench.device.truth(), plan.course.at(t_s)
            offs.append(max(abs(truth.az_deg - az), abs(truth.el_deg - el)))
    assert offs
    assert max(offs) < 3.0
    assert bench.state.position is None or bench.state.position.modelled
    assert bench.state.fault is None
