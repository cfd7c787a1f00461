"""Moving the dish by hand takes control from a pursuit with the motion: judged first, so a refusal costs nothing."""

from __future__ import annotations

import pytest
from birdcage.base.errors import LeaseDenied, MotionRefused
from birdcage.base.no_go import NoGoSector
from birdcage.station.pursuit_state import Phase
from birdcage.station.requests import Goto, Jog, TurnSkew
from birdcage.station.state import Activity

from .pursuit_bench import PARK, at, g2, plan_of, travler


def begun(bench, holder="tracker", **options):
    bench.pursue(plan_of(at(bench) + 40.0), holder=holder, **PARK | options)
    bench.leases = []
    bench.station.subscribe(lambda event: bench.leases.append(event.holder) if hasattr(event, "previous") else None)
    return bench


def following(bench, holder="tracker", **options):
    begun(bench, holder, **options).until(Phase.FOLLOWING)
    bench.step(5)
    bench.leases.clear()
    return bench


TOO_HIGH = (Goto(180.0, 95.0, "you", take_over=True), Jog(0.0, 60.0, "you", take_over=True))


@pytest.mark.parametrize("request_", TOO_HIGH, ids=["goto", "jog"])
def test_what_a_limit_forbids_takes_no_control_and_the_pass_goes_on(request_):
    bench = following(g2())
    phases = list(bench.phases)
    with pytest.raises(MotionRefused, match="above the limit"):
        bench.do(request_)
    bench.step(5)
    assert (bench.leases, bench.state.holder) == ([], "tracker")
    assert bench.phases == phases
    assert bench.pursuit.sample.error_deg < 0.2


def test_a_way_through_a_sector_that_only_the_move_itself_finds_gives_control_back_and_the_pass_goes_on():
    bench = following(g2(sectors=(NoGoSector(200.0, 220.0, 60.0),)))
    phases = list(bench.phases)
    with pytest.raises(MotionRefused, match="sector"):
        bench.do(Goto(250.0, 40.0, "you", take_over=True))
    bench.step(5)
    assert bench.state.holder == "tracker"
    assert bench.phases == phases
    assert bench.pursuit.sample.error_deg < 0.2


@pytest.mark.parametrize("make", [g2, travler], ids=["g2", "travler"])
def test_what_is_allowed_takes_control_and_the_dish_arrives_where_it_was_sent(make):
    bench = following(make())
    arrival = bench.station.submit(Goto(250.0, 40.0, "you", take_over=True))
    bench.until(Phase.YIELDED, 2.0)
    assert bench.state.holder == "you"
    assert bench.pursuit.why == "You have control."
    bench.step(60)
    assert arrival.done()
    assert arrival.exception() is None, "the pursuit that yields does not stop what took over from it"
    truth = bench.device.truth()
    assert (truth.az_deg, truth.el_deg) == pytest.approx((250.0, 40.0), abs=0.1)


def test_without_the_word_for_it_control_is_not_taken():
    bench = following(g2())
    with pytest.raises(LeaseDenied, match="tracker has control"):
        bench.do(Jog(1.0, 0.0, "you"))
    assert bench.leases == []


def test_the_skew_is_not_turned_in_mid_leg_and_the_pass_goes_on():
    bench = begun(travler())
    bench.until(Phase.PREPOSITIONING)
    bench.step(1)
    with pytest.raises(MotionRefused, match="not turned while the dish moves"):
        bench.do(TurnSkew(30.0, "you", take_over=True))
    assert (bench.leases, bench.state.holder) == (["tracker"], "tracker")
    bench.until(Phase.FOLLOWING, 60.0)


def test_your_own_pursuit_with_changed_speeds_goes_on_where_the_motion_is_refused():
    bench = following(g2(), holder="you", controller="velocity", velocity_allowed=True)
    assert bench.state.speeds_lent
    with pytest.raises(MotionRefused, match="above the limit"):
        bench.do(Goto(180.0, 95.0, "you"))
    bench.step(3)
    assert bench.pursuit.phase is Phase.FOLLOWING
    assert bench.state.activity is Activity.FOLLOWING
