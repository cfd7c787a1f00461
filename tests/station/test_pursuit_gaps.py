"""The link is lost in mid-pass, the dish restarts, the clock is stepped: it stays still, and says what comes next."""

from __future__ import annotations

import pytest
from birdcage.base.geometry import separation
from birdcage.station.pursuit_state import Phase
from birdcage.station.requests import Release

from .pursuit_bench import PARK, at, g2, plan_of


def following(**options):
    bench = g2()
    bench.pursue(plan_of(at(bench) + 40.0), **PARK | options)
    bench.until(Phase.FOLLOWING)
    bench.step(10)
    return bench


def off_deg(bench):
    truth, target = bench.device.truth(), bench.pursuit.plan.sky.at(at(bench))
    return separation(truth.az_deg, truth.el_deg, *target)


def unplugged(bench, seconds):
    bench.device.unplug()
    bench.step(seconds)
    bench.device.plug()


def test_after_a_lost_link_it_stays_still_until_a_person_releases_it():
    bench = following()
    unplugged(bench, 3.0)
    assert bench.pursuit.phase is Phase.INTERRUPTED
    assert bench.pursuit.why.startswith("Link lost")
    since = bench.clock.monotonic()
    bench.step(15)
    assert bench.moves_since(since) == []
    assert bench.state.held.reason == "link"
    assert bench.state.held.next_holder == "you"
    target = bench.pursuit.plan.sky.at(at(bench))
    assert bench.state.held.next_az_deg == pytest.approx(target[0], abs=0.3)
    bench.do(Release("you"))
    bench.until(Phase.COUNTDOWN, 1.0)
    bench.step(4.5)
    assert bench.moves_since(since) == []
    bench.until(Phase.FOLLOWING, 10)
    bench.step(2)
    assert off_deg(bench) < 0.2, "on the path and not where it stopped"
    bench.until(Phase.OVER)
    assert bench.phases[-1] is Phase.OVER
    assert Phase.PARKING in bench.phases


def test_it_goes_on_by_itself_where_that_was_chosen_and_all_is_as_before():
    bench = following(resume=True)
    unplugged(bench, 2.0)
    bench.until(Phase.COUNTDOWN, 10.0)
    assert bench.state.held is None
    bench.until(Phase.FOLLOWING, 10.0)
    bench.step(2)
    assert off_deg(bench) < 0.2


def test_it_does_not_go_on_by_itself_after_too_long_a_gap():
    bench = following(resume=True, resume_within_s=3.0)
    unplugged(bench, 8.0)
    bench.step(20)
    assert bench.pursuit.phase is Phase.INTERRUPTED
    assert bench.state.held.reason == "link"


def test_it_does_not_go_on_by_itself_when_the_dish_was_moved_meanwhile():
    bench = following(resume=True)
    bench.device.unplug()
    bench.step(1.0)
    bench.device.wander(0, 3.0)
    bench.step(1.5)
    bench.device.plug()
    bench.step(15)
    assert bench.pursuit.phase is Phase.INTERRUPTED
    assert bench.state.held is not None


def test_stop_during_the_gap_is_a_stop():
    bench = following(resume=True)
    bench.device.unplug()
    bench.step(1.0)
    bench.station.stop("you")
    bench.step(0.5)
    bench.device.plug()
    since = bench.clock.monotonic()
    bench.step(30)
    assert bench.pursuit.phase is Phase.OVER
    assert bench.moves_since(since) == []
    assert bench.state.held.reason == "stop"


def test_a_release_after_the_pass_leaves_the_dish_where_it_is():
    bench = following()
    unplugged(bench, 3.0)
    bench.step(200)
    assert bench.pursuit.phase is Phase.OVER
    since = bench.clock.monotonic()
    bench.do(Release("you"))
    bench.step(20)
    assert bench.moves_since(since) == []


def test_a_lost_link_while_it_waits_interrupts_nothing():
    bench = g2()
    bench.pursue(plan_of(at(bench) + 100.0))
    unplugged(bench, 5.0)
    bench.step(10)
    assert bench.pursuit.phase is Phase.WAITING
    assert bench.state.held is None
    bench.until(Phase.FOLLOWING)


def test_a_step_of_the_clock():
    bench = following()
    bench.clock.step_utc(5.0)
    bench.step(3.0)
    assert bench.pursuit.phase is Phase.INTERRUPTED
    assert bench.state.held is not None
    since = bench.clock.monotonic()
    bench.step(20)
    assert bench.moves_since(since) == []
    bench.do(Release("you"))
    bench.until(Phase.FOLLOWING, 12).step(2)
    assert off_deg(bench) < 0.2


def test_a_dish_that_restarts_in_mid_pass():
    bench = following(resume=True)
    bench.device.reboot()
    bench.step(5)
    assert bench.pursuit.phase is Phase.INTERRUPTED
    assert bench.state.fault.reason == "reboot"
    bench.step(200)
    assert bench.pursuit.phase is Phase.OVER


def swallowing(bench, lines):
    """Lose the next lines on their way to the dish."""
    write, left = bench.sim.write, [lines]

    def lossy(data):
        if left[0] > 0 and data.strip():
            left[0] -= 1
            return
        write(data)

    bench.sim.write = lossy


def test_an_answer_that_is_lost_now_and_then_is_borne():
    bench = following()
    swallowing(bench, 1)
    bench.step(6)
    assert bench.pursuit.phase is Phase.FOLLOWING
    assert bench.state.held is None
    assert off_deg(bench) < 0.2


def test_a_dish_that_falls_silent_is_left_alone():
    bench = following()
    swallowing(bench, 1000)
    bench.step(20)
    assert bench.pursuit.phase is Phase.INTERRUPTED
    assert bench.state.held.reason == "link"
