"""While a dish that follows stands still on its target its tuner is read, at a calm rate that the pursuit declares."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from birdcage.base.errors import CommandRefused
from birdcage.station.requests import Goto, Pursue
from birdcage.station.state import Activity
from birdcage.tracking.curve import Curve

from .pursuit_bench import Phase, at, g2, plan_of


def on_a_slot(bench, seconds=12.0, **options):
    """Follow what stands still, and be there."""
    bench.pursue(plan_of(at(bench), lasts_s=900.0, az_rate=0.0, low=40.0, high=40.0, name="slot", **options))
    bench.until(Phase.FOLLOWING).step(seconds)
    return bench


def comes_to_rest(start_s):
    """A target that moves for ten seconds, and stands still from then on: the dish is led there by a stream."""
    plan = plan_of(start_s, lasts_s=900.0, az_rate=0.5, low=40.0, high=40.0, name="slot")
    az = np.minimum(plan.course.az_deg, 105.0)
    return replace(
        plan, sky=Curve(plan.sky.t_s, az, plan.sky.el_deg), course=Curve(plan.course.t_s, az, plan.course.el_deg)
    )


def heard(bench):
    return [each for each in bench.events if type(each).__name__ == "ReadingRead" and each.feature == "rssi"]


def into_the_tuner(bench, seconds=20.0):
    end = bench.clock.monotonic() + seconds
    while bench.state.menu != "dvb":
        assert bench.clock.monotonic() < end
        bench.step(0.02)
    return bench


def test_the_tuner_is_read_while_the_dish_stands_still_within_the_budget_of_the_wire():
    bench = g2()
    on_a_slot(bench)
    start = bench.clock.monotonic()
    bench.step(60)
    assert bench.state.activity is Activity.FOLLOWING
    told = [each.at for each in heard(bench) if each.at > start]
    assert len(told) >= 22
    assert [each for each in bench.events if getattr(each, "feature", "") == "snr" and each.at > start]
    assert max(later - earlier for earlier, later in pairwise(told)) < 8.0
    times = [when for when, _ in bench.received() if when > start]
    for first in times:
        assert sum(first <= when < first + 10 for when in times) <= 30
    visits = [when for when, line in bench.received() if when > start and line == "dvb"]
    assert len(visits) >= 6
    assert all(later - earlier >= 5.0 for earlier, later in pairwise(visits))
    assert not [line for when, line in bench.received() if when > start and line.startswith("a ")]
    read = [each.at for each in bench.events if type(each).__name__ == "PositionRead" and each.at > start]
    assert max(later - earlier for earlier, later in pairwise(read)) < 2.0


def test_the_tuner_is_left_alone_while_the_dish_moves_along():
    bench = g2()
    bench.watch("position", "rssi", rate_hz=10)
    bench.pursue(plan_of(at(bench), lasts_s=300.0))
    bench.until(Phase.FOLLOWING)
    bench.step(3)
    start = bench.clock.monotonic()
    bench.step(60)
    assert {line.split()[0] for when, line in bench.received() if when > start} == {"a"}


@pytest.mark.parametrize("after_s", [0.0, 0.01, 0.03, 0.1, 0.3, 0.45, 0.9, 1.25, 1.4])
def test_stop_in_an_excursion_sends_no_target_into_the_tuner_s_menu_and_is_confirmed_at_rest(after_s):
    bench = g2()
    bench.pursue(comes_to_rest(at(bench)))
    bench.until(Phase.FOLLOWING)
    bench.step(14.0)
    into_the_tuner(bench)
    here, start = bench.state.position, bench.clock.monotonic() + after_s
    bench.later(after_s, lambda: bench.station.stop("you"))
    bench.step(5)
    stop = bench.state.last_stop
    assert stop.confirmed is True
    assert bench.state.held is not None
    assert bench.pursuit.phase is Phase.OVER
    confirmed = next(each for each in bench.events if type(each).__name__ == "StopConfirmed")
    assert confirmed.at - start < 2.0
    assert not [line for when, line in bench.received() if when > start and line.startswith("a ")]
    there = bench.state.position
    assert (there.az_deg, there.el_deg) == pytest.approx((here.az_deg, here.el_deg), abs=0.02)


def test_a_hand_in_an_excursion_moves_the_dish_at_once():
    bench = g2()
    into_the_tuner(on_a_slot(bench))
    start = bench.clock.monotonic()
    bench.station.submit(Goto(60.0, 45.0, "you"))
    bench.step(1.0)
    assert any(line.startswith("a 0 60") for when, line in bench.received() if when > start)


def test_another_plan_ends_the_excursion_and_stop_aims_again_without_looking():
    bench = g2()
    into_the_tuner(on_a_slot(bench))
    start = bench.clock.monotonic()
    bench.station.submit(Pursue(
        plan_of(at(bench), lasts_s=900.0, az_rate=0.3, low=40.0, high=40.0, name="slot"), "you", renews=1,
    ))  # fmt: skip
    bench.step(2.5)
    assert any(line.startswith("a 0") for when, line in bench.received() if when > start)
    bench.station.stop("you")
    bench.step(3)
    assert bench.state.last_stop.means == "retarget"


def test_a_tuner_that_refuses_ends_no_pursuit_and_is_not_asked_again(monkeypatch):
    bench = g2()
    asked = []

    def refuse(*_):
        asked.append(bench.clock.monotonic())
        raise CommandRefused("Tuner not available.", reason="unknown")

    monkeypatch.setattr(bench.station._reader, "features", refuse)
    on_a_slot(bench, 40.0)
    assert bench.pursuit.phase is Phase.FOLLOWING
    assert len(asked) == 1
