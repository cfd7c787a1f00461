"""Somebody else takes control in the middle of a pursuit, and gives it back."""

from __future__ import annotations

import pytest
from birdcage.base.errors import LinkError, MotionRefused, PositionUnknown
from birdcage.base.geometry import separation
from birdcage.base.no_go import NoGoSector
from birdcage.station.pursuit_state import Phase
from birdcage.station.requests import AcquireLease, Goto, Home, Pursue, Release, ReleaseLease

from .conftest import Bench
from .pursuit_bench import PARK, PursuitBench, at, g2, plan_of


def following(**options):
    bench = g2()
    bench.pursue(plan_of(at(bench) + 40.0), **PARK | options)
    return bench.until(Phase.FOLLOWING)


def off_deg(bench):
    truth, target = bench.device.truth(), bench.pursuit.plan.sky.at(at(bench))
    return separation(truth.az_deg, truth.el_deg, *target)


def test_another_holder_takes_over_and_gives_back():
    bench = following()
    bench.step(10)
    bench.do(AcquireLease("Gpredict", take_over=True))
    bench.until(Phase.YIELDED, 1.0)
    assert bench.pursuit.why == "Gpredict has control."
    bench.do(Goto(250, 30, "Gpredict"))
    since = bench.clock.monotonic()
    bench.step(10)
    assert bench.moves_since(since) == []
    bench.do(ReleaseLease("Gpredict"))
    bench.until(Phase.COUNTDOWN, 1.0)
    assert (bench.pursuit.next_at - bench.clock.utc()).total_seconds() == pytest.approx(5.0, abs=0.3)
    since = bench.clock.monotonic()
    bench.step(4.5)
    assert bench.moves_since(since) == []
    bench.until(Phase.FOLLOWING, 20.0)
    assert bench.state.holder == "you"
    bench.step(2)
    assert off_deg(bench) < 0.2, "on the path where the target is now"
    bench.until(Phase.OVER)
    assert bench.phases[-2:] == [Phase.PARKING, Phase.OVER]


def test_it_yields_to_whoever_has_control_when_it_is_time_to_leave():
    bench = g2()
    bench.pursue(plan_of(at(bench) + 200.0), asked=False, holder="autotrack", **PARK)
    bench.do(Goto(150, 40, "you"))
    assert bench.pursuit.phase is Phase.WAITING
    bench.until(Phase.YIELDED, 300.0)
    assert bench.pursuit.why == "You have control."
    bench.step(400)
    assert bench.pursuit.phase is Phase.OVER
    assert separation(bench.device.truth().az_deg, bench.device.truth().el_deg, 150, 40) < 0.1, "nor is it parked"


def test_a_plan_replaced_in_mid_pass_goes_on_without_a_break():
    bench = following()
    bench.step(10)
    number, phases = bench.pursuit.number, list(bench.phases)
    later = plan_of(bench.pursuit.plan.legs[0].start_s, late_s=2.0)
    assert bench.pursue(later) == number
    bench.step(5)
    assert bench.phases == phases
    assert bench.pursuit.plan.aim.time_offset_s == 2.0
    assert off_deg(bench) < 0.2


def test_another_target_ends_the_pursuit_and_begins_its_own():
    bench = following()
    bench.step(5)
    other = plan_of(at(bench) + 30, name="METEOR", from_az=200.0)
    assert bench.pursue(other) == 2
    assert bench.phases[-2:] in ([Phase.OVER, Phase.WAITING], [Phase.OVER, Phase.PREPOSITIONING])
    bench.until(Phase.FOLLOWING).step(5)
    assert off_deg(bench) < 0.2


def test_it_joins_in_the_middle_of_a_pass_at_once_when_a_person_asks():
    bench = g2()
    bench.pursue(plan_of(at(bench) - 50.0), **PARK)
    bench.until(Phase.FOLLOWING, 8.0)
    bench.step(1)
    assert Phase.COUNTDOWN not in bench.phases
    assert off_deg(bench) < 0.2


def test_a_gap_between_legs_is_bridged_to_where_the_next_begins():
    bench = g2()
    start = at(bench) + 30
    bench.pursue(plan_of(start, gap=(40.0, 80.0)), **PARK)
    bench.until(Phase.FOLLOWING).step(50)
    bench.until(Phase.READY, 20)
    az_deg, el_deg = bench.pursuit.plan.course.at(start + 80)
    assert separation(bench.device.truth().az_deg, bench.device.truth().el_deg, az_deg, el_deg) < 0.2
    bench.until(Phase.FOLLOWING, 60)


def test_an_unhomed_dish_says_what_to_do():
    bench = PursuitBench("g2?seed=1&unhomed=1").connect()
    with pytest.raises(PositionUnknown, match="Home it"):
        bench.pursue(plan_of(at(bench) + 40))
    assert bench.pursuit is None


def test_without_a_link_or_a_reachable_pass_it_is_refused():
    bench = g2()
    with pytest.raises(MotionRefused, match="over"):
        bench.pursue(plan_of(at(bench) - 500))
    lost = Bench()
    lost.device.unplug()
    lost.step(3.0)
    with pytest.raises(LinkError, match="No link to the dish"):
        lost.do(Pursue(plan_of(at(lost) + 40), "you"))


def test_it_goes_over_a_no_go_sector_on_its_way():
    sector = NoGoSector(60.0, 80.0, 40.0, "mast")
    bench = g2(sectors=(sector,))
    bench.do(Home("you"), 60)
    bench.do(Goto(30, 45, "you"))
    bench.do(Goto(30, 30, "you"))
    bench.pursue(plan_of(at(bench) + 40.0, from_az=-260.0, turn=-1), at_end="stay")
    seen = []
    while bench.pursuit.phase is not Phase.READY:
        bench.step(0.05)
        truth = bench.device.truth()
        seen.append((truth.az_deg, truth.el_deg))
    assert any(60.0 < az_deg < 80.0 for az_deg, _el in seen)
    assert all(el_deg >= 40.0 - 0.1 for az_deg, el_deg in seen if 60.0 < az_deg < 80.0)
    bench.until(Phase.OVER)
    assert bench.pursuit.why == "The pass is over."
    assert bench.pursuit.rms_error_deg < 0.1


def test_no_countdown_while_somebody_else_has_control():
    bench = g2()
    bench.pursue(plan_of(at(bench) + 200.0), asked=False, **PARK)
    bench.until(Phase.COUNTDOWN, 300.0)
    bench.do(AcquireLease("Gpredict"))
    bench.until(Phase.YIELDED, 0.5)
    bench.do(ReleaseLease("Gpredict"))
    bench.until(Phase.COUNTDOWN, 0.5)


def test_a_link_lost_under_somebody_else_lets_a_waiting_pursuit_go_on_after_a_release():
    bench = g2()
    bench.pursue(plan_of(at(bench) + 100.0), asked=False, **PARK)
    bench.do(Goto(150, 40, "Gpredict"))
    bench.device.unplug()
    bench.step(2)
    bench.device.plug()
    bench.step(8)
    assert bench.state.held.reason == "link"
    assert bench.pursuit.phase is Phase.INTERRUPTED
    bench.do(Release("you"))
    bench.until(Phase.WAITING, 1.0)
    bench.until(Phase.FOLLOWING)


def test_a_later_pass_in_place_of_the_present_one_does_not_let_the_dish_go_on_to_the_old_one():
    bench = g2()
    bench.pursue(plan_of(at(bench) + 30.0, from_az=200.0, leave_s=at(bench)), **PARK)
    bench.until(Phase.PREPOSITIONING).step(0.5)
    assert bench.device.truth().moving
    before = bench.device.truth().az_deg
    bench.pursue(plan_of(at(bench) + 900.0, name="METEOR"))
    bench.step(5)
    truth = bench.device.truth()
    assert not truth.moving
    assert abs(truth.az_deg - before) < 25.0
    assert bench.pursuit.phase is Phase.WAITING
    assert bench.state.holder is None
    assert bench.state.held is None


def test_close_beside_a_no_go_sector_the_dish_is_looked_at_anew_before_a_command_is_given_up():
    bench = g2(sectors=(NoGoSector(130.0, 149.6, 40.2, "mast"),))
    bench.do(Home("you"), 60)
    bench.do(Goto(100, 55, "you"))
    plan = plan_of(at(bench) + 30.0)
    bench.pursue(plan, at_end="stay")
    bench.until(Phase.FOLLOWING)
    while bench.pursuit.phase is Phase.FOLLOWING:
        bench.step(0.05)
        truth = bench.device.truth()
        assert not (130.0 < truth.az_deg < 149.6 and truth.el_deg < 40.2)
    assert bench.pursuit.why == "The pass is over."
    assert bench.pursuit.max_error_deg < 0.2


def test_a_stream_that_would_go_through_a_no_go_sector_ends_the_pursuit():
    bench = g2(sectors=(NoGoSector(130.0, 149.6, 49.0, "mast"),))
    bench.do(Home("you"), 60)
    bench.do(Goto(100, 55, "you"))
    bench.pursue(plan_of(at(bench) + 30.0), at_end="stay")
    while bench.pursuit.phase is not Phase.OVER:
        bench.step(0.05)
        truth = bench.device.truth()
        assert not (130.0 < truth.az_deg < 149.6 and truth.el_deg < 48.9), "but for what an axis overshoots"
    assert "no-go sector" in bench.pursuit.why
